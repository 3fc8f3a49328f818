// SPDX-License-Identifier: MIT
// The cuts that several measurements share.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "field/carved/carved_field.hpp"
#include "milling/tool/coefficients.hpp"
#include "milling/tool/cutter.hpp"
#include "motion/path/program.hpp"
#include "session/cut/mill_session.hpp"

namespace tribo::bench {

inline constexpr double kCellMm = 0.1;

// Al7075-T6, carbide, dry (reference 190 of the review 10.1186/s10033-021-00536-9).
inline constexpr milling::CuttingCoefficients kAluminium{767.01, 168.8, 222, 27.7, 26.6, 0.7};

milling::Cutter end_mill(milling::CutterKind kind, double diameter_mm, int flutes, double length_mm);
std::unique_ptr<field::CarvedField> block(const Box3& box_mm, double cell_mm = kCellMm);
motion::Move straight(Vec3 from, Vec3 to);

// One pass in moves of `move_mm`, the last shorter.
std::vector<motion::Move> pass(Vec3 from, Vec3 to, double move_mm);

// A block with passes of one cutter over it.
struct Cuts {
    Box3 block_mm;
    milling::Cutter cutter;
    std::vector<std::vector<motion::Move>> passes;
};

// D12, 5 mm deep, 90 mm long: a slot, then passes that take half the diameter.
Cuts half_immersion(double move_mm, int passes);

// D6, 1 mm deep in moves of 0.5 mm, half the diameter aside: layer under layer of 100 x 100 mm until `moves`
// moves are cut.
Cuts layers(std::size_t moves);

// The finishing job: a wavy floor 0.5 to 1.5 mm deep over 65 x 65 x 10 mm, 1 mm flat cutter, 130 passes of
// 124 moves: 8.5 m in 16,121 moves of 0.53 mm.
struct FinishingJob {
    Box3 block_mm{{0, 0, -10}, {65, 65, 0}};
    milling::Cutter cutter;
    std::vector<Vec3> tips;

    FinishingJob();
    std::string gcode() const;
    std::string toml(const std::string& gcode_name) const;
};

// What a session needs for a path of straight moves. `tips` has two or more.
session::MillSetup session_setup(const Box3& block_mm, const milling::Cutter& cutter,
                                 const std::vector<motion::Move>& moves, double cell_mm = kCellMm);
std::vector<motion::Move> moves_through(const std::vector<Vec3>& tips);

}  // namespace tribo::bench

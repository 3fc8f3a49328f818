// SPDX-License-Identifier: MIT
// Cuts of earlier jobs in the stock of this job: their moves are carved again, without forces, rows and
// collision tests. The field then holds the same sweeps as after the earlier session.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "field/carved/carved_field.hpp"
#include "milling/tool/cutter.hpp"
#include "motion/machine/work_frame.hpp"
#include "motion/path/program.hpp"

namespace tribo::session {

struct MillSetup;

// The cuts of one job, in their order.
struct EarlierCuts {
    std::vector<milling::Cutter> cutters;
    std::vector<motion::Move> moves;          // elementary, without dwells
    std::vector<std::size_t> cutter_of_move;  // index into `cutters`, one per move
    std::vector<char> shares_sweep;           // one per move, with the move before it; empty: none does
};

// The cuts of a setup up to its until_s. The last move ends there.
EarlierCuts planned_cuts(const MillSetup& setup);

// Hashes of everything that decides the removed material: paths and kinds of the moves; sizes of the cutters.
// Feeds, speeds and flutes are not included. hash_of_planned_moves(s) is hash_of_moves(planned_cuts(s))
// without a copy of the moves.
std::uint64_t hash_of_moves(const EarlierCuts& cuts);
std::uint64_t hash_of_planned_moves(const MillSetup& setup);
std::uint64_t hash_of_cutters(std::span<const milling::Cutter> cutters);

// The move in the coordinates of a frame. Exact if the origin is 0 and the axes are parallel to the axes of
// the stock.
motion::Move in_frame(const motion::Move& move, const motion::WorkFrame& frame);

// Carves all cuts, on the carving thread; the field may use others through its ParallelFor. `progress` is
// called from time to time with the finished fraction and may be empty. If it returns false, carve() stops
// and returns false.
bool carve(field::CarvedField& stock, std::span<const EarlierCuts> earlier,
           const std::function<bool(double fraction)>& progress);

}  // namespace tribo::session

// SPDX-License-Identifier: MIT
// The loads of a line of a program, or of all lines of a tool: largest values and sums.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "session/audit/row_loads.hpp"
#include "sweep/band.hpp"

namespace tribo::session {

struct PeakLoad {
    double value = 0, ratio = 0;  // the largest of each
    int line = 0;                 // of the largest ratio, else of the largest value
    double t_s = 0;
};

// Seconds with chips below the least one, for the ends of the band of that limit and for its value.
struct ThinTime {
    double below_low_s = 0, below_value_s = 0, below_high_s = 0;
};

struct LoadTally {
    int line = 0;  // 0: of several lines
    std::size_t cutter = 0;
    double start_s = 0, end_s = 0;
    double spindle_rpm = 0;
    double feed_mm = 0, feed_s = 0;  // of feed moves
    double cutting_s = 0;            // at most feed_s, but for rapids that cut
    double removed_mm3 = 0;
    std::array<PeakLoad, kLoadKinds> peaks;  // in the order of LoadKind
    ThinTime thin;
    double plunge_deg = 0;  // steepest way down into material, of the tool along its axis
    double jump_n = 0;      // largest rise of the peak force from a row to the next one
    int entries = 0;        // out of the air into material
    int collisions = 0;
    // Of what it left of the finished part, where there is a design (part_errors.hpp), mm.
    std::optional<double> gouge_mm{}, scallop_mm{};
    // The ratios of the peaks in each case of ForceCases, until close_cases(); empty: there are no cases.
    std::vector<std::array<double, kLoadKinds>> cases;
    std::optional<std::array<sweep::Band, kLoadKinds>> bands;  // of the ratios in the cases

    const PeakLoad& of(LoadKind kind) const { return peaks[index_of(kind)]; }
    // The load that is nearest to its limit; none if no load has a limit.
    std::optional<LoadKind> worst() const;
    void add_peaks(const RowLoads& loads, int line, double t_s);
    void add_cases(std::span<const std::array<double, kLoadKinds>> ratios);
    // Keeps their bands alone. After the last one.
    void close_cases();
    // Adds a line to the tally of a tool.
    void add(const LoadTally& line);
};

// The band of the ratio of a peak: that of its cases, or without them from the band of the force.
RatioBand band_of(const LoadTally& tally, LoadKind kind, const LoadModel& model);

}  // namespace tribo::session

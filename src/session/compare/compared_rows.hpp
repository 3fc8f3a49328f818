// SPDX-License-Identifier: MIT
// The rows of two runs, joined: which stretch of B stands beside which stretch of A. Rows come from a run or
// from its forces.csv.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "milling/engagement/cut_row.hpp"
#include "milling/force/row_force.hpp"
#include "readers/tables/forces_csv_reader.hpp"

namespace tribo::session {

struct ComparedRow : readers::ForceTableRow {
    // Absent: not known.
    std::optional<double> chip_mm;     // the thickest
    std::optional<double> load_ratio;  // to the limit that is nearest

    double end_s() const { return start_s + duration_s; }
};

ComparedRow compared_row(const milling::CutRow& row, const milling::RowForce& force,
                         std::optional<double> multiplier, std::optional<double> load_ratio);

// What is compared of a stretch of the cut.
enum class Quantity {
    peak_force,
    mean_force,
    torque,
    depth,
    chip,
    feed,
    speed,
    multiplier,
    load,
    cutting_time,
    removed
};
inline constexpr std::size_t kQuantities = 11;

struct QuantityWords {
    std::string_view name, key, unit;  // key: of files
};

// In the order of Quantity. Peaks, depth, chip, multiplier and load are the largest of a stretch; mean force,
// feed and speed are means over its time; time and volume are sums.
inline constexpr std::array<QuantityWords, kQuantities> kQuantityWords{{
    {"peak force across the axis", "peak_fxy_n", "N"},
    {"mean force", "mean_force_n", "N"},
    {"peak torque", "peak_torque_nm", "N m"},
    {"axial depth", "axial_depth_mm", "mm"},
    {"thickest chip", "chip_mm", "mm"},
    {"feed", "feed_mm_per_min", "mm/min"},
    {"spindle speed", "spindle_rpm", "rpm"},
    {"chatter multiplier", "multiplier", ""},
    {"tool load", "load_ratio", ""},
    {"cutting time", "cutting_s", "s"},
    {"removed volume", "removed_mm3", "mm3"},
}};

constexpr std::size_t index_of(Quantity q) {
    return static_cast<std::size_t>(q);
}

// A stretch of one run.
struct CutStretch {
    double from_s = 0, to_s = 0;
    int line = 0;                             // of the row with the largest force
    Vec3 tip_mm;                              // likewise
    std::array<double, kQuantities> value{};  // NaN: not known

    double of(Quantity q) const { return value[index_of(q)]; }
};

enum class JoinBy { line, removed, time };
// "line", "removed volume", "time".
std::string_view name_of(JoinBy by);

struct CutPair {
    double place = 0;                // number of the line, or start of the step: removed mm3, s
    std::optional<CutStretch> a, b;  // absent: nothing is cut there; one of them at least stands here
};

// B minus A; NaN if one of them is not known.
double difference(const CutPair& pair, Quantity q);

struct JoinedCuts {
    JoinBy by = JoinBy::time;
    std::string why;             // a sentence
    double step = 0;             // width of a step, mm3 or s; 0: by line
    std::vector<CutPair> pairs;  // in the order of time
};

// Steps of a join by volume or time.
inline constexpr std::size_t kJoinSteps = 1000;

// Two programs have the same lines if they cut in the same lines in the same order; then they are joined by
// line. Else they are joined by removed volume if both remove the same within kSameVolume, else by time.
// `wanted` decides instead; a join by line is then refused if the lines are not the same. The rows are in the
// order of time, as a run gives them.
inline constexpr double kSameVolume = 0.02;
Result<JoinedCuts> join(std::span<const ComparedRow> a, std::span<const ComparedRow> b,
                        std::optional<JoinBy> wanted = {});

}  // namespace tribo::session

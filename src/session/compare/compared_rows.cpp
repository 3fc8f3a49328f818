// SPDX-License-Identifier: MIT
#include "session/compare/compared_rows.hpp"

#include <algorithm>
#include <utility>

#include "base/text/decimal.hpp"
#include "milling/engagement/engagement.hpp"

namespace tribo::session {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

void raise(double& largest, double value) {
    if (std::isnan(largest) || value > largest) largest = value;
}

// Collects rows, or shares of rows, to a stretch.
class Gatherer {
  public:
    // `share` of the row: > 0.
    void add(const ComparedRow& row, double share) {
        auto& v = stretch_.value;
        const auto at = [&](Quantity q) -> double& { return v[index_of(q)]; };
        const double seconds = share * row.duration_s;
        if (is_empty_) {
            v.fill(0);
            at(Quantity::chip) = at(Quantity::multiplier) = at(Quantity::load) = kUnknown;
            stretch_.from_s = row.start_s;
            is_empty_ = false;
        }
        if (row.peak_xy_n > at(Quantity::peak_force) || stretch_.line == 0) {
            stretch_.line = row.line;
            stretch_.tip_mm = row.tip_mm;
        }
        stretch_.to_s = row.end_s();
        raise(at(Quantity::peak_force), row.peak_xy_n);
        raise(at(Quantity::torque), std::abs(row.peak_torque_nm));
        raise(at(Quantity::depth), row.axial_depth_mm);
        if (row.chip_mm) raise(at(Quantity::chip), *row.chip_mm);
        if (row.multiplier) raise(at(Quantity::multiplier), *row.multiplier);
        if (row.load_ratio) raise(at(Quantity::load), *row.load_ratio);
        at(Quantity::mean_force) += seconds * row.mean_n;
        at(Quantity::feed) += seconds * row.feed_mm_per_min;
        at(Quantity::speed) += seconds * row.spindle_rpm;
        at(Quantity::cutting_time) += seconds;
        at(Quantity::removed) += share * row.removed_mm3;
    }
    bool is_empty() const { return is_empty_; }
    CutStretch take() {
        const double seconds = stretch_.of(Quantity::cutting_time);
        for (const Quantity q : {Quantity::mean_force, Quantity::feed, Quantity::speed})
            stretch_.value[index_of(q)] = seconds > 0 ? stretch_.of(q) / seconds : kUnknown;
        is_empty_ = true;
        return std::exchange(stretch_, {});
    }

  private:
    CutStretch stretch_;
    bool is_empty_ = true;
};

// Neighbouring rows of one line.
std::vector<CutStretch> by_line(std::span<const ComparedRow> rows) {
    std::vector<CutStretch> stretches;
    Gatherer gatherer;
    for (std::size_t n = 0; n < rows.size(); ++n) {
        gatherer.add(rows[n], 1);
        if (n + 1 == rows.size() || rows[n + 1].line != rows[n].line) stretches.push_back(gatherer.take());
    }
    return stretches;
}

bool are_same_lines(const std::vector<CutStretch>& a, const std::vector<CutStretch>& b) {
    return std::ranges::equal(a, b, {}, &CutStretch::line, &CutStretch::line);
}

double removed_mm3(std::span<const ComparedRow> rows) {
    double sum = 0;
    for (const ComparedRow& row : rows) sum += row.removed_mm3;
    return sum;
}

// The rows in steps of equal width, along the time or the removed volume; a row may be in several.
std::vector<std::optional<CutStretch>> in_steps(std::span<const ComparedRow> rows, JoinBy by, double step) {
    std::vector<Gatherer> gatherers(kJoinSteps);
    double removed = 0;
    for (const ComparedRow& row : rows) {
        const double from = by == JoinBy::time ? row.start_s : removed;
        const double width = by == JoinBy::time ? row.duration_s : std::max(row.removed_mm3, 0.0);
        removed += std::max(row.removed_mm3, 0.0);
        const auto step_at = [&](double at) {
            return std::min(static_cast<std::size_t>(std::max(at, 0.0) / step), kJoinSteps - 1);
        };
        const std::size_t first = step_at(from), last = step_at(from + width);
        for (std::size_t n = first; n <= last; ++n) {
            const double low = std::max(from, static_cast<double>(n) * step);
            const double high = n == last ? from + width : static_cast<double>(n + 1) * step;
            const double share = width > 0 ? (high - low) / width : 1;
            if (share > 0) gatherers[n].add(row, share);
        }
    }
    std::vector<std::optional<CutStretch>> stretches(kJoinSteps);
    for (std::size_t n = 0; n < kJoinSteps; ++n)
        if (!gatherers[n].is_empty()) stretches[n] = gatherers[n].take();
    return stretches;
}

void join_in_steps(std::span<const ComparedRow> a, std::span<const ComparedRow> b, double most,
                   JoinedCuts& joined) {
    if (!(most > 0)) return;
    joined.step = most / static_cast<double>(kJoinSteps);
    auto of_a = in_steps(a, joined.by, joined.step), of_b = in_steps(b, joined.by, joined.step);
    for (std::size_t n = 0; n < kJoinSteps; ++n)
        if (of_a[n] || of_b[n])
            joined.pairs.push_back({static_cast<double>(n) * joined.step, of_a[n], of_b[n]});
}

std::string volumes_in_words(double a_mm3, double b_mm3) {
    return format_digits(a_mm3, 3) + " and " + format_digits(b_mm3, 3) + " mm3";
}

}  // namespace

ComparedRow compared_row(const milling::CutRow& row, const milling::RowForce& force,
                         std::optional<double> multiplier, std::optional<double> load_ratio) {
    ComparedRow compared;
    compared.start_s = row.start_s;
    compared.duration_s = row.duration_s();
    compared.line = row.line;
    compared.tip_mm = row.pose.tip_mm;
    compared.spindle_rpm = row.spindle_rpm;
    compared.feed_mm_per_min = row.feed_mm_per_s() * 60;
    compared.axial_depth_mm = milling::hull(row.engagement).axial_depth_mm;
    compared.mean_n = length(force.peaks.mean_n);
    compared.peak_xy_n = force.peaks.peak_xy_n;
    compared.peak_torque_nm = 1e-3 * force.peaks.peak_torque_nmm;
    compared.removed_mm3 = row.removed_mm3;
    compared.chip_mm = force.chip_mm;
    compared.multiplier = multiplier;
    compared.load_ratio = load_ratio;
    return compared;
}

std::string_view name_of(JoinBy by) {
    switch (by) {
        case JoinBy::line:
            return "line";
        case JoinBy::removed:
            return "removed volume";
        case JoinBy::time:
            break;
    }
    return "time";
}

double difference(const CutPair& pair, Quantity q) {
    return pair.a && pair.b ? pair.b->of(q) - pair.a->of(q) : kUnknown;
}

Result<JoinedCuts> join(std::span<const ComparedRow> a, std::span<const ComparedRow> b,
                        std::optional<JoinBy> wanted) {
    const std::vector<CutStretch> lines_a = by_line(a), lines_b = by_line(b);
    const bool same = are_same_lines(lines_a, lines_b);
    const double mm3_a = removed_mm3(a), mm3_b = removed_mm3(b);
    const bool same_volume = std::abs(mm3_a - mm3_b) <= kSameVolume * std::max(mm3_a, mm3_b);
    JoinedCuts joined;
    joined.by = wanted.value_or(same ? JoinBy::line : same_volume ? JoinBy::removed : JoinBy::time);
    switch (joined.by) {
        case JoinBy::line:
            if (!same)
                return fail_at("", 0, 0, "the two runs do not cut in the same lines",
                               "join them by volume or by time");
            joined.why = "both runs cut in the same lines, in the same order";
            for (std::size_t n = 0; n < lines_a.size(); ++n)
                joined.pairs.push_back({static_cast<double>(lines_a[n].line), lines_a[n], lines_b[n]});
            break;
        case JoinBy::removed:
            joined.why =
                same ? "so asked for"
                     : "the lines differ, and both remove about the same: " + volumes_in_words(mm3_a, mm3_b);
            join_in_steps(a, b, std::max(mm3_a, mm3_b), joined);
            break;
        case JoinBy::time:
            joined.why = same || same_volume
                             ? "so asked for"
                             : "the lines differ, and so do the volumes: " + volumes_in_words(mm3_a, mm3_b);
            join_in_steps(a, b, std::max(a.empty() ? 0 : a.back().end_s(), b.empty() ? 0 : b.back().end_s()),
                          joined);
            break;
    }
    return joined;
}

}  // namespace tribo::session

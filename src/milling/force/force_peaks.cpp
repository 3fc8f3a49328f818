// SPDX-License-Identifier: MIT
#include "milling/force/force_peaks.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "milling/force/force.hpp"
#include "milling/force/piece_force.hpp"
#include "milling/force/profile_quadrature.hpp"

namespace tribo::milling {
namespace {

// Widest step between samples, rad: with it the parabola through three samples misses a second harmonic by
// 1e-4.
constexpr double kStepRad = 1.0 / 24;
// A stretch shorter than this, in which nothing enters or leaves, bends by less than 1e-4 of the force
// between its ends.
constexpr double kShortRad = 0.015;
// Fewest steps over the whole entering or leaving of a rounded piece: one for each kPartialStepRad, within
// these limits. Two suffice for a short one, as its force runs nearly along a parabola. Fewest steps over any
// part of a piece at the tip; a piece is at the tip if z0 / z1 is below kTipShare.
constexpr double kPartialStepRad = 0.004, kFewestPartialSteps = 2, kPartialSteps = 6;
constexpr int kRootSteps = 4;
constexpr double kTipShare = 0.2;
// Borders closer than this count as one.
constexpr double kSameRad = 1e-9;
constexpr int kNoChange = -1;

}  // namespace

// Signed extremes of the four channels and extremes of the two squared sizes, from samples and parabolas
// through three samples.
class PeakFinder::Extremes {
  public:
    // The samples of one stretch come in order; `index` counts them from 0.
    void add(const Lanes& f, int index) {
        const double xy2 = f[0] * f[0] + f[1] * f[1];
        const double now[kChannels] = {f[0], f[1], f[2], f[3], xy2, xy2 + f[2] * f[2]};
        for (int i = 0; i < kChannels; ++i) {
            take(i, now[i]);
            if (index >= 2) {
                const double slope = now[i] - before_[i], bend = before_[i] - 2 * last_[i] + now[i];
                // The vertex is the extreme if it lies between the three samples.
                if (std::abs(slope) < 2 * std::abs(bend)) take(i, last_[i] - slope * slope / (8 * bend));
            }
            before_[i] = last_[i];
            last_[i] = now[i];
        }
    }
    double operator[](int i) const { return extreme_[i]; }

    static constexpr int kXy2 = 4, kSize2 = 5;

  private:
    static constexpr int kChannels = 6;
    void take(int i, double value) {
        if (std::abs(value) > std::abs(extreme_[i])) extreme_[i] = value;
    }
    double extreme_[kChannels] = {}, before_[kChannels] = {}, last_[kChannels] = {};
};

// `f` is a function of the rotation theta + phase - lag of a tooth. It starts to count at `angle` and ends,
// with the other changes of this piece, at `last_angle` (angles of the tip).
void PeakFinder::add_change(const EngagedEdge& edge, double angle, double last_angle, const TurnSeries& f,
                            double lag, double scale, double period) {
    const int n = static_cast<int>(std::floor((angle - edge.phase_rad) / period));
    const int last = static_cast<int>(std::floor((last_angle - edge.phase_rad) / period));
    changes_.emplace_back().add_shifted(f, lag - edge.phase_rad - n * period, scale);
    borders_.push_back({angle - edge.phase_rad - n * period, static_cast<int>(changes_.size()) - 1});
    for (int tooth = n + 1; tooth <= last; ++tooth) {
        series_.add_shifted(f, lag - edge.phase_rad - tooth * period, scale);
    }
}

void PeakFinder::add_border(const EngagedEdge& edge, double angle, double period) {
    const double along = (angle - edge.phase_rad) / period;
    borders_.push_back({(along - std::floor(along)) * period, kNoChange});
}

// Adds the times in which the tip of a tooth is between the two rotations.
void PeakFinder::add_partial(const EngagedEdge& edge, double from_tip, double to_tip, double period) {
    const int first = static_cast<int>(std::ceil((from_tip - edge.phase_rad - period) / period));
    const int last = static_cast<int>(std::floor((to_tip - edge.phase_rad) / period));
    for (int tooth = first; tooth <= last; ++tooth) {
        const double ahead = edge.phase_rad + tooth * period;
        partial_.push_back({&edge, ahead, from_tip - ahead, to_tip - ahead});
    }
}

void PeakFinder::add_edge(const EngagedEdges& tool, const EngagedEdge& edge) {
    const double period = tool.period_rad(), entry = edge.entry_rad, exit = edge.exit_rad;
    const double lag0 = edge.lag0_rad, lag1 = edge.lag1_rad;
    TurnSeries whole;  // the piece wholly in its window, as a function of its tip's rotation
    const auto sum_profile = [&] {
        visit_profile(
            tool, edge.chip, edge.z0_mm, edge.z1_mm,
            profile_rule(tool, edge.z0_mm, edge.z1_mm, 2 * (lag1 - lag0)),
            [&](double lag, const EdgeLoad& load) { whole.add_shifted(load_series(load), lag, 1); });
    };
    if (edge.straight()) {
        jumps_ = true;
        const double lag = 0.5 * (lag0 + lag1);
        if (edge.round) {
            sum_profile();
        } else {
            whole.add_shifted(load_series(edge.load), lag, edge.weight_mm);
        }
        add_change(edge, entry + lag, exit + lag, whole, 0, 1, period);
        add_change(edge, exit + lag, exit + lag, whole, 0, -1, period);
        return;
    }
    if (edge.round) {
        const double first = entry + lag0, last = exit + lag1, from = entry + lag1, to = exit + lag0;
        add_border(edge, first, period);
        add_border(edge, last, period);
        if (from < to) {
            add_partial(edge, first, from, period);
            add_partial(edge, to, last, period);
            sum_profile();
            add_change(edge, from, to, whole, 0, 1, period);
            add_change(edge, to, to, whole, 0, -1, period);
        } else {
            add_partial(edge, first, last, period);
            add_border(edge, from, period);
            add_border(edge, to, period);
        }
        return;
    }
    // The integral over a piece is the sum over its corners in the plane of rotation and lag. When the end of
    // the edge (lag) reaches the border of the window, the corner starts to add or subtract the integral from
    // the border on.
    const TurnSeries integral = load_integral(edge.load);
    const double per_rad = 1 / std::abs(tool.lag_per_mm()), end = exit + lag1;
    const auto corner = [&](double border, double sine, double cosine, double lag, double sign) {
        TurnSeries f = integral;
        f.of_one -= integral.at(border, sine, cosine);
        add_change(edge, border + lag, end, f, lag, sign * per_rad, period);
    };
    double sine, cosine;
    math::sincos(entry, sine, cosine);
    corner(entry, sine, cosine, lag0, 1);
    corner(entry, sine, cosine, lag1, -1);
    math::sincos(exit, sine, cosine);
    corner(exit, sine, cosine, lag0, -1);
    corner(exit, sine, cosine, lag1, 1);
}

// Samples the force between two borders.
void PeakFinder::scan(const EngagedEdges& tool, double from, double to, Extremes& extremes) {
    const double length = to - from, middle = 0.5 * (from + to);
    // Teeth that are entering or leaving. The series contains the teeth that are wholly within.
    here_.clear();
    bool root = false;
    double shortest = math::kTwoPi;  // of the rotations over which a tooth enters or leaves
    for (const PartialTooth& tooth : partial_) {
        if (middle < tooth.from || middle > tooth.to) continue;
        here_.push_back(&tooth);
        const EngagedEdge& edge = *tooth.edge;
        root = root || edge.z0_mm < kTipShare * edge.z1_mm;
        shortest = std::min(shortest, edge.lag1_rad - edge.lag0_rad);
    }
    const bool left_hand = tool.lag_per_mm() < 0;
    const double whole = std::clamp(shortest / kPartialStepRad, kFewestPartialSteps, kPartialSteps);
    const int part = static_cast<int>(std::ceil(whole * std::min(length / shortest, 1.0)));
    const int usual = length < kShortRad ? 1 : 2;
    const int least = here_.empty() ? usual : std::max(root ? kRootSteps : usual, part);
    const int steps = std::max(least, static_cast<int>(std::ceil((root ? 2 : 1) * length / kStepRad)));
    double sine, cosine, sin_step, cos_step;
    math::sincos(from, sine, cosine);
    math::sincos(length / steps, sin_step, cos_step);
    for (int i = 0; i <= steps; ++i) {
        // The force of a piece at the tip grows with the square root of the angle when it enters or leaves
        // (on a left-hand helix: towards the end). Therefore the steps are even in this root.
        const double part = static_cast<double>(i) / steps, rest = 1 - part,
                     share = !root       ? part
                             : left_hand ? 1 - rest * rest
                                         : part * part;
        const double theta = from + length * share;
        if (root && i > 0) math::sincos(theta, sine, cosine);
        // Helical edges have no jump at a border: the last sample of a stretch is the first of the next.
        if (i > 0 || from == 0 || jumps_) {
            last_ = series_.at(theta, sine, cosine);
            for (const PartialTooth* p : here_) last_ += Lanes(piece_force(tool, *p->edge, theta + p->ahead));
        }
        extremes.add(last_, i);
        const double turned = cosine * cos_step - sine * sin_step;
        sine = sine * cos_step + cosine * sin_step;
        cosine = turned;
    }
}

ForcePeaks PeakFinder::find(const EngagedEdges& tool) {
    series_ = {};
    jumps_ = false;
    changes_.clear();
    borders_.clear();
    partial_.clear();
    for (const EngagedEdge& edge : tool.edges()) add_edge(tool, edge);
    std::sort(borders_.begin(), borders_.end(), [](const Border& a, const Border& b) {
        return a.angle != b.angle ? a.angle < b.angle : a.change < b.change;
    });

    Extremes extremes;
    const double period = tool.period_rad();
    double from = 0;
    for (const Border& border : borders_) {
        if (border.angle - from > kSameRad) {
            scan(tool, from, border.angle, extremes);
            from = border.angle;
        }
        if (border.change != kNoChange) series_.add(changes_[static_cast<std::size_t>(border.change)]);
    }
    if (period - from > kSameRad) scan(tool, from, period, extremes);

    const contact::ToolForce mean = mean_force(tool);
    return {.mean_n = mean.force_n,
            .peak_n = {extremes[0], extremes[1], extremes[2]},
            .peak_xy_n = std::sqrt(extremes[Extremes::kXy2]),
            .peak_force_n = std::sqrt(extremes[Extremes::kSize2]),
            .mean_torque_nmm = mean.torque_nmm,
            .peak_torque_nmm = extremes[3]};
}

}  // namespace tribo::milling

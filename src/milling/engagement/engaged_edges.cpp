// SPDX-License-Identifier: MIT
#include "milling/engagement/engaged_edges.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/math.hpp"
#include "milling/tool/tooth_phases.hpp"

namespace tribo::milling {
namespace {

constexpr double kEvenPitchRad = 1e-9;   // pitch angles closer than this to even are even
constexpr double kNarrowestRad = 1e-12;  // narrower windows have a negligible force
constexpr std::size_t kUsualPieces = 64;
constexpr std::size_t kUsualPiecesPerFlute = 16;
// A step of a corner over which the window's border turns by more is divided, into so many pieces at most.
constexpr double kWindowStepRad = 0.1;
constexpr int kMostPieces = 8;
constexpr double kAlways = -2, kFull = 2;  // bounds of sin phi that exclude nothing

// Chip thickness of one point over the rotation: slope sin(phi + shift) + base, slope >= 0. All chips of one
// point have the same shift.
struct ChipLine {
    double slope = 0, base = 0;

    double at(double sine) const { return slope * sine + base; }
    // The chip is above 0 for sines above this value. kAlways or kFull if the thickness is constant over the
    // turn.
    double lowest_sine() const {
        if (slope > 0) return std::clamp(-base / slope, kAlways, kFull);
        return base > 0 ? kAlways : kFull;
    }
};
ChipLine line_of(const TurnLaw& h) {
    return {h.cosine == 0 ? std::abs(h.sine) : math::hypot(h.sine, h.cosine), h.constant};
}
// The load of a level edge that faces the shank.
EdgeLoad upward_load(const CuttingCoefficients& k, const ToolTravel& travel, double r0_mm, double r1_mm) {
    EdgeLoad load = bottom_load(k, -1.0 * travel, r0_mm, r1_mm);
    load.a = {-load.a.sine, -load.a.cosine, -load.a.constant};
    return load;
}
double shift_of(const TurnLaw& h) {
    return h.cosine == 0 ? (h.sine < 0 ? math::kPi : 0) : math::atan2(h.cosine, h.sine);
}

}  // namespace

// A stretch of the profile with the window of one band, and the point at which its chips are evaluated.
struct EngagedEdges::Part {
    EngagedEdge edge;
    ProfilePoint at;
    double r0_mm = 0, r1_mm = 0;  // on the bottom
};

EngagedEdges::EngagedEdges(const Cutter& cutter, const CuttingCoefficients& coefficients)
    : profile_(cutter),
      k_(coefficients),
      bottom_k_(coefficients),
      radius_(cutter.radius_mm()),
      corner_(cutter.corner_radius_mm()),
      lag_per_mm_(cutter.lag_rad(1)),
      flutes_(cutter.flutes),
      runout_(cutter.runout_mm),
      runout_rad_(cutter.runout_deg * math::kRadPerDeg) {
    assert(check(cutter) && check(coefficients));
    if (lag_per_mm_ < 0) {
        k_.kac = -k_.kac;
        k_.kae = -k_.kae;
    }
    const double even = math::kTwoPi / flutes_;
    uniform_ = runout_ == 0;
    for (const double pitch_deg : cutter.pitch_deg)
        if (std::abs(pitch_deg * math::kRadPerDeg - even) > kEvenPitchRad) uniform_ = false;
    phase_ = tooth_phases_rad(cutter);
    phase_.push_back(math::kTwoPi);
    offset_.resize(static_cast<std::size_t>(flutes_));
    edges_.reserve(uniform_ ? kUsualPieces : std::max(kUsualPieces, kUsualPiecesPerFlute * offset_.size()));
}

double EngagedEdges::period_rad() const {
    return uniform_ ? math::kTwoPi / flutes_ : math::kTwoPi;
}

void EngagedEdges::engage(const Engagement& engagement, const ToolTravel& feed) {
    assert(feed.across_mm >= 0 && std::isfinite(feed.down_mm));
    edges_.clear();
    for (const BottomBand& band : engagement.bottom) add_bottom(band, feed);
    for (const EngagementBand& band : engagement.bands) {
        assert(band.entry_rad >= 0 && band.exit_rad <= math::kTwoPi * (1 + 1e-15));
        Part part;
        part.edge.entry_rad = band.entry_rad;
        part.edge.exit_rad = band.exit_rad;
        const double z0 = std::max(band.z0_mm, 0.0), z1 = band.z1_mm, middle = std::clamp(corner_, z0, z1);
        if (!(z1 > z0)) continue;
        if (!profile_.parts().empty()) {
            part.edge.z0_mm = z0;
            part.edge.z1_mm = z1;
            add_profile(part, feed);
            continue;
        }
        if (middle > z0) {
            part.edge.round = true;
            part.edge.z0_mm = z0;
            part.edge.z1_mm = middle;
            add_lateral(part, feed);
        }
        if (z1 > middle) {
            part.edge.round = false;
            part.edge.z0_mm = middle;
            part.edge.z1_mm = z1;
            add_lateral(part, feed);
        }
    }
}

// Cuts a part where its chips change along the profile: a rounded part in steps of kappa, unless the tool
// only moves across its axis; a cylinder in heights if the axis turns.
void EngagedEdges::add_lateral(Part part, const ToolTravel& feed) {
    const double z0 = part.edge.z0_mm, z1 = part.edge.z1_mm;
    if (!part.edge.round) {
        const double change = (z1 - z0) * math::hypot(feed.turn_x_rad, feed.turn_y_rad);
        const auto speed = [&](double z) {
            return math::hypot(feed.across_mm + z * feed.turn_x_rad, z * feed.turn_y_rad);
        };
        const double most = std::max(speed(z0), speed(z1));
        const int steps =
            change > 0 ? std::max(1, static_cast<int>(std::ceil(change / (kFeedStep * most)))) : 1;
        for (int n = 0; n < steps; ++n) {
            part.edge.z0_mm = n == 0 ? z0 : z0 + (z1 - z0) * n / steps;
            part.edge.z1_mm = n + 1 == steps ? z1 : z0 + (z1 - z0) * (n + 1) / steps;
            part.at = {radius_, 0.5 * (part.edge.z0_mm + part.edge.z1_mm), 1, 0};
            add_teeth(part, feed);
        }
        return;
    }
    const double kappa0 = math::acos(std::clamp(1 - z0 / corner_, -1.0, 1.0));
    const double kappa1 = math::acos(std::clamp(1 - z1 / corner_, -1.0, 1.0));
    const bool alike = feed.down_mm == 0 && !feed.turns();
    const int steps = alike ? 1 : std::max(1, static_cast<int>(std::ceil((kappa1 - kappa0) / kKappaStepRad)));
    const auto at = [&](double kappa) {
        double s, c;
        math::sincos(kappa, s, c);
        return ProfilePoint{radius_ - corner_ + corner_ * s, corner_ * (1 - c), s, c};
    };
    // The rotation at which the chip begins.
    const auto begin = [&](double kappa) {
        return math::asin(std::clamp(line_of(normal_travel(feed, at(kappa))).lowest_sine(), -1.0, 1.0));
    };
    for (int n = 0; n < steps; ++n) {
        const double from = kappa0 + (kappa1 - kappa0) * n / steps;
        const double to = kappa0 + (kappa1 - kappa0) * (n + 1) / steps;
        // Where the chip comes to nothing along the step, the edge force ends at once.
        const double change = alike ? 0 : std::abs(begin(to) - begin(from));
        const int pieces = std::clamp(static_cast<int>(std::ceil(change / kWindowStepRad)), 1, kMostPieces);
        for (int k = 0; k < pieces; ++k) {
            const double low = from + (to - from) * k / pieces, high = from + (to - from) * (k + 1) / pieces;
            part.edge.z0_mm = n == 0 && k == 0 ? z0 : corner_ * (1 - math::cos(low));
            part.edge.z1_mm = n + 1 == steps && k + 1 == pieces ? z1 : corner_ * (1 - math::cos(high));
            part.at = at(0.5 * (low + high));
            add_teeth(part, feed);
        }
    }
}

// Cuts a band of a profile at its joints, where its chips change along an arc or with a turn of the axis, and
// where its edge lags too much for one set of Gauss points.
void EngagedEdges::add_profile(Part band, const ToolTravel& feed) {
    constexpr double kLagStepRad = 1.5;
    profile_.over_parts(
        band.edge.z0_mm, band.edge.z1_mm, [&](const CutterProfile::Part& along, double z0, double z1) {
            Part part = band;
            part.edge.round = true;
            part.edge.part = static_cast<int>(&along - profile_.parts().data());
            const double s0 = along.at_height(z0), s1 = along.at_height(z1), size = s1 - s0;
            const bool alike = feed.down_mm == 0 && !feed.turns() && uniform_;
            double steps = (z1 - z0) * std::abs(lag_per_mm_) / kLagStepRad;
            if (!alike && along.element.is_arc())
                steps = std::max(steps, size / std::abs(along.element.radius_mm) / kProfileStepRad);
            if (feed.turns()) {
                const auto speed = [&](double s) {
                    const TurnLaw h = normal_travel(feed, along.at(s));
                    return math::hypot(h.sine, h.cosine) + std::abs(h.constant);
                };
                const double change = size * math::hypot(feed.turn_x_rad, feed.turn_y_rad);
                steps = std::max(
                    steps, std::min(change / (kFeedStep * std::max(speed(s0), speed(s1))), 1 / kFeedStep));
            }
            const int count = std::max(1, static_cast<int>(std::ceil(steps)));
            const auto height = [&](int n) {
                return n == 0 ? z0 : n == count ? z1 : along.at(s0 + size * n / count).height_mm;
            };
            for (int n = 0; n < count; ++n) {
                part.edge.z0_mm = height(n);
                part.edge.z1_mm = height(n + 1);
                part.at = along.at(s0 + size * (n + 0.5) / count);
                if (part.edge.z1_mm > part.edge.z0_mm) add_teeth(part, feed);
            }
        });
}

// Where the axis turns, the bottom dips on one side of a line. In narrow rings the chip in the middle is
// accurate enough for both ends of an edge.
void EngagedEdges::add_bottom(const BottomBand& band, const ToolTravel& feed) {
    const int steps = feed.turns() ? static_cast<int>(std::ceil(1 / kFeedStep)) : 1;
    Part part;
    part.edge.entry_rad = band.entry_rad;
    part.edge.exit_rad = band.exit_rad;
    for (int n = 0; n < steps; ++n) {
        part.r0_mm = band.r0_mm + (band.r1_mm - band.r0_mm) * n / steps;
        part.r1_mm = band.r0_mm + (band.r1_mm - band.r0_mm) * (n + 1) / steps;
        if (!(part.r1_mm > part.r0_mm)) continue;
        part.at = point_of(band, 0.5 * (part.r0_mm + part.r1_mm));
        add_teeth(part, feed);
    }
}

void EngagedEdges::add_teeth(const Part& part, const ToolTravel& feed) {
    if (uniform_) {
        const TurnLaw h = normal_travel(feed, part.at);
        return add_window(part, {feed, 0}, 0, shift_of(h), line_of(h).lowest_sine(), kFull);
    }
    // Run-out is constant over cells of lag.
    const double per_mm = std::abs(lag_per_mm_);
    const double lag0 = part.edge.z0_mm * per_mm, lag1 = part.edge.z1_mm * per_mm;
    const int first = static_cast<int>(std::floor(lag0 / kRunoutCellRad));
    const int last = std::max(first, static_cast<int>(std::ceil(lag1 / kRunoutCellRad)) - 1);
    if (first == last) {
        const double lag = lag_per_mm_ != 0 ? std::copysign((first + 0.5) * kRunoutCellRad, lag_per_mm_) : 0;
        return add_teeth_apart(part, feed, lag);
    }
    for (int cell = first; cell <= last; ++cell) {
        Part piece = part;
        if (cell > first) piece.edge.z0_mm = cell * kRunoutCellRad / per_mm;
        if (cell < last) piece.edge.z1_mm = (cell + 1) * kRunoutCellRad / per_mm;
        if (!(piece.edge.z1_mm > piece.edge.z0_mm)) continue;
        add_teeth_apart(piece, feed, std::copysign((cell + 0.5) * kRunoutCellRad, lag_per_mm_));
    }
}

// Adds each tooth separately, `lag` behind its tip.
void EngagedEdges::add_teeth_apart(const Part& part, const ToolTravel& feed, double lag) {
    const ToolTravel per_turn = static_cast<double>(flutes_) * feed;
    const double shift = shift_of(normal_travel(per_turn, part.at));
    const auto teeth = static_cast<std::size_t>(flutes_);
    for (std::size_t j = 0; j < teeth; ++j) {
        offset_[j] = runout_ * math::cos(runout_rad_ - phase_[j] + lag);
    }
    for (std::size_t j = 0; j < teeth; ++j) {
        // The chip to the surface that the tooth n places ahead left.
        const auto chip_after = [&](std::size_t n) {
            const std::size_t ahead = (j + n) % teeth;
            const double turn = j + n < teeth ? 0 : math::kTwoPi;
            const double share = (phase_[ahead] + turn - phase_[j]) / math::kTwoPi;
            return Chip{share * per_turn, offset_[j] - offset_[ahead]};
        };
        const auto line = [&](std::size_t n) { return line_of(thickness(chip_after(n), part.at)); };
        double sine = kAlways;
        for (std::size_t n = 1; n <= teeth; ++n) sine = std::max(sine, line(n).lowest_sine());
        // Follows the lower envelope of the lines, whose slope grows with n: starts with the lowest line at
        // `sine`, then changes to ever smaller slopes.
        const double start = std::max(sine, -1.0);
        std::size_t n = 1;
        for (std::size_t other = 2; other <= teeth; ++other) {
            if (line(other).at(start) < line(n).at(start)) n = other;
        }
        while (sine < 1) {
            const ChipLine chip = line(n);
            double end = kFull;
            std::size_t next = n;
            for (std::size_t other = 1; other < n; ++other) {
                const ChipLine flatter = line(other);
                const double slope = chip.slope - flatter.slope;
                if (!(slope > 0)) continue;
                const double crossing = std::max((flatter.base - chip.base) / slope, start);
                if (crossing < end) {
                    end = crossing;
                    next = other;
                }
            }
            add_window(part, chip_after(n), phase_[j], shift, sine, end);
            if (next == n) break;
            n = next;
            sine = end;
        }
    }
}

// Adds the piece where sin(phi + shift) lies between the bounds.
void EngagedEdges::add_window(const Part& part, const Chip& chip, double phase, double shift, double sine_low,
                              double sine_high) {
    if (sine_low >= 1 || sine_high <= -1 || sine_low >= sine_high) return;
    EngagedEdge edge = part.edge;
    edge.chip = chip;
    edge.phase_rad = phase;
    if (part.r1_mm > 0) {
        edge.weight_mm = 1;
        edge.load = part.at.cos_kappa > 0 ? bottom_load(bottom_k_, chip.travel, part.r0_mm, part.r1_mm)
                                          : upward_load(bottom_k_, chip.travel, part.r0_mm, part.r1_mm);
        edge.lag0_rad = edge.lag1_rad = part.at.height_mm * lag_per_mm_;
        edge.edge_torque_nmm = k_.kte * 0.5 * (part.r1_mm * part.r1_mm - part.r0_mm * part.r0_mm);
    } else {
        edge.weight_mm = edge.z1_mm - edge.z0_mm;
        const double lag0 = edge.z0_mm * lag_per_mm_, lag1 = edge.z1_mm * lag_per_mm_;
        edge.lag0_rad = std::min(lag0, lag1);
        edge.lag1_rad = std::max(lag0, lag1);
        if (edge.part >= 0) {
            const CutterProfile::Part& along = profile_.parts()[static_cast<std::size_t>(edge.part)];
            edge.edge_torque_nmm =
                k_.kte * along.radius_integral(along.at_height(edge.z0_mm), along.at_height(edge.z1_mm));
        } else if (edge.round) {
            // Integral of r over the profile: the core and the circle.
            const double c0 = 1 - edge.z0_mm / corner_, c1 = std::max(1 - edge.z1_mm / corner_, -1.0);
            edge.edge_torque_nmm =
                k_.kte * corner_ *
                ((radius_ - corner_) * (math::acos(c1) - math::acos(c0)) + (edge.z1_mm - edge.z0_mm));
        } else {
            edge.load = edge_load(k_, chip, part.at);
            edge.edge_torque_nmm = k_.kte * radius_ * edge.weight_mm;
        }
    }
    const auto clip = [&](double from, double to) {
        EngagedEdge clipped = edge;
        clipped.entry_rad = std::max(edge.entry_rad, from);
        clipped.exit_rad = std::min(edge.exit_rad, to);
        if (clipped.exit_rad - clipped.entry_rad > kNarrowestRad) push(clipped);
    };
    if (sine_low <= -1 && sine_high >= 1) return clip(0, math::kTwoPi);
    // sin rises between the bounds from `low` to `high`, falls from pi - high to pi - low, and repeats every
    // turn.
    const double low = sine_low <= -1 ? -math::kHalfPi : math::asin(sine_low);
    const double high = sine_high >= 1 ? math::kHalfPi : math::asin(sine_high);
    const auto clip_turns = [&](double from, double to) {
        for (int turn = -1; turn <= 2; ++turn)
            clip(from - shift + turn * math::kTwoPi, to - shift + turn * math::kTwoPi);
    };
    if (sine_high >= 1) return clip_turns(low, math::kPi - low);
    if (sine_low <= -1) return clip_turns(math::kPi - high, math::kTwoPi + high);
    clip_turns(low, high);
    clip_turns(math::kPi - high, math::kPi - low);
}

double EngagedEdges::mean_edge_torque_nmm() const {
    const double teeth = uniform_ ? flutes_ : 1;
    double sum = 0;
    for (const EngagedEdge& edge : edges_) sum += edge.edge_torque_nmm * (edge.exit_rad - edge.entry_rad);
    return sum * teeth / math::kTwoPi;
}

// Adds a piece. Adjacent bands with the same window become one piece.
void EngagedEdges::push(const EngagedEdge& edge) {
    constexpr std::size_t kLookBack = 4;
    const std::size_t oldest = edges_.size() > kLookBack ? edges_.size() - kLookBack : 0;
    for (std::size_t i = edges_.size(); i > oldest; --i) {
        EngagedEdge& below = edges_[i - 1];
        if (edge.part < 0 && edge.z1_mm > 0 && below.z1_mm == edge.z0_mm && below.round == edge.round &&
            below.phase_rad == edge.phase_rad && below.entry_rad == edge.entry_rad &&
            below.exit_rad == edge.exit_rad && below.chip == edge.chip &&
            (edge.round || !edge.chip.travel.turns())) {
            below.z1_mm = edge.z1_mm;
            below.weight_mm += edge.weight_mm;
            below.edge_torque_nmm += edge.edge_torque_nmm;
            below.lag0_rad = std::min(below.lag0_rad, edge.lag0_rad);
            below.lag1_rad = std::max(below.lag1_rad, edge.lag1_rad);
            return;
        }
    }
    edges_.push_back(edge);
}

}  // namespace tribo::milling

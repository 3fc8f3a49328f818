// SPDX-License-Identifier: MIT
#include "milling/engaged_edges.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/math.hpp"

namespace tribo::milling {
namespace {

constexpr double kEvenPitchRad = 1e-9;   // pitch angles closer than this to even are even
constexpr double kNarrowestRad = 1e-12;  // windows narrower than this carry no force worth a piece
constexpr std::size_t kUsualPieces = 64;
constexpr std::size_t kUsualPiecesPerFlute = 16;
constexpr double kAlways = -2, kFull = 2;  // bounds of sin phi that exclude nothing

// h > 0 for sin phi above this; kAlways or kFull where the chip does not vary over the turn.
double lowest_sine(const Chip& chip, double cot_kappa) {
    const double base = chip.offset_mm + chip.down_mm * cot_kappa;
    if (chip.across_mm > 0) return std::clamp(-base / chip.across_mm, kAlways, kFull);
    return base > 0 ? kAlways : kFull;
}

}  // namespace

// A stretch of the profile with the window of one band, and the angle kappa at which its chips are judged.
struct EngagedEdges::Part {
    EngagedEdge edge;
    double cot_kappa = 0;
};

EngagedEdges::EngagedEdges(const Cutter& cutter, const CuttingCoefficients& coefficients)
    : k_(coefficients),
      radius_(cutter.radius_mm()),
      corner_(cutter.corner_radius_mm()),
      lag_per_mm_(cutter.lag_rad(1)),
      flutes_(cutter.flutes),
      runout_(cutter.runout_mm),
      runout_rad_(cutter.runout_deg * math::kRadPerDeg) {
    assert(check(cutter) && check(coefficients));
    const double even = math::kTwoPi / flutes_;
    uniform_ = runout_ == 0;
    phase_.push_back(0);
    for (int j = 0; j < flutes_; ++j) {
        const double pitch = cutter.pitch_deg.empty()
                                 ? even
                                 : cutter.pitch_deg[static_cast<std::size_t>(j)] * math::kRadPerDeg;
        if (std::abs(pitch - even) > kEvenPitchRad) uniform_ = false;
        phase_.push_back(phase_.back() + pitch);
    }
    const double closing = math::kTwoPi / phase_.back();
    for (double& phase : phase_) phase *= closing;
    phase_.back() = math::kTwoPi;
    offset_.resize(static_cast<std::size_t>(flutes_));
    edges_.reserve(uniform_ ? kUsualPieces : std::max(kUsualPieces, kUsualPiecesPerFlute * offset_.size()));
}

double EngagedEdges::period_rad() const {
    return uniform_ ? math::kTwoPi / flutes_ : math::kTwoPi;
}

void EngagedEdges::engage(const Engagement& engagement, const FeedPerTooth& feed) {
    assert(feed.feed_per_tooth_mm >= 0 && std::isfinite(feed.axial_feed_per_tooth_mm));
    edges_.clear();
    bottom_ = {};
    for (const EngagementBand& band : engagement.bands) {
        assert(band.entry_rad >= 0 && band.exit_rad <= math::kTwoPi * (1 + 1e-15));
        Part part;
        part.edge.entry_rad = band.entry_rad;
        part.edge.exit_rad = band.exit_rad;
        const double z0 = std::max(band.z0_mm, 0.0), z1 = band.z1_mm, middle = std::clamp(corner_, z0, z1);
        if (!(z1 > z0)) continue;
        if (middle > z0) {
            part.edge.round = true;
            part.edge.z0_mm = z0;
            part.edge.z1_mm = middle;
            add_part(part, feed);
        }
        if (z1 > middle) {
            part.edge.round = false;
            part.edge.z0_mm = middle;
            part.edge.z1_mm = z1;
            add_part(part, feed);
        }
    }
    const double rim = radius_ - corner_;
    if (engagement.bottom_fraction > 0 && feed.axial_feed_per_tooth_mm > 0 && rim > 0) {
        const EdgeLoad load = edge_load(k_, {.down_mm = feed.axial_feed_per_tooth_mm}, 0, 1, 1);
        const double edges = flutes_ * engagement.bottom_fraction;
        bottom_ = {{0, 0, edges * rim * load.a}, edges * 0.5 * rim * rim * load.t};
    }
}

// Follows the border of the cut along a rounded part that moves along its axis, where it depends on kappa.
void EngagedEdges::add_part(Part part, const FeedPerTooth& feed) {
    if (!part.edge.round || feed.axial_feed_per_tooth_mm == 0) return add_teeth(part, feed);
    const double z0 = part.edge.z0_mm, z1 = part.edge.z1_mm;
    const double kappa0 = math::acos(std::clamp(1 - z0 / corner_, -1.0, 1.0));
    const double kappa1 = math::acos(std::clamp(1 - z1 / corner_, -1.0, 1.0));
    const int steps = std::max(1, static_cast<int>(std::ceil((kappa1 - kappa0) / kKappaStepRad)));
    for (int n = 0; n < steps; ++n) {
        const double low = kappa0 + (kappa1 - kappa0) * n / steps;
        const double high = kappa0 + (kappa1 - kappa0) * (n + 1) / steps;
        part.edge.z0_mm = n == 0 ? z0 : corner_ * (1 - math::cos(low));
        part.edge.z1_mm = n + 1 == steps ? z1 : corner_ * (1 - math::cos(high));
        part.cot_kappa = 1 / math::tan(0.5 * (low + high));
        add_teeth(part, feed);
    }
}

void EngagedEdges::add_teeth(const Part& part, const FeedPerTooth& feed) {
    if (uniform_) {
        const Chip chip{feed.feed_per_tooth_mm, 0, feed.axial_feed_per_tooth_mm};
        return add_window(part, chip, 0, lowest_sine(chip, part.cot_kappa), kFull);
    }
    const double across = flutes_ * feed.feed_per_tooth_mm, down = flutes_ * feed.axial_feed_per_tooth_mm;
    const double lag0 = part.edge.z0_mm * lag_per_mm_, lag1 = part.edge.z1_mm * lag_per_mm_;
    const auto teeth = static_cast<std::size_t>(flutes_);
    const int first = static_cast<int>(std::floor(lag0 / kRunoutCellRad));
    const int last = std::max(first, static_cast<int>(std::ceil(lag1 / kRunoutCellRad)) - 1);
    for (int cell = first; cell <= last; ++cell) {
        Part piece = part;
        if (cell > first) piece.edge.z0_mm = cell * kRunoutCellRad / lag_per_mm_;
        if (cell < last) piece.edge.z1_mm = (cell + 1) * kRunoutCellRad / lag_per_mm_;
        if (!(piece.edge.z1_mm > piece.edge.z0_mm)) continue;
        const double lag = lag_per_mm_ > 0 ? (cell + 0.5) * kRunoutCellRad : 0;
        for (std::size_t j = 0; j < teeth; ++j) {
            offset_[j] = runout_ * math::cos(runout_rad_ - phase_[j] + lag);
        }
        for (std::size_t j = 0; j < teeth; ++j) {
            // The surface that the tooth n places ahead left.
            const auto chip_after = [&](std::size_t n) {
                const std::size_t ahead = (j + n) % teeth;
                const double turn = j + n < teeth ? 0 : math::kTwoPi;
                const double share = (phase_[ahead] + turn - phase_[j]) / math::kTwoPi;
                return Chip{share * across, offset_[j] - offset_[ahead], share * down};
            };
            double sine = kAlways;
            for (std::size_t n = 1; n <= teeth; ++n) {
                sine = std::max(sine, lowest_sine(chip_after(n), part.cot_kappa));
            }
            // Along the lower envelope of the lines h(sin phi), whose slope grows with n: from the least at
            // `sine` to ever smaller slopes.
            const auto at = [&](const Chip& c, double s) {
                return c.across_mm * s + c.offset_mm + c.down_mm * part.cot_kappa;
            };
            const double start = std::max(sine, -1.0);
            std::size_t n = 1;
            for (std::size_t other = 2; other <= teeth; ++other) {
                if (at(chip_after(other), start) < at(chip_after(n), start)) n = other;
            }
            while (sine < 1) {
                const Chip chip = chip_after(n);
                double end = kFull;
                std::size_t next = n;
                for (std::size_t other = 1; other < n; ++other) {
                    const Chip flatter = chip_after(other);
                    const double slope = chip.across_mm - flatter.across_mm;
                    if (!(slope > 0)) continue;
                    const double crossing = std::max((at(flatter, 0) - at(chip, 0)) / slope, start);
                    if (crossing < end) {
                        end = crossing;
                        next = other;
                    }
                }
                add_window(piece, chip, phase_[j], sine, end);
                if (next == n) break;
                n = next;
                sine = end;
            }
        }
    }
}

// Adds the piece where sin phi lies between the bounds.
void EngagedEdges::add_window(const Part& part, const Chip& chip, double phase, double sine_low,
                              double sine_high) {
    if (sine_low >= 1 || sine_high <= -1 || sine_low >= sine_high) return;
    EngagedEdge edge = part.edge;
    edge.chip = chip;
    edge.phase_rad = phase;
    edge.lag0_rad = edge.z0_mm * lag_per_mm_;
    edge.lag1_rad = edge.z1_mm * lag_per_mm_;
    if (!edge.round) edge.load = edge_load(k_, chip, 1, 0, radius_);
    const auto clip = [&](double from, double to) {
        EngagedEdge clipped = edge;
        clipped.entry_rad = std::max(edge.entry_rad, from);
        clipped.exit_rad = std::min(edge.exit_rad, to);
        if (clipped.exit_rad - clipped.entry_rad > kNarrowestRad) push(clipped);
    };
    if (sine_low <= -1 && sine_high >= 1) return clip(0, math::kTwoPi);
    // Rising from `low` to `high`, falling from pi - high to pi - low, and again every turn.
    const double low = sine_low <= -1 ? -math::kHalfPi : math::asin(sine_low);
    const double high = sine_high >= 1 ? math::kHalfPi : math::asin(sine_high);
    const auto clip_turns = [&](double from, double to) {
        for (const double turn : {-math::kTwoPi, 0.0, math::kTwoPi}) clip(from + turn, to + turn);
    };
    if (sine_high >= 1) return clip_turns(low, math::kPi - low);
    if (sine_low <= -1) return clip_turns(math::kPi - high, math::kTwoPi + high);
    clip_turns(low, high);
    clip_turns(math::kPi - high, math::kPi - low);
}

// Bands on top of each other with one window are one piece.
void EngagedEdges::push(const EngagedEdge& edge) {
    constexpr std::size_t kLookBack = 4;
    const std::size_t oldest = edges_.size() > kLookBack ? edges_.size() - kLookBack : 0;
    for (std::size_t i = edges_.size(); i > oldest; --i) {
        EngagedEdge& below = edges_[i - 1];
        if (below.z1_mm == edge.z0_mm && below.round == edge.round && below.phase_rad == edge.phase_rad &&
            below.entry_rad == edge.entry_rad && below.exit_rad == edge.exit_rad && below.chip == edge.chip) {
            below.z1_mm = edge.z1_mm;
            below.lag1_rad = edge.lag1_rad;
            return;
        }
    }
    edges_.push_back(edge);
}

}  // namespace tribo::milling

// SPDX-License-Identifier: MIT
#include "dynamics/vibration.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "base/math.hpp"
#include "dynamics/engaged_zone.hpp"
#include "milling/engagement/engaged_edges.hpp"

namespace tribo::dynamics {
namespace {

// Lag of an edge, and angle of its profile, over a slice: which tooth left the surface is asked once in it.
constexpr double kSliceRad = 0.25, kProfileRad = 0.4;
// Teeth whose surface may still stand where those after them jumped over it.
constexpr std::size_t kMemory = 3;
// Nodes and weights of Gauss and Legendre on [-1, 1].
constexpr std::array<double, 4> kNodes{-0.86113631159405258, -0.33998104358485626, 0.33998104358485626,
                                       0.86113631159405258};
constexpr std::array<double, 4> kWeights{0.34785484513745386, 0.65214515486254614, 0.65214515486254614,
                                         0.34785484513745386};

double chip_at(const milling::TurnLaw& law, double sine, double cosine) {
    return law.sine * sine + law.cosine * cosine + law.constant;
}

}  // namespace

void Vibration::Oscillator::pass_half_a_step() {
    const double q = q_by_q * q_mm + q_by_v * v_mm_per_s;
    v_mm_per_s = v_by_q * q_mm + v_by_v * v_mm_per_s;
    q_mm = q;
}

void Vibration::Oscillator::push(double force_n) {
    q_mm += q_push * force_n;
    v_mm_per_s += v_push * force_n;
}

Vibration::Vibration(std::span<const Mode> modes, const milling::Cutter& cutter,
                     const milling::CuttingCoefficients& coefficients, double rate_hz)
    : cutter_(cutter),
      coefficients_(milling::EngagedEdges(cutter, coefficients).coefficients()),
      rate_hz_(rate_hz),
      lag_per_mm_(cutter.lag_rad(1)) {
    const double half_s = 0.5 / rate_hz;
    for (const Mode& mode : modes) {
        const double w = math::kTwoPi * mode.frequency_hz, zeta = mode.damping_ratio;
        const double damped = w * std::sqrt(1 - zeta * zeta), decay = math::exp(-zeta * w * half_s);
        double sine, cosine;
        math::sincos(damped * half_s, sine, cosine);
        Oscillator o{};
        o.direction = normalized(mode.direction);
        o.q_by_q = decay * (cosine + zeta * w / damped * sine);
        o.q_by_v = decay * sine / damped;
        o.v_by_q = -decay * w * w / damped * sine;
        o.v_by_v = decay * (cosine - zeta * w / damped * sine);
        o.q_push = (1 - o.q_by_q) / mode.stiffness_n_per_mm;
        o.v_push = -o.v_by_q / mode.stiffness_n_per_mm;
        oscillators_.push_back(o);
    }
    const auto teeth = static_cast<std::size_t>(cutter.flutes);
    std::vector<double> pitch(teeth, math::kTwoPi / static_cast<double>(teeth));
    for (std::size_t n = 0; n < cutter.pitch_deg.size(); ++n)
        pitch[n] = cutter.pitch_deg[n] * math::kRadPerDeg;
    double phase = 0;
    for (const double p : pitch) {
        phase_rad_.push_back(phase);
        phase += p;
    }
    // With run-out the deepest of all teeth may have left the surface.
    memory_ = cutter.runout_mm == 0 ? kMemory : std::max(kMemory, teeth);
    alike_ = cutter.pitch_deg.empty();
    for (std::size_t tooth = 0; tooth < (alike_ ? 1 : teeth); ++tooth) {
        double back = 0;
        for (std::size_t k = 0; k < memory_; ++k) {
            back += pitch[(tooth + k) % teeth];
            passages_.push_back({.back_rad = back});
        }
    }
}

void Vibration::engage(std::span<const milling::EngagementBand> bands, double feed_per_tooth_mm,
                       double spindle_rpm) {
    slices_.clear();
    for (milling::EngagementBand band : bands) {
        const double corner = std::clamp(cutter_.corner_radius_mm(), band.z0_mm, band.z1_mm);
        const double top = band.z1_mm;
        band.z1_mm = corner;
        add_slices(band, true);
        band.z0_mm = corner;
        band.z1_mm = top;
        add_slices(band, false);
    }
    feed_mm_per_rad_ = feed_per_tooth_mm * cutter_.flutes / math::kTwoPi;
    step_rad_ = spindle_rpm * math::kTwoPi / 60 / rate_hz_;
    double longest = 0;
    for (const Passage& passage : passages_) longest = std::max(longest, passage.back_rad);
    const auto needed = std::bit_ceil(static_cast<std::size_t>(std::ceil(longest / step_rad_)) + 8);
    if (needed <= displacement_mm_.size()) return;
    std::vector<double> rotations(needed, 0);
    std::vector<Vec3> displacements(needed);
    for (std::size_t back = 1; back <= std::min(samples_, displacement_mm_.size()); ++back) {
        const std::size_t sample = samples_ - back;
        rotations[sample & (needed - 1)] = sample_rad_[place(sample)];
        displacements[sample & (needed - 1)] = displacement_mm_[place(sample)];
    }
    sample_rad_ = std::move(rotations);
    displacement_mm_ = std::move(displacements);
}

void Vibration::add_slices(const milling::EngagementBand& band, bool round) {
    const double height = band.z1_mm - band.z0_mm;
    if (!(height > 0)) return;
    double count = std::ceil(std::abs(lag_per_mm_) * height / kSliceRad);
    if (round) {
        const double corner = cutter_.corner_radius_mm();
        const auto kappa = [&](double z) { return math::acos(std::clamp(1 - z / corner, -1.0, 1.0)); };
        count = std::max(count, std::ceil((kappa(band.z1_mm) - kappa(band.z0_mm)) / kProfileRad));
    }
    count = std::max(count, 1.0);
    for (int n = 0; n < static_cast<int>(count); ++n) {
        Slice slice{band, round};
        slice.band.z0_mm = band.z0_mm + height * n / count;
        slice.band.z1_mm = band.z0_mm + height * (n + 1) / count;
        slices_.push_back(slice);
    }
}

VibrationSample Vibration::step() {
    VibrationSample sample;
    Vec3 foretold{};
    for (Oscillator& o : oscillators_) {
        o.pass_half_a_step();
        foretold += (o.q_mm + o.q_push * dot(force_n_, o.direction)) * o.direction;
    }
    force_n_ = cutting_force(foretold);
    sample.force_n = force_n_;
    for (Oscillator& o : oscillators_) {
        const double along = dot(force_n_, o.direction);
        o.push(along);
        sample.displacement_mm += o.q_mm * o.direction;
        o.pass_half_a_step();
        o.push(along);
    }
    remember(rotation_rad_, sample.displacement_mm);
    rotation_rad_ += step_rad_;
    return sample;
}

void Vibration::remember(double rotation_rad, Vec3 displacement_mm) {
    sample_rad_[place(samples_)] = rotation_rad;
    displacement_mm_[place(samples_)] = displacement_mm;
    ++samples_;
}

// By a cubic through the four samples around it. Before the first sample nothing was displaced.
Vec3 Vibration::displacement_at(Passage& passage) const {
    const double at_rad = rotation_rad_ - passage.back_rad;
    if (samples_ < 3 || !(at_rad > 0)) return {};
    std::size_t& n = passage.cursor;
    while (n + 3 < samples_ && sample_rad_[place(n + 1)] <= at_rad) ++n;
    const double from = sample_rad_[place(n)], to = sample_rad_[place(n + 1)];
    const double t = (at_rad - from) / (to - from);
    const Vec3 before = n == 0 ? Vec3{} : displacement_mm_[place(n - 1)];
    return -t * (t - 1) * (t - 2) / 6 * before +
           (t + 1) * (t - 1) * (t - 2) / 2 * displacement_mm_[place(n)] -
           (t + 1) * t * (t - 2) / 2 * displacement_mm_[place(n + 1)] +
           (t + 1) * t * (t - 1) / 6 * displacement_mm_[place(n + 2)];
}

Vec3 Vibration::cutting_force(Vec3 displacement_mm) {
    for (Passage& passage : passages_) {
        passage.beyond_mm = displacement_mm - displacement_at(passage);
        passage.beyond_mm.x += feed_mm_per_rad_ * passage.back_rad;
    }
    Vec3 sum{};
    for (std::size_t tooth = 0; tooth < phase_rad_.size(); ++tooth) {
        for (const Slice& slice : slices_)
            sum += slice.round ? round_force(tooth, slice.band) : cylinder_force(tooth, slice.band);
    }
    return sum;
}

// The law of the surface that stands highest at this rotation.
milling::TurnLaw Vibration::chip(std::size_t tooth, double rotation_rad, double lag_rad,
                                 const milling::ProfilePoint& at) const {
    double sine, cosine;
    math::sincos(rotation_rad, sine, cosine);
    const auto radius = [&](std::size_t of_tooth) {
        return cutter_.runout_mm *
               math::cos(cutter_.runout_deg * math::kRadPerDeg - phase_rad_[of_tooth] + lag_rad);
    };
    const std::size_t teeth = phase_rad_.size();
    const double own = cutter_.runout_mm == 0 ? 0 : radius(tooth);
    milling::TurnLaw thinnest;
    double least = 0;
    for (std::size_t k = 0; k < memory_; ++k) {
        const Vec3 beyond = passages_[(alike_ ? 0 : tooth * memory_) + k].beyond_mm;
        const double offset = cutter_.runout_mm == 0 ? 0 : own - radius((tooth + k + 1) % teeth);
        const milling::TurnLaw law{beyond.x * at.sin_kappa, beyond.y * at.sin_kappa,
                                   offset * at.sin_kappa - beyond.z * at.cos_kappa};
        const double thickness = chip_at(law, sine, cosine);
        if (k > 0 && thickness >= least) continue;
        thinnest = law;
        least = thickness;
    }
    return thinnest;
}

Vec3 Vibration::cylinder_force(std::size_t tooth, const milling::EngagementBand& band) const {
    const double tip = tip_rad(tooth);
    const EngagedZone zone = engaged_zone(band, tip, lag_per_mm_);
    double height = zone.z1_mm - zone.z0_mm;
    if (!(height > 0)) return {};
    double low = tip - lag_per_mm_ * zone.z1_mm, high = tip - lag_per_mm_ * zone.z0_mm;
    if (low > high) std::swap(low, high);
    const double middle = 0.5 * (low + high);
    const milling::ProfilePoint at{.radius_mm = cutter_.radius_mm()};
    const milling::TurnLaw law = chip(tooth, middle, tip - middle, at);
    const auto thickness = [&](double rotation) {
        double sine, cosine;
        math::sincos(rotation, sine, cosine);
        return chip_at(law, sine, cosine);
    };
    const double at_low = thickness(low), at_high = thickness(high);
    if (at_low <= 0 && at_high <= 0) return {};
    if (at_low <= 0 || at_high <= 0) {
        // The chip ends within the slice: almost on a straight line, for it is short.
        const double border = low + (high - low) * at_low / (at_low - at_high), whole = high - low;
        (at_low <= 0 ? low : high) = border;
        height *= (high - low) / whole;
    }
    return milling::segment_force(milling::edge_load(coefficients_, law, at), low, high, height).force_n;
}

Vec3 Vibration::round_force(std::size_t tooth, const milling::EngagementBand& band) const {
    const double tip = tip_rad(tooth);
    const EngagedZone zone = engaged_zone(band, tip, lag_per_mm_);
    if (!(zone.z1_mm > zone.z0_mm)) return {};
    const double corner = cutter_.corner_radius_mm();
    const double from = math::acos(std::clamp(1 - zone.z0_mm / corner, -1.0, 1.0)),
                 to = math::acos(std::clamp(1 - zone.z1_mm / corner, -1.0, 1.0));
    Vec3 sum{};
    for (std::size_t n = 0; n < kNodes.size(); ++n) {
        const double kappa = 0.5 * (from + to) + 0.5 * (to - from) * kNodes[n];
        milling::ProfilePoint at;
        math::sincos(kappa, at.sin_kappa, at.cos_kappa);
        at.radius_mm = cutter_.radius_mm() - corner * (1 - at.sin_kappa);
        at.height_mm = corner * (1 - at.cos_kappa);
        const double lag = lag_per_mm_ * at.height_mm;
        const milling::TurnLaw law = chip(tooth, tip - lag, lag, at);
        double sine, cosine;
        math::sincos(tip - lag, sine, cosine);
        if (chip_at(law, sine, cosine) <= 0) continue;
        const milling::EdgeLoad load = milling::edge_load(coefficients_, law, at);
        sum += (0.5 * (to - from) * kWeights[n] * corner) *
               milling::force_at_rotation(load, sine, cosine).force_n;
    }
    return sum;
}

}  // namespace tribo::dynamics

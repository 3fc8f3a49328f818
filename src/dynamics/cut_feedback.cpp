// SPDX-License-Identifier: MIT
#include "dynamics/cut_feedback.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "milling/force/edge_force.hpp"

namespace tribo::dynamics {
namespace {

// Nodes and weights of Gauss and Legendre on [-1, 1].
constexpr std::array<double, 4> kNodes{0.18343464249564980, 0.52553240991632899, 0.79666647741362674,
                                       0.96028985649753623};
constexpr std::array<double, 4> kWeights{0.36268378337836198, 0.31370664587788729, 0.22238103445337447,
                                         0.10122853629037626};

// Teeth after which the pitches repeat.
std::size_t pattern_of(const std::vector<double>& pitch) {
    for (std::size_t p = 1; p < pitch.size(); ++p) {
        if (pitch.size() % p != 0) continue;
        bool repeats = true;
        for (std::size_t n = p; n < pitch.size(); ++n) repeats = repeats && pitch[n] == pitch[n - p];
        if (repeats) return p;
    }
    return pitch.size();
}

// Moves an angle into [from, from + 2 pi).
double wrapped(double angle, double from) {
    return angle - math::kTwoPi * std::floor((angle - from) / math::kTwoPi);
}

}  // namespace

CutFeedback::CutFeedback(const milling::Cutter& cutter, const milling::CuttingCoefficients& coefficients,
                         std::span<const milling::EngagementBand> bands, double spindle_rpm)
    : cutter_(cutter),
      coefficients_(coefficients),
      bands_(bands.begin(), bands.end()),
      turn_rad_per_s_(spindle_rpm * math::kTwoPi / 60),
      lag_per_mm_(cutter.lag_rad(1)) {
    const auto teeth = static_cast<std::size_t>(cutter.flutes);
    std::vector<double> pitch(teeth, math::kTwoPi / static_cast<double>(teeth));
    for (std::size_t n = 0; n < cutter.pitch_deg.size(); ++n)
        pitch[n] = cutter.pitch_deg[n] * math::kRadPerDeg;
    double phase = 0;
    const std::size_t pattern = pattern_of(pitch);
    for (std::size_t n = 0; n < teeth; ++n) {
        phase_rad_.push_back(phase);
        delay_s_.push_back(pitch[n] / turn_rad_per_s_);
        if (n < pattern) period_s_ += delay_s_.back();
        phase += pitch[n];
    }
    find_events();
}

double CutFeedback::rotation(int tooth, double t_s) const {
    return turn_rad_per_s_ * t_s + phase_rad_[static_cast<std::size_t>(tooth)];
}

template <class Use>
void CutFeedback::for_each_zone(double rotation_rad, Use&& use) const {
    for (const milling::EngagementBand& band : bands_)
        dynamics::for_each_zone(band, rotation_rad, lag_per_mm_, use);
}

Matrix3 CutFeedback::stiffness(int tooth, double t_s) const {
    const double rotation_rad = rotation(tooth, t_s), corner = cutter_.corner_radius_mm();
    double sine, cosine;
    math::sincos(rotation_rad, sine, cosine);
    Matrix3 sum{};
    for_each_zone(rotation_rad, [&](EngagedZone cut) {
        if (cut.z0_mm < corner) add_rounded(rotation_rad, {cut.z0_mm, std::min(cut.z1_mm, corner)}, sum);
        if (cut.z1_mm > corner) add_straight(sine, cosine, {std::max(cut.z0_mm, corner), cut.z1_mm}, sum);
    });
    return sum;
}

// In closed form: a mean over an angle is the value in its middle times sin(x) / x.
void CutFeedback::add_straight(double tip_sine, double tip_cosine, EngagedZone cut, Matrix3& sum) const {
    const double height = cut.z1_mm - cut.z0_mm;
    const milling::HalfSpan lag = milling::half_span(0.5 * lag_per_mm_ * (cut.z0_mm + cut.z1_mm));
    const double sine = tip_sine * lag.cosine - tip_cosine * lag.sine,
                 cosine = tip_cosine * lag.cosine + tip_sine * lag.sine;
    const milling::HalfSpan half = milling::half_span(0.5 * std::abs(lag_per_mm_) * height);
    const double once = height * half.sinc;
    const double twice = once * half.cosine;  // of the double angle
    const double ss = 0.5 * height - 0.5 * twice * (cosine * cosine - sine * sine), cc = height - ss;
    const double sc = twice * sine * cosine;
    const milling::CuttingCoefficients& k = coefficients_;
    sum[0] += {-k.ktc * sc - k.krc * ss, -k.ktc * cc - k.krc * sc, 0};
    sum[1] += {k.ktc * ss - k.krc * sc, k.ktc * sc - k.krc * cc, 0};
    sum[2] += {-k.kac * once * sine, -k.kac * once * cosine, 0};
}

void CutFeedback::add_rounded(double rotation_rad, EngagedZone cut, Matrix3& sum) const {
    // Over the angle of the edge's normal to the axis, with the length of the edge for its width.
    const double corner = cutter_.corner_radius_mm();
    const double from = math::acos(1 - cut.z0_mm / corner), to = math::acos(1 - cut.z1_mm / corner);
    const double half = 0.5 * (to - from), middle = 0.5 * (to + from);
    for (int n = 0; n < 8; ++n) {
        const auto node = static_cast<std::size_t>(n / 2);
        double sin_kappa, cos_kappa, sine, cosine;
        math::sincos(middle + (n % 2 == 0 ? -half : half) * kNodes[node], sin_kappa, cos_kappa);
        math::sincos(rotation_rad - lag_per_mm_ * corner * (1 - cos_kappa), sine, cosine);
        const Vec3 outward{sine * sin_kappa, cosine * sin_kappa, -cos_kappa};
        const Vec3 along{cosine, -sine, 0};                                    // the edge moves
        const Vec3 meridian{sine * cos_kappa, cosine * cos_kappa, sin_kappa};  // away from the tip
        const Vec3 force =
            -coefficients_.ktc * along - coefficients_.krc * outward - coefficients_.kac * meridian;
        const double width = corner * half * kWeights[node];
        sum[0] += (width * force.x) * outward;
        sum[1] += (width * force.y) * outward;
        sum[2] += (width * force.z) * outward;
    }
}

double CutFeedback::spring(double t_s) const {
    double sum = 0;
    for (int tooth = 0; tooth < teeth(); ++tooth)
        for (const Vec3& row : stiffness(tooth, t_s)) sum += length(row);
    return sum;
}

bool CutFeedback::cuts(double t_s) const {
    bool any = false;
    for (int tooth = 0; tooth < teeth(); ++tooth)
        for_each_zone(rotation(tooth, t_s), [&](EngagedZone) { any = true; });
    return any;
}

void CutFeedback::find_events() {
    events_s_ = {0, period_s_};
    for (int tooth = 0; tooth < teeth(); ++tooth) {
        for (const milling::EngagementBand& band : bands_) {
            // Where the rounded part ends too, S has a kink.
            const double corner = std::clamp(cutter_.corner_radius_mm(), band.z0_mm, band.z1_mm);
            for (const double z : {band.z0_mm, corner, band.z1_mm}) {
                for (const double angle : {band.entry_rad, band.exit_rad}) {
                    const double way = wrapped(angle + lag_per_mm_ * z - rotation(tooth, 0), 0);
                    const double t = way / turn_rad_per_s_;
                    if (t < period_s_) events_s_.push_back(t);
                }
            }
        }
    }
    std::sort(events_s_.begin(), events_s_.end());
    // Closer ones are one.
    const double least = 1e-9 * period_s_;
    std::vector<double> apart{0};
    for (const double t : events_s_)
        if (t - apart.back() > least) apart.push_back(t);
    if (period_s_ - apart.back() <= least && apart.size() > 1) apart.back() = period_s_;
    events_s_ = std::move(apart);
}

}  // namespace tribo::dynamics

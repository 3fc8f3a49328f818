// SPDX-License-Identifier: MIT
#include "dynamics/cut_feedback.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"

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

CutFeedback::Zone CutFeedback::zone(const milling::EngagementBand& band, double rotation_rad) const {
    if (lag_per_mm_ == 0) {
        const double at = wrapped(rotation_rad, band.entry_rad);
        return at < band.exit_rad ? Zone{band.z0_mm, band.z1_mm} : Zone{band.z0_mm, band.z0_mm};
    }
    // The angle of the band's bottom, less the lag up to z, lies between entry and exit.
    const double bottom = rotation_rad - lag_per_mm_ * band.z0_mm;
    const double most = lag_per_mm_ * (band.z1_mm - band.z0_mm);
    const double lowest = std::min(0.0, -most), highest = std::max(0.0, -most);
    // One turn of the helix at a time: a band lower than a turn is cut once.
    const double at = wrapped(bottom + lowest, band.entry_rad - (highest - lowest)) - lowest;
    double a = (at - band.exit_rad) / lag_per_mm_, b = (at - band.entry_rad) / lag_per_mm_;
    if (a > b) std::swap(a, b);
    const double height = band.z1_mm - band.z0_mm;
    a = std::clamp(a, 0.0, height);
    b = std::clamp(b, 0.0, height);
    return {band.z0_mm + a, band.z0_mm + b};
}

Matrix3 CutFeedback::stiffness(int tooth, double t_s) const {
    const double rotation_rad = rotation(tooth, t_s);
    Matrix3 sum{};
    for (const milling::EngagementBand& band : bands_) {
        const Zone cut = zone(band, rotation_rad);
        const double half = 0.5 * (cut.z1_mm - cut.z0_mm), middle = 0.5 * (cut.z1_mm + cut.z0_mm);
        if (half <= 0) continue;
        const double corner = cutter_.corner_radius_mm();
        for (int n = 0; n < 8; ++n) {
            const auto node = static_cast<std::size_t>(n / 2);
            const double z = middle + (n % 2 == 0 ? -half : half) * kNodes[node];
            const double cos_kappa = z < corner ? (corner - z) / corner : 0;
            const double sin_kappa = std::sqrt(1 - cos_kappa * cos_kappa);
            double sine, cosine;
            math::sincos(rotation_rad - lag_per_mm_ * z, sine, cosine);
            const Vec3 outward{sine * sin_kappa, cosine * sin_kappa, -cos_kappa};
            const Vec3 along{cosine, -sine, 0};                                    // the edge moves
            const Vec3 meridian{sine * cos_kappa, cosine * cos_kappa, sin_kappa};  // away from the tip
            const Vec3 force =
                -coefficients_.ktc * along - coefficients_.krc * outward - coefficients_.kac * meridian;
            const double width = half * kWeights[node] / sin_kappa;
            sum[0] += (width * force.x) * outward;
            sum[1] += (width * force.y) * outward;
            sum[2] += (width * force.z) * outward;
        }
    }
    return sum;
}

bool CutFeedback::cuts(double t_s) const {
    for (int tooth = 0; tooth < teeth(); ++tooth) {
        for (const milling::EngagementBand& band : bands_) {
            const Zone cut = zone(band, rotation(tooth, t_s));
            if (cut.z1_mm > cut.z0_mm) return true;
        }
    }
    return false;
}

void CutFeedback::find_events() {
    events_s_ = {0, period_s_};
    for (int tooth = 0; tooth < teeth(); ++tooth) {
        for (const milling::EngagementBand& band : bands_) {
            for (const double z : {band.z0_mm, band.z1_mm}) {
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

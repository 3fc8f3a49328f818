// SPDX-License-Identifier: MIT
#include "milling/force/edge_force.hpp"

#include <cmath>

#include "base/math.hpp"

namespace tribo::milling {
namespace {

// Up to this angle a Taylor series is used, accurate to 1e-16; most pieces of an edge turn less.
constexpr double kSeriesRad = 0.5;

void sinc_and_cos(double x, double& sinc, double& cosine) {
    if (std::abs(x) > kSeriesRad) {
        double sine;
        math::sincos(x, sine, cosine);
        sinc = sine / x;
        return;
    }
    const double z = x * x;
    sinc = 1 - z * (1.0 / 6) *
                   (1 - z * (1.0 / 20) *
                            (1 - z * (1.0 / 42) *
                                     (1 - z * (1.0 / 72) * (1 - z * (1.0 / 110) * (1 - z * (1.0 / 156))))));
    cosine = 1 - z * (1.0 / 2) *
                     (1 - z * (1.0 / 12) *
                              (1 - z * (1.0 / 30) *
                                       (1 - z * (1.0 / 56) *
                                                (1 - z * (1.0 / 90) *
                                                         (1 - z * (1.0 / 132) * (1 - z * (1.0 / 182)))))));
}

}  // namespace

TurnWindow window_above(const TurnLaw& law, double least) {
    const double slope = math::hypot(law.sine, law.cosine), base = law.constant - least;
    if (!(slope + base > 0)) return {};
    if (base >= slope) return {0, math::kTwoPi};
    const double border = math::asin(-base / slope);
    const double from = border - math::atan2(law.cosine, law.sine);
    const double start = from - math::kTwoPi * std::floor(from / math::kTwoPi);
    return {start, start + math::kPi - 2 * border};
}

TurnLaw normal_travel(const ToolTravel& travel, const ProfilePoint& at) {
    // The normal is (sin kappa sin phi, sin kappa cos phi, -cos kappa).
    const double arm = at.height_mm * at.sin_kappa + at.radius_mm * at.cos_kappa;
    return {travel.across_mm * at.sin_kappa + travel.turn_x_rad * arm, travel.turn_y_rad * arm,
            travel.down_mm * at.cos_kappa};
}

TurnLaw thickness(const Chip& chip, const ProfilePoint& at) {
    TurnLaw h = normal_travel(chip.travel, at);
    h.constant += chip.offset_mm * at.sin_kappa;
    return h;
}

EdgeLoad edge_load(const CuttingCoefficients& k, const Chip& chip, const ProfilePoint& at) {
    return edge_load(k, thickness(chip, at), at);
}

EdgeLoad bottom_load(const CuttingCoefficients& k, const ToolTravel& travel, double r0_mm, double r1_mm) {
    const double width = r1_mm - r0_mm, middle = 0.5 * (r0_mm + r1_mm);
    const double first = width * middle;                                                // integral of r
    const double second = width * (r0_mm * r0_mm + r0_mm * r1_mm + r1_mm * r1_mm) / 3;  // of r^2
    // `of_one` and `of_r` are the integrals for the constant part and the turning part of the chip.
    const auto law = [&](double shear, double edge, double of_one, double of_r) {
        return TurnLaw{shear * travel.turn_x_rad * of_r, shear * travel.turn_y_rad * of_r,
                       (shear * travel.down_mm + edge) * of_one};
    };
    return {.t = law(k.ktc, k.kte, width, first),
            .r = law(-k.kac, -k.kae, width, first),
            .a = law(k.krc, k.kre, width, first),
            .m = law(k.ktc, k.kte, first, second)};
}

contact::ToolForce segment_force(const EdgeLoad& load, double phi_low, double phi_high, double height_mm) {
    double sin_mid, cos_mid;
    math::sincos(0.5 * (phi_low + phi_high), sin_mid, cos_mid);
    return segment_force(load, sin_mid, cos_mid, half_span(0.5 * (phi_high - phi_low)), height_mm);
}

HalfSpan half_span(double angle_rad) {
    HalfSpan half;
    sinc_and_cos(angle_rad, half.sinc, half.cosine);
    half.sine = half.sinc * angle_rad;
    return half;
}

contact::ToolForce flute_segment_force(const CuttingCoefficients& k, double radius_mm,
                                       double feed_per_tooth_mm, double phi_low, double phi_high,
                                       double height_mm) {
    const Chip chip{{.across_mm = feed_per_tooth_mm}};
    return segment_force(edge_load(k, chip, {.radius_mm = radius_mm}), phi_low, phi_high, height_mm);
}

}  // namespace tribo::milling

// SPDX-License-Identifier: MIT
#include "milling/edge_force.hpp"

#include "base/math.hpp"

namespace tribo::milling {
namespace {

// Taylor series, good to 1e-16 up to here; most pieces of an edge turn less.
constexpr double kSeriesRad = 0.5;

void sinc_and_cos(double x, double& sinc, double& cosine) {
    if (x > kSeriesRad) {
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

EdgeLoad edge_load(const CuttingCoefficients& k, const Chip& chip, double sin_kappa, double cos_kappa,
                   double radius_mm) {
    const double wave = chip.across_mm * sin_kappa;
    const double base = chip.offset_mm * sin_kappa + chip.down_mm * cos_kappa;
    // Shear force per chip thickness and edge force, in the directions t, in-plane r and a.
    const double rc = k.krc * sin_kappa - k.kac * cos_kappa, re = k.kre * sin_kappa - k.kae * cos_kappa;
    const double ac = k.krc * cos_kappa + k.kac * sin_kappa, ae = k.kre * cos_kappa + k.kae * sin_kappa;
    EdgeLoad load;
    load.t_sine = k.ktc * wave;
    load.r_sine = rc * wave;
    load.a_sine = ac * wave;
    load.m_sine = radius_mm * load.t_sine;
    load.t = k.ktc * base + k.kte;
    load.r = rc * base + re;
    load.a = ac * base + ae;
    load.m = radius_mm * load.t;
    return load;
}

contact::ToolForce force_at_rotation(const EdgeLoad& load, double sin_phi, double cos_phi) {
    const double t = load.t_sine * sin_phi + load.t, r = load.r_sine * sin_phi + load.r;
    return {{-t * cos_phi - r * sin_phi, t * sin_phi - r * cos_phi, load.a_sine * sin_phi + load.a},
            load.m_sine * sin_phi + load.m};
}

contact::ToolForce segment_force(const EdgeLoad& load, double phi_low, double phi_high, double height_mm) {
    double sin_mid, cos_mid;
    math::sincos(0.5 * (phi_low + phi_high), sin_mid, cos_mid);
    double q, cos_half;  // sin(d/2) / (d/2), cos(d/2)
    sinc_and_cos(0.5 * (phi_high - phi_low), q, cos_half);
    const double s = q * cos_half;  // sin d / d
    const double s_sin2 = s * 2 * sin_mid * cos_mid, s_cos2 = s * (1 - 2 * sin_mid * sin_mid);
    const double b = height_mm, qs = q * sin_mid, qc = q * cos_mid;
    return {{-b * (0.5 * (load.t_sine * s_sin2 + load.r_sine * (1 - s_cos2)) + load.t * qc + load.r * qs),
             b * (0.5 * (load.t_sine * (1 - s_cos2) - load.r_sine * s_sin2) + load.t * qs - load.r * qc),
             b * (load.a_sine * qs + load.a)},
            b * (load.m_sine * qs + load.m)};
}

contact::ToolForce flute_segment_force(const CuttingCoefficients& k, double radius_mm,
                                       double feed_per_tooth_mm, double phi_low, double phi_high,
                                       double height_mm) {
    const Chip chip{.across_mm = feed_per_tooth_mm};
    return segment_force(edge_load(k, chip, 1, 0, radius_mm), phi_low, phi_high, height_mm);
}

}  // namespace tribo::milling

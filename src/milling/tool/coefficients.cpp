// SPDX-License-Identifier: MIT
#include "milling/tool/coefficients.hpp"

#include <cmath>
#include <string>

#include "base/math.hpp"
#include "base/text/limit_text.hpp"

namespace tribo::milling {

Result<void> check(const CuttingCoefficients& k) {
    struct Number {
        const char* name;
        double value;
        const Limit& limit;
    };
    for (const auto& [name, value, limit] :
         {Number{"ktc", k.ktc, kLimits.ktc}, Number{"krc", k.krc, kLimits.krc},
          Number{"kac", k.kac, kLimits.krc}, Number{"kte", k.kte, kLimits.kte},
          Number{"kre", k.kre, kLimits.kre}, Number{"kae", k.kae, kLimits.kre}}) {
        if (limit.range.contains(value)) continue;
        return fail(std::string(name) + " is " + plain_number(value), range_remedy(limit));
    }
    return {};
}

// Legend: alpha rake, i inclination, eta chip flow angle, phi_c shear angle, beta_n friction angle in the
// normal plane.
CuttingCoefficients oblique_coefficients(const OrthogonalData& data, double rake_rad, double inclination_rad,
                                         double chip_mm) {
    const double alpha = rake_rad, alpha_deg = rake_rad * math::kDegPerRad, i = inclination_rad, eta = i;
    const double ratio = (data.ratio + data.ratio_per_deg * alpha_deg) *
                         math::pow(chip_mm, data.exponent + data.exponent_per_deg * alpha_deg);
    double sin_alpha, cos_alpha;
    math::sincos(alpha, sin_alpha, cos_alpha);
    const double phi_c = math::atan2(ratio * cos_alpha, 1 - ratio * sin_alpha);
    const double friction = (data.friction_deg + data.friction_deg_per_deg * alpha_deg) * math::kRadPerDeg;
    const double beta_n = math::atan(math::tan(friction) * math::cos(eta));
    const double tan_i = math::tan(i), tan_eta = math::tan(eta), sin_beta = math::sin(beta_n);
    const double over = math::cos(phi_c + beta_n - alpha);
    const double d = std::sqrt(over * over + tan_eta * tan_eta * sin_beta * sin_beta);
    const double shear = data.shear_stress_n_per_mm2 / (math::sin(phi_c) * d);
    double sin_lean, cos_lean;
    math::sincos(beta_n - alpha, sin_lean, cos_lean);
    return {.ktc = shear * (cos_lean + tan_i * tan_eta * sin_beta),
            .krc = shear * sin_lean / math::cos(i),
            .kac = shear * (cos_lean * tan_i - tan_eta * sin_beta),
            .kte = data.kte,
            .kre = data.kre,
            .kae = data.kae};
}

}  // namespace tribo::milling

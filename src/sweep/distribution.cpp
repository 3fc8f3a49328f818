// SPDX-License-Identifier: MIT
#include "sweep/distribution.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>

#include "base/math.hpp"

namespace tribo::sweep {
namespace {

// Standard deviations between the middle of a normal distribution and its 95th percentile.
constexpr double kNineOfTen = 1.6448536269514722;

// Coefficients from the constant term up.
template <std::size_t Count>
double polynomial(const double (&coefficients)[Count], double x) {
    double sum = 0;
    for (std::size_t n = Count; n-- > 0;) sum = sum * x + coefficients[n];
    return sum;
}

// Wichura 1988: rational approximations of the middle, of the tails, and of the far tails.
constexpr double kMiddleOver[]{3.3871328727963666080,   1.3314166789178437745e2, 1.9715909503065514427e3,
                               1.3731693765509461125e4, 4.5921953931549871457e4, 6.7265770927008700853e4,
                               3.3430575583588128105e4, 2.5090809287301226727e3};
constexpr double kMiddleUnder[]{1.0,
                                4.2313330701600911252e1,
                                6.8718700749205790830e2,
                                5.3941960214247511077e3,
                                2.1213794301586595867e4,
                                3.9307895800092710610e4,
                                2.8729085735721942674e4,
                                5.2264952788528545610e3};
constexpr double kTailOver[]{1.42343711074968357734,    4.63033784615654529590,   5.76949722146069140550,
                             3.64784832476320460504,    1.27045825245236838258,   2.41780725177450611770e-1,
                             2.27238449892691845833e-2, 7.74545014278341407640e-4};
constexpr double kTailUnder[]{1.0,
                              2.05319162663775882187,
                              1.67638483018380384940,
                              6.89767334985100004550e-1,
                              1.48103976427480074590e-1,
                              1.51986665636164571966e-2,
                              5.47593808499534494600e-4,
                              1.05075007164441684324e-9};
constexpr double kFarOver[]{6.65790464350110377720,    5.46378491116411436990,    1.78482653991729133580,
                            2.96560571828504891230e-1, 2.65321895265761230930e-2, 1.24266094738807843860e-3,
                            2.71155556874348757815e-5, 2.01033439929228813265e-7};
constexpr double kFarUnder[]{1.0,
                             5.99832206555887937690e-1,
                             1.36929880922735805310e-1,
                             1.48753612908506148525e-2,
                             7.86869131745613259100e-4,
                             1.84631831751005468180e-5,
                             1.42151175831644588870e-7,
                             2.04426310338993978564e-15};

}  // namespace

double normal_quantile(double below) {
    assert(below > 0 && below < 1);
    const double off = below - 0.5;
    if (std::abs(off) <= 0.425) {
        const double r = 0.180625 - off * off;
        return off * polynomial(kMiddleOver, r) / polynomial(kMiddleUnder, r);
    }
    const double r = std::sqrt(-math::log(std::min(below, 1 - below)));
    const double size = r <= 5 ? polynomial(kTailOver, r - 1.6) / polynomial(kTailUnder, r - 1.6)
                               : polynomial(kFarOver, r - 5) / polynomial(kFarUnder, r - 5);
    return off < 0 ? -size : size;
}

double quantile(const Distribution& d, double below) {
    switch (d.kind) {
        case DistributionKind::uniform:
            return d.a + below * (d.b - d.a);
        case DistributionKind::normal:
            return d.a + d.b * normal_quantile(below);
        case DistributionKind::lognormal:
            return d.a * math::exp(math::log(1 + d.b) / kNineOfTen * normal_quantile(below));
    }
    return 0;
}

}  // namespace tribo::sweep

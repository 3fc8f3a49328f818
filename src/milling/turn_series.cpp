// SPDX-License-Identifier: MIT
#include "milling/turn_series.hpp"

#include "base/math.hpp"

namespace tribo::milling {

void TurnSeries::add(const TurnSeries& f) {
    of_one += f.of_one;
    of_angle += f.of_angle;
    of_cos += f.of_cos;
    of_sin += f.of_sin;
    of_cos2 += f.of_cos2;
    of_sin2 += f.of_sin2;
}

void TurnSeries::add_shifted(const TurnSeries& f, double by_rad, double scale) {
    double sine, cosine;
    math::sincos(by_rad, sine, cosine);
    const double s1 = scale * sine, c1 = scale * cosine;
    const double s2 = scale * 2 * sine * cosine, c2 = scale * (1 - 2 * sine * sine);
    of_one += (f.of_one - f.of_angle * by_rad) * scale;
    of_angle += f.of_angle * scale;
    of_cos += f.of_cos * c1 - f.of_sin * s1;
    of_sin += f.of_cos * s1 + f.of_sin * c1;
    of_cos2 += f.of_cos2 * c2 - f.of_sin2 * s2;
    of_sin2 += f.of_cos2 * s2 + f.of_sin2 * c2;
}

TurnSeries load_series(const EdgeLoad& f) {
    const double t = 0.5 * f.t_sine, r = 0.5 * f.r_sine;
    return {.of_one = {-r, t, f.a, f.m},
            .of_angle = {},
            .of_cos = {-f.t, -f.r, 0, 0},
            .of_sin = {-f.r, f.t, f.a_sine, f.m_sine},
            .of_cos2 = {r, -t, 0, 0},
            .of_sin2 = {-t, -r, 0, 0}};
}

TurnSeries load_integral(const EdgeLoad& f) {
    const double t = 0.25 * f.t_sine, r = 0.25 * f.r_sine;
    return {.of_one = {},
            .of_angle = {-2 * r, 2 * t, f.a, f.m},
            .of_cos = {f.r, -f.t, -f.a_sine, -f.m_sine},
            .of_sin = {-f.t, -f.r, 0, 0},
            .of_cos2 = {t, r, 0, 0},
            .of_sin2 = {r, -t, 0, 0}};
}

}  // namespace tribo::milling

// SPDX-License-Identifier: MIT
#include "milling/force/turn_series.hpp"

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
    // x = -t cos - r sin, y = t sin - r cos, with sin^2, cos^2 and sin cos as second harmonics.
    const TurnLaw &t = f.t, &r = f.r;
    const double plus = 0.5 * (t.sine + r.cosine), minus = 0.5 * (t.cosine - r.sine);
    return {.of_one = {-0.5 * (t.cosine + r.sine), 0.5 * (t.sine - r.cosine), f.a.constant, f.m.constant},
            .of_angle = {},
            .of_cos = {-t.constant, -r.constant, f.a.cosine, f.m.cosine},
            .of_sin = {-r.constant, t.constant, f.a.sine, f.m.sine},
            .of_cos2 = {-minus, -plus, 0, 0},
            .of_sin2 = {-plus, minus, 0, 0}};
}

TurnSeries load_integral(const EdgeLoad& load) {
    const TurnSeries f = load_series(load);
    return {.of_one = {},
            .of_angle = f.of_one,
            .of_cos = f.of_sin * -1,
            .of_sin = f.of_cos,
            .of_cos2 = f.of_sin2 * -0.5,
            .of_sin2 = f.of_cos2 * 0.5};
}

}  // namespace tribo::milling

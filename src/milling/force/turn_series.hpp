// SPDX-License-Identifier: MIT
// A tool force as a function of an angle: constant, linear, first and second harmonic of each channel. The
// force of a helical edge on a cylinder has this form between two borders of its engagement.
#pragma once

#include "milling/force/edge_force.hpp"
#include "milling/force/lanes.hpp"

namespace tribo::milling {

// f(x) = of_one + of_angle x + of_cos cos x + of_sin sin x + of_cos2 cos 2x + of_sin2 sin 2x.
// Real-time safe, any thread.
struct TurnSeries {
    Lanes of_one, of_angle, of_cos, of_sin, of_cos2, of_sin2;

    void add(const TurnSeries& f);
    // Adds f(x - by) times scale.
    void add_shifted(const TurnSeries& f, double by_rad, double scale);

    Lanes at(double angle_rad, double sine, double cosine) const {
        const double cos2 = 1 - 2 * sine * sine, sin2 = 2 * sine * cosine;
        return (of_one + of_angle * angle_rad) + (of_cos * cosine + of_sin * sine) +
               (of_cos2 * cos2 + of_sin2 * sin2);
    }
};

// Returns the load at a rotation, per mm.
TurnSeries load_series(const EdgeLoad& load);
// Returns the integral of load_series() over the rotation, without the constant of integration.
TurnSeries load_integral(const EdgeLoad& load);

}  // namespace tribo::milling

// SPDX-License-Identifier: MIT
// A travel along a quadratic with one axis and an even rise, as the pieces of a helix are: its nearest
// instant without the search of sweep_search.inl, for flat and ball cutters. Allocates nothing; any thread.
#pragma once

#include <optional>

#include "milling/sweep/sweep_lines.hpp"

namespace tribo::milling {

class UprightCurve {
  public:
    // None if the axis turns or the rise is uneven, or for a cutter with another bottom.
    static std::optional<UprightCurve> of(const ToolProfile& tool, const CurvedLine& line);

    struct Nearest {
        double distance_mm;  // to the tool without its flat top
        double t;
    };
    // `point` is relative to the tip at the start. None where the path bends so much that the point may be
    // equally far from two instants.
    std::optional<Nearest> nearest(Vec3 point) const;
    // The least height of the point above the tip.
    double lowest_mm(Vec3 point) const;

  private:
    // Of a point's distance to the axis: the square.
    double squared_mm2(Vec3 across, double t) const;
    // Half of the rate of that square by t: a cubic polynomial.
    struct HalfRate {
        double of_one, of_t, of_t2, of_t3;

        double at(double t) const { return of_one + t * (of_t + t * (of_t2 + t * of_t3)); }
        double slope(double t) const { return of_t + t * (2 * of_t2 + t * 3 * of_t3); }
        // A step of t that is rounding.
        double rounding() const;
    };
    HalfRate half_rate(Vec3 across) const;
    Nearest nearest_of_flat(Vec3 across, double height) const;
    Nearest nearest_of_ball(Vec3 across, double height) const;
    // The zero of an increasing function of t with a slope above 0: 0 or 1 where it has none between. Ends
    // with a step below `still`.
    template <class F>
    static double zero_of(double start, double still, const F& value_and_slope);

    CutterKind kind_ = CutterKind::flat;
    double radius_mm_ = 0;
    Vec3 axis_, first_, second_;  // unit axis; coefficients of t and t^2 of the tip's way across it
    double first_squared_ = 0, second_squared_ = 0, turned_ = 0;  // their products
    double rise_mm_ = 0;                                          // over the whole travel
    double least_speed_squared_ = 0, turned_back_ = 0;            // of the way across the axis
};

}  // namespace tribo::milling

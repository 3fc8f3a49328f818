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
    // Whether the distance is known without a search to be at least bound_mm.
    bool is_beyond(Vec3 point, double bound_mm) const;
    // The least height of the point above the tip.
    double lowest_mm(Vec3 point) const;

    // x along the travel at its start.
    const Frame& frame() const { return frame_; }
    const UprightLine& line() const { return line_; }

  private:
    // Points are in the frame, relative to the tip at the start. Of a point's distance to the axis: the
    // square.
    double squared_mm2(Vec3 point, double t) const;
    // Half of the rate of that square by t: a cubic polynomial.
    struct HalfRate {
        double of_one, of_t, of_t2, of_t3;

        double at(double t) const { return of_one + t * (of_t + t * (of_t2 + t * of_t3)); }
        double slope(double t) const { return of_t + t * (2 * of_t2 + t * 3 * of_t3); }
        // A step of t that is rounding.
        double rounding() const;
    };
    HalfRate half_rate(Vec3 point) const;
    Nearest nearest_of_flat(Vec3 point) const;
    Nearest nearest_of_ball(Vec3 point) const;
    // The zero of an increasing function of t with a slope above 0: 0 or 1 where it has none between. Ends
    // with a step below `still`.
    template <class F>
    static double zero_of(double start, double still, const F& value_and_slope);

    CutterKind kind_ = CutterKind::flat;
    double radius_mm_ = 0;
    Frame frame_;
    UprightLine line_;
    double sag_mm_ = 0;  // of the path across the axis beside its chord
};

}  // namespace tribo::milling

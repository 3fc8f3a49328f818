// SPDX-License-Identifier: MIT
// The bands of an engagement in slices, over which the edge lags little.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "dynamics/engaged_zone.hpp"
#include "milling/engagement/engagement.hpp"
#include "milling/force/edge_force.hpp"
#include "milling/tool/cutter.hpp"

namespace tribo::dynamics {

// Lag of an edge, and angle of its profile, over a slice: which tooth left the surface is asked once in it.
inline constexpr double kSliceRad = 0.25, kProfileRad = 0.4;

// Sine and cosine of the angle by which a point lags behind the tip of its edge.
struct Lag {
    double sine = 0, cosine = 1;

    // Of a point that lags by a little more, at most half a radian.
    Lag more(double rad) const {
        const milling::HalfSpan turn = milling::half_span(rad);
        return {sine * turn.cosine + cosine * turn.sine, cosine * turn.cosine - sine * turn.sine};
    }
};

// A piece of the cylinder.
struct EdgePiece {
    milling::ProfilePoint middle;
    Lag lag;  // of the middle
    double height_mm = 0;
    milling::HalfSpan half;
};

// A point of the rounded part, with the length of edge for which it stands.
struct EdgeNode {
    milling::ProfilePoint at;
    Lag lag;
    double length_mm = 0;
};
using EdgeNodes = std::array<EdgeNode, 4>;

// A part of a band, on the cylinder or on the rounded part.
struct EdgeSlice {
    milling::EngagementBand band;
    bool round = false;
    double width_rad = 0;  // of the band
    double span_rad = 0;   // of its edge
    double low_rad = 0;    // rotation of the tip, in the first turn, at which the last end of the edge enters
    double middle_mm = 0;
    Lag lag;          // of its middle
    EdgePiece whole;  // on the cylinder
    EdgeNodes nodes;  // on the rounded part: all of it
};

// Constants of a cutter for its slices. Any thread.
class EdgeSlicer {
  public:
    explicit EdgeSlicer(const milling::Cutter& cutter);

    double lag_per_mm() const { return lag_per_mm_; }
    // Appends the slices of a band, whose angles may be in any turn.
    void add(milling::EngagementBand band, std::vector<EdgeSlice>& slices) const;
    // The part of a slice within a zone of it. Real-time safe.
    EdgePiece piece(const EdgeSlice& slice, EngagedZone zone) const;
    EdgeNodes nodes(const EdgeSlice& slice, EngagedZone zone) const;

  private:
    void add_slices(const milling::EngagementBand& band, bool round, std::vector<EdgeSlice>& slices) const;
    double kappa(double z_mm) const;

    double radius_mm_, corner_mm_, lag_per_mm_;
};

}  // namespace tribo::dynamics

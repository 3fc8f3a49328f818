// SPDX-License-Identifier: MIT
// The ways of a tool in pockets and about studs, where a cycle leaves them to its control: rings from the
// inside outwards in a pocket, from the outside inwards about a stud, depth by depth. Pure geometry, mm.
#pragma once

#include <functional>
#include <optional>

#include "base/result.hpp"
#include "motion/path/program.hpp"

namespace tribo::readers::control {

// Heights along the tool: above all, the work's surface, just above it, the bottom.
struct PocketDepths {
    double back = 0, top = 0, near = 0, bottom = 0;
};

// A rectangle with round corners; a circle has half_length = half_width = corner.
struct Pocket {
    PocketDepths depths;
    Vec3 centre;  // in the plane
    double half_length = 0, half_width = 0, corner = 0, angle_rad = 0;
    double radius = 0;                                   // of the tool
    double infeed = 0, step = 0, allowance = 0;          // step: from ring to ring
    double feed = 0, plunge = 0;                         // mm/min
    bool clockwise = false, along_edge = false;          // along its edge only
    double blank_half_length = 0, blank_half_width = 0;  // of a stud
};

// Moves the tool; no feed: a rapid. Coordinates are those of the plane, z along the tool.
using PocketMove =
    std::function<Result<void>(Vec3 to, std::optional<double> feed, const std::optional<motion::Arc>& arc)>;

// A turn about a centre, in a plane: where it ends, and its arc. It may rise to `z`.
struct Turn {
    Vec3 to;
    motion::Arc arc;
};
Turn turn_about(Vec3 from, Vec3 centre, double turn_rad, double z);

// A slot along an arc about `centre`, its middle at `arc_radius`, from `angle_rad` on by `sweep_rad`, counted
// to the centres of its round ends. Its half width is that of the pocket; length and corner are not used.
struct CurvedSlot {
    Pocket pocket;
    double arc_radius = 0, sweep_rad = 0;
};

// A stud with equal sides, the middle of the first one in the direction of the angle of `stud`, whose corner
// is the radius of its corners and whose half width is the distance of the sides from the centre. The blank
// is round: its radius is blank_half_width.
struct Polygon {
    Pocket stud;
    int sides = 6;
};

// Number of rings at all depths.
double ring_count(const Pocket& pocket);
double stud_ring_count(const Pocket& stud);
double ring_count(const CurvedSlot& slot);
double ring_count(const Polygon& polygon);

// `from`: where the tool is.
Result<void> mill_pocket(const Pocket& pocket, Vec3 from, const PocketMove& go);
Result<void> mill_stud(const Pocket& stud, Vec3 from, const PocketMove& go);
Result<void> mill_slot(const CurvedSlot& slot, Vec3 from, const PocketMove& go);
Result<void> mill_polygon(const Polygon& polygon, Vec3 from, const PocketMove& go);

}  // namespace tribo::readers::control

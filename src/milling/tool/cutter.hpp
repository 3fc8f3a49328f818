// SPDX-License-Identifier: MIT
// The tool: its solid of revolution (cutting part, shank, holder) and its edges.
#pragma once

#include <memory>
#include <vector>

#include "base/result.hpp"

namespace tribo::milling {

// The first three have closed forms of their own. All others are profiles: make_profile() makes the vertices
// from the numbers of a named kind.
enum class CutterKind {
    flat,
    ball,
    bull,
    taper,
    v,
    drill,
    chamfer,
    countersink,
    dovetail,
    lens,
    barrel,
    lollipop,
    thread,
    engraver,
    profile
};

// A vertex of a profile in the half plane through the axis. `bulge` belongs to the piece that begins here: 0
// for a line, else the tangent of a quarter of the arc's angle, > 0 where the cutter is convex (as in DXF:
// counter-clockwise with r to the right and z up).
struct ProfileVertex {
    double r_mm = 0, z_mm = 0, bulge = 0;

    bool operator==(const ProfileVertex&) const = default;
};

enum class CutterBody { carbide, high_speed_steel };

class ConvexZones;

// One cylindrical step above the cutting length. Steps are listed from the bottom up.
struct HolderStep {
    double diameter_mm = 0;
    double length_mm = 0;
};

// Flat, ball and bull are one profile: a cylinder of radius R whose bottom edge is rounded with
// `corner_radius_mm()` (0 for flat, R for ball). The other kinds are lines and arcs turned about the axis.
struct Cutter {
    int number = 0;  // T number; 0: matches any
    CutterKind kind = CutterKind::flat;
    double diameter_mm = 10;  // the largest that cuts
    double corner_mm = 0;   // radius at the tip. bull: 0 < corner < R; also taper, v, dovetail, lens, barrel
    int flutes = 2;         // 1..64
    double helix_deg = 30;  // -85..85, right-hand; negative is left-hand
    double core_mm = 0;     // diameter of the middle of a flat bottom without edges; 0: centre-cutting
    double length_mm = 40;  // cutting length, from the tip
    double runout_mm = 0;   // offset of the tool axis from the spindle axis, >= 0
    double runout_deg =
        0;  // direction of that offset at the tip, from flute 0, clockwise seen from the shank
    double runout_spread = 0;  // in 9 of 10 cases the true offset is 1 / (1 + it) to 1 + it times that one
    std::vector<double> pitch_deg{};  // angles from each flute to the next, sum 360; empty: uniform
    std::vector<HolderStep> holder{};
    // From the tip to the holder's face, >= length_mm; 0: not known, the holder follows the edges. In between
    // are the neck, from the edges up to `reach_mm` above the tip, and the shank.
    double stickout_mm = 0;
    double shank_mm = 0;  // diameter; 0: that of the cutter
    double neck_mm = 0;   // diameter, at most that of the shank; 0: no neck
    double reach_mm = 0;  // 0: the neck reaches the holder
    CutterBody body = CutterBody::carbide;
    // Sizes of the named kinds with a profile; 0: not given (cutter_shape.hpp says which kind has which).
    double tip_mm = 0;     // diameter of the flat tip; of a thread mill, width of the flat crest
    double point_deg = 0;  // full angle of the point
    double taper_deg = 0;  // angle of the side to the axis
    double side_mm = 0;    // radius of the side of a barrel, of the bottom of a lens
    double height_mm = 0;  // of the edges of a dovetail; of the largest diameter of a barrel
    // From the tip at z = 0 out and up; empty for flat, ball and bull. Above the last vertex the cutter is a
    // cylinder up to length_mm.
    std::vector<ProfileVertex> profile{};
    // What sweeps need of the profile; make_profile() fills it. Without it every sweep makes its own.
    std::shared_ptr<const ConvexZones> zones{};

    bool has_profile() const { return kind > CutterKind::bull; }
    double radius_mm() const { return 0.5 * diameter_mm; }
    // 0 for a cutter with a profile, which is none of this shape.
    double corner_radius_mm() const {
        return kind == CutterKind::bull ? corner_mm : kind == CutterKind::ball ? radius_mm() : 0;
    }
    // Returns the diameter right below length_mm, which is that of a shank without `shank_mm`.
    double top_diameter_mm() const { return profile.empty() ? diameter_mm : 2 * profile.back().r_mm; }
    // Returns the lag of the edge at height z behind the tip, rad. Constant lead: z tan(helix) / R; < 0 for a
    // left-hand helix.
    double lag_rad(double z_mm) const;
    // Neck and shank between the edges and the end of the stick-out; none without a stick-out.
    std::vector<HolderStep> shank_steps() const;
    // All that follows the edges: neck, shank and holder.
    std::vector<HolderStep> steps() const;
};

// Refuses values that cannot be a tool (non-finite, no diameter, corner too large, pitch that does not
// close, a profile that is none). The error names the key. A named kind must have its profile already.
Result<void> check(const Cutter& cutter);

}  // namespace tribo::milling

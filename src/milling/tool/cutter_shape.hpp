// SPDX-License-Identifier: MIT
// The named kinds of cutters with a profile, made into vertices.
//
//   kind          needs                     may have                    profile, from the tip
//   taper         taper_deg                 tip_mm, corner_mm           flat or rounded tip, cone, cylinder
//   v, engraver   point_deg                 tip_mm, corner_mm           the same; corner_mm rounds the tip
//   drill         -                         point_deg (118)             cone, cylinder
//   chamfer       -                         point_deg (90), tip_mm      flat tip, cone, cylinder
//   countersink   -                         point_deg (90), tip_mm      the same
//   dovetail      taper_deg, height_mm      corner_mm                   bottom, cone that narrows
//   lens          side_mm                   corner_mm                   arc about the axis, corner, cylinder
//   barrel        side_mm                   corner_mm, height_mm        bottom, corner, arc of the side
//   lollipop      neck_mm                   -                           ball up to its neck
//   thread        neck_mm                   point_deg (60), tip_mm      one tooth on the neck
//   profile       profile                   -                           its vertices
//
// `diameter_mm` is the largest that cuts. `tip_mm` of a taper without it follows from diameter, angle and
// `length_mm`. A rounded tip is tangent to bottom and cone; with corner_mm = tip_mm / 2 it is a ball.
#pragma once

#include <array>
#include <string_view>

#include "base/limits.hpp"
#include "base/result.hpp"
#include "milling/tool/cutter.hpp"

namespace tribo::milling {

// The names of CutterKind, in its order: `kind` of a job file, and the word of a tool.
inline constexpr std::array<std::string_view, 15> kCutterKindWords{
    "flat",     "ball", "bull",   "taper",    "v",      "drill",    "chamfer", "countersink",
    "dovetail", "lens", "barrel", "lollipop", "thread", "engraver", "profile"};

// The numbers beyond diameter_mm, flutes and length_mm that shape a cutter.
struct ShapeKey {
    std::string_view name;
    double Cutter::* value;
    const Limit& limit;
};
inline constexpr std::array<ShapeKey, 7> kShapeKeys{
    {{"corner_mm", &Cutter::corner_mm, kLimits.corner_radius},
     {"tip_mm", &Cutter::tip_mm, kLimits.tip_size},
     {"point_deg", &Cutter::point_deg, kLimits.point_angle},
     {"taper_deg", &Cutter::taper_deg, kLimits.taper_angle},
     {"side_mm", &Cutter::side_mm, kLimits.side_radius},
     {"height_mm", &Cutter::height_mm, kLimits.profile_height},
     {"neck_mm", &Cutter::neck_mm, kLimits.shank_diameter}}};

// True if the kind has a use for this key (for neck_mm: as a part of its shape).
bool is_shape_key(CutterKind kind, std::string_view key);
// True if the kind ends where its profile ends, so that `length_mm` follows from the other sizes.
bool has_own_length(CutterKind kind);
// Returns the helix of a kind if nobody says: 0 for those that are usually ground straight.
double usual_helix_deg(CutterKind kind);

// Fills `profile` of a named kind, and what follows from it: `diameter_mm` of a profile, `length_mm` of a
// kind with its own length, `point_deg` of a kind with a usual one, `core_mm` of a thread mill, whose bottom
// does not cut. Flat, ball and bull have none. Refuses sizes that do not fit each other and a profile that
// cannot be turned: the error names the key.
Result<void> make_profile(Cutter& cutter);

// Refuses vertices that are no profile: not finite, not from z = 0 up, below radius 0, pieces without length,
// arcs that hang back, more than kMostVertices. Names the vertex.
Result<void> check_profile(const Cutter& cutter);
inline constexpr std::size_t kMostVertices = 200;  // each is followed by every sweep

}  // namespace tribo::milling

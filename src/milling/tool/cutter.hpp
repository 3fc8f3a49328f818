// SPDX-License-Identifier: MIT
// The tool: its solid of revolution (cutting part, shank, holder) and its edges.
#pragma once

#include <vector>

#include "base/result.hpp"

namespace tribo::milling {

enum class CutterKind { flat, ball, bull };

enum class CutterBody { carbide, high_speed_steel };

// One cylindrical step above the cutting length. Steps are listed from the bottom up.
struct HolderStep {
    double diameter_mm = 0;
    double length_mm = 0;
};

// All three kinds are one profile: a cylinder of radius R whose bottom edge is rounded with
// `corner_radius_mm()` (0 for flat, R for ball).
struct Cutter {
    int number = 0;  // T number; 0: matches any
    CutterKind kind = CutterKind::flat;
    double diameter_mm = 10;
    double corner_mm = 0;   // bull only: 0 < corner < R
    int flutes = 2;         // 1..64
    double helix_deg = 30;  // -85..85, right-hand; negative is left-hand
    double core_mm = 0;     // diameter of the middle of a flat bottom without edges; 0: centre-cutting
    double length_mm = 40;  // cutting length, from the tip
    double runout_mm = 0;   // offset of the tool axis from the spindle axis, >= 0
    double runout_deg =
        0;  // direction of that offset at the tip, from flute 0, clockwise seen from the shank
    std::vector<double> pitch_deg{};  // angles from each flute to the next, sum 360; empty: uniform
    std::vector<HolderStep> holder{};
    // From the tip to the holder's face, >= length_mm; 0: not known, the holder follows the edges. In between
    // are the neck, from the edges up to `reach_mm` above the tip, and the shank.
    double stickout_mm = 0;
    double shank_mm = 0;  // diameter; 0: that of the cutter
    double neck_mm = 0;   // diameter, at most that of the shank; 0: no neck
    double reach_mm = 0;  // 0: the neck reaches the holder
    CutterBody body = CutterBody::carbide;

    double radius_mm() const { return 0.5 * diameter_mm; }
    double corner_radius_mm() const {
        return kind == CutterKind::flat ? 0 : kind == CutterKind::ball ? radius_mm() : corner_mm;
    }
    // Returns the lag of the edge at height z behind the tip, rad. Constant lead: z tan(helix) / R; < 0 for a
    // left-hand helix.
    double lag_rad(double z_mm) const;
    // Neck and shank between the edges and the end of the stick-out; none without a stick-out.
    std::vector<HolderStep> shank_steps() const;
    // All that follows the edges: neck, shank and holder.
    std::vector<HolderStep> steps() const;
};

// Refuses values that cannot be a tool (non-finite, no diameter, corner too large, pitch that does not
// close). The error names the key.
Result<void> check(const Cutter& cutter);

}  // namespace tribo::milling

// SPDX-License-Identifier: MIT
// Measures engagement: looks at the material on the cutter's surface, just ahead of the teeth.
#pragma once

#include <cstdint>
#include <vector>

#include "field/carved_view.hpp"
#include "milling/cutter.hpp"
#include "milling/engagement.hpp"
#include "motion/program.hpp"

namespace tribo::milling {

// The tool's frame (README of this room, "Frame"): x along the feed, y to its left, z to the shank.
struct ToolFrame {
    Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
};

// Frame for an axis and a direction of travel. A plunge has no feed direction across the axis: `last_x`,
// projected on the plane normal to the axis, stands in.
ToolFrame tool_frame(Vec3 axis, Vec3 travel, Vec3 last_x);

// Where and how the tool travels at one instant.
struct CutPose {
    Vec3 tip_mm;
    ToolFrame frame;
    double across = 1;  // share of the tip's travel across the axis, 0..1
    double down = 0;    // share along the axis towards the tip, -1..1; positive when plunging
};

class EngagementProbe {
  public:
    explicit EngagementProbe(const Cutter& cutter);

    // Angles are found to about 0.1 degrees, heights to 1 % of the engaged depth or 5 um. The stock must not
    // hold the cut that is being measured yet. Not for several threads at once (it keeps scratch space); no
    // allocation once warm.
    void measure(const field::CarvedView& stock, const CutPose& pose, Engagement& out);

  private:
    static constexpr int kAngles = 48;  // probes around the full circle
    using Mask = std::uint64_t;         // a bit per probe that stands in material

    // Where the envelope at height z moves into the material: at rotations with sin(phi) > least_sine.
    double least_sine(const CutPose& pose, double z) const;
    // Of the probes asked for, those that stand in material.
    Mask look(const field::CarvedView& stock, const CutPose& pose, double z, Mask asked) const;
    // All probes, by half of them and those beside a border, if that is how it was at a height nearby.
    Mask look_again(const field::CarvedView& stock, const CutPose& pose, double z, Mask like) const;
    // The border between two rotations of which only `inside` stands in material.
    double refine(const field::CarvedView& stock, const CutPose& pose, double z, double outside,
                  double inside) const;
    void add_bands(const field::CarvedView& stock, const CutPose& pose, Mask mask, double z0, double z1,
                   Engagement& out) const;
    void add_window(const field::CarvedView& stock, const CutPose& pose, Mask mask, EngagementBand window,
                    Engagement& out) const;
    double bottom_fraction(const field::CarvedView& stock, const CutPose& pose) const;

    struct Level {
        double z;
        Mask mask;
    };
    Cutter cutter_;
    double sin_[kAngles], cos_[kAngles];
    std::vector<Level> levels_;
};

// Volume that the engaged surface sweeps for each mm of tip travel, mm2: the area that the chips take out of
// the stock.
double chip_area_mm2(const Cutter& cutter, const Engagement& engagement, double across, double down);

}  // namespace tribo::milling

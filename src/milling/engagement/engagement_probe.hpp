// SPDX-License-Identifier: MIT
// Measures engagement: looks at the material on the cutter's surface, just ahead of the teeth.
#pragma once

#include <vector>

#include "field/carved/carved_view.hpp"
#include "milling/engagement/contact_scout.hpp"
#include "milling/engagement/engagement.hpp"
#include "milling/tool/cut_pose.hpp"
#include "milling/tool/cutter_profile.hpp"
#include "milling/tool/material_arcs.hpp"

namespace tribo::milling {

class EngagementProbe {
  public:
    explicit EngagementProbe(const Cutter& cutter);

    // Where the scout finds contact, circles about the axis are looked through for material where the
    // envelope moves outward: few where they are alike, more where they differ, until the chips' area is
    // known to about 0.5 % (on a cut as small as 1e-3 R^2, to a tenth). The stock must not hold the cut that
    // is being measured yet. Not for several threads at once (it keeps scratch space); no allocation once
    // warm.
    void measure(const field::CarvedView& stock, const CutPose& pose, Engagement& out);
    // Whether the scout finds any contact there.
    bool touches(const field::CarvedView& stock, const CutPose& pose);

  private:
    // A circle, what is engaged on it, and the stretch of the meridian that it stands for.
    struct Level {
        double s0 = 0, s = 0, s1 = 0;  // along the meridian, mm: where it begins, its circle, its end
        // Contact ends all at once at s0, at s1.
        bool step_below = false, step_above = false;
        ProfilePoint at;
        TurnWindow window;                 // where the envelope moves outward
        double speed = 0;                  // of the fastest point of the circle, outward
        std::size_t first = 0, count = 0;  // of arcs_
        double width_rad = 0;              // of those arcs
        double flow = 0;                   // area that they sweep outward, per mm of meridian
        double error = 0;                  // what splitting it may change, of the chips' area
    };
    // Calls `look(s0, s1)` for each part of the meridian that may cut: corner, cylinder, bottom.
    template <class Look>
    void each_part(const field::CarvedView& stock, const CutPose& pose, Look look) const;
    // Heights at which the envelope can meet the blank at all; false: none.
    bool clip_heights(const field::CarvedView& stock, const CutPose& pose, double& low, double& high) const;
    void start(double s0, double s1, const field::CarvedView& stock, const CutPose& pose);
    void find_step(Level& seen, Level& empty, const field::CarvedView& stock, const CutPose& pose) const;
    Level look(double s0, double s1, const field::CarvedView& stock, const CutPose& pose);
    // Fills Level::error; gives the chips' area as it is known now.
    double judge();
    double error_between(const Level& a, const Level& b) const;
    // Gives the chips' area on these levels, beside what is known of other parts.
    double refine(const field::CarvedView& stock, const CutPose& pose, double known_area);
    struct BorderRun;
    static BorderRun run_of(double low, double middle, double high, double from_below, double to_above,
                            double size);
    void add_arc(std::size_t level, std::size_t arc, const CutPose& pose, Engagement& out) const;
    void add_closing_arc(const Level& level, const Level& inner, double end, std::size_t arc,
                         const CutPose& pose, Engagement& out) const;
    void add_band(const Level& level, const MaterialArc& seen, double s0, double s1, MaterialArc arc,
                  const CutPose& pose, Engagement& out) const;
    bool joined_below(std::vector<EngagementBand>& bands, double s0, const EngagementBand& band) const;
    bool starts_with_window(const Level& level, const MaterialArc& arc) const;
    bool ends_with_window(const Level& level, const MaterialArc& arc) const;
    void add_bands(const CutPose& pose, Engagement& out) const;

    CutterProfile profile_;
    ContactScout scout_;
    double radius_mm_, core_mm_, length_mm_;
    std::vector<Level> levels_;  // by s, of one part of the profile: the bottom, or the lateral edge
    std::vector<MaterialArc> arcs_;
    std::vector<MeridianStretch> stretches_;  // scratch
};

// Volume that the engaged surface sweeps on that travel, mm3: what the chips take out of the stock.
double chip_mm3(const Cutter& cutter, const Engagement& engagement, const ToolTravel& travel);

}  // namespace tribo::milling

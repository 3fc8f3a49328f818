// SPDX-License-Identifier: MIT
// Measures engagement: searches for material on the cutter's surface, just ahead of the teeth.
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

    // Measures the engagement at this pose. Where the scout finds contact, the probe searches circles about
    // the axis for material where the envelope moves outward. It uses few circles where they are alike and
    // more where they differ, until the area of the chips is known to about 0.5 % (to a tenth for a cut as
    // small as 1e-3 R^2). The stock must not contain the cut that is being measured yet. Keeps scratch space:
    // one thread at a time; no allocation after the first calls.
    void measure(const field::CarvedView& stock, const CutPose& pose, Engagement& out);
    // The same of the core, where the cutter has no edges: what it moves into is removed without a force.
    void measure_core(const field::CarvedView& stock, const CutPose& pose, Engagement& out);
    // Returns true if the scout finds any contact at this pose.
    bool touches(const field::CarvedView& stock, const CutPose& pose);
    // The same, cheaper where something of an engagement of a pose near by still holds.
    bool touches(const field::CarvedView& stock, const CutPose& pose, const Engagement& near_by);

  private:
    // A circle, its engaged arcs, and the stretch of the meridian that it stands for.
    struct Level {
        double s0 = 0, s = 0, s1 = 0;  // along the meridian, mm: start of the stretch, its circle, its end
        // True if the contact ends with a step at s0 or at s1.
        bool step_below = false, step_above = false;
        ProfilePoint at;
        TurnWindow window;                 // where the envelope moves outward
        double speed = 0;                  // of the fastest point of the circle, outward
        std::size_t first = 0, count = 0;  // of arcs_
        double width_rad = 0;              // total width of those arcs
        double flow = 0;                   // area that they sweep outward, per mm of meridian
        double error = 0;                  // change of the area of the chips that splitting may cause
    };
    // Calls `look(s0, s1)` for each part of the meridian that may cut: corner, cylinder, bottom.
    template <class Look>
    void each_part(const field::CarvedView& stock, const CutPose& pose, Look look) const;
    template <class Look>
    void each_part_of_profile(const CutPose& pose, double low, double high, Look look) const;
    // Computes the heights at which the envelope may meet the blank. Returns false if there are none.
    bool clip_heights(const field::CarvedView& stock, const CutPose& pose, double& low, double& high) const;
    void start(double s0, double s1, const field::CarvedView& stock, const CutPose& pose);
    void find_step(Level& seen, Level& empty, const field::CarvedView& stock, const CutPose& pose) const;
    Level look(double s0, double s1, const field::CarvedView& stock, const CutPose& pose);
    // Fills Level::error. Returns the area of the chips as known so far.
    double judge();
    double error_between(const Level& a, const Level& b) const;
    // Splits levels until the area is known well enough. Returns the area of the chips on these levels;
    // `known_area` is the area of the other parts.
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
    bool in_core_ = false;       // the core is measured, not the edges
    std::vector<Level> levels_;  // sorted by s, of one part of the profile: the bottom, or the lateral edge
    std::vector<MaterialArc> arcs_;
    std::vector<MeridianStretch> stretches_;  // scratch
};

// Returns the volume that the engaged surface sweeps during this travel, mm3: the chips that leave the stock.
double chip_mm3(const Cutter& cutter, const Engagement& engagement, const ToolTravel& travel);

}  // namespace tribo::milling

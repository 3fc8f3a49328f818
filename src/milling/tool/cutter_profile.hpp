// SPDX-License-Identifier: MIT
// The cutter's meridian as a curve: from the axis out along the flat bottom, around the corner, up the
// cylinder; or along the lines and arcs of its profile. Real-time safe but for the constructor, any thread.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/math.hpp"
#include "milling/engagement/engagement.hpp"
#include "milling/force/edge_force.hpp"
#include "milling/tool/cutter.hpp"
#include "milling/tool/turned_profile.hpp"

namespace tribo::milling {

// Returns the point of a level band at a radius.
inline ProfilePoint point_of(const BottomBand& band, double radius_mm) {
    return {radius_mm, band.z_mm, 0, band.faces_up ? -1.0 : 1.0};
}

// A point of the meridian is given by its distance s along the meridian from the axis, mm.
class CutterProfile {
  public:
    // A line or arc of a profile, from s0 to s1.
    struct Part {
        double s0 = 0, s1 = 0;
        ProfileElement element;

        bool is_level() const { return element.is_level(); }
        bool faces_up() const { return element.from_normal.z > 0; }  // if level
        // Heights rise along a part that is not level. Its s at a height within it:
        double at_height(double z_mm) const;
        ProfilePoint at(double s) const;
        // Turn of the normal over the part, rad, > 0; 0 on a line.
        double turn_rad() const;
        // Integral of the radius over the part from s0 to s1, mm2.
        double radius_integral(double s0_mm, double s1_mm) const;
    };

    explicit CutterProfile(const Cutter& cutter);

    // Of a cutter with a profile, in order; else none.
    const std::vector<Part>& parts() const { return parts_; }

    // The parts of flat, ball and bull.
    double bottom_end() const { return core_; }
    double corner_end() const { return core_ + corner_ * math::kHalfPi; }
    double end() const { return end_; }

    // True on a flat bottom or another level part; on a cylinder or cone; on a part whose circles differ.
    bool is_level(double s) const { return parts_.empty() ? s < core_ : part_at(s).is_level(); }
    bool is_straight(double s) const {
        return parts_.empty() ? s >= corner_end() : !part_at(s).is_level() && !part_at(s).element.is_arc();
    }
    bool is_round(double s) const {
        return parts_.empty() ? s >= core_ && s < corner_end()
                              : !part_at(s).is_level() && part_at(s).element.from_normal.r != 1;
    }

    ProfilePoint at(double s) const {
        if (!parts_.empty()) return part_at(s).at(s);
        if (s <= core_) return {s, 0, 0, 1};
        if (s >= corner_end()) return {core_ + corner_, corner_ + s - corner_end(), 1, 0};
        double sine, cosine;
        math::sincos((s - core_) / corner_, sine, cosine);
        return {core_ + corner_ * sine, corner_ * (1 - cosine), sine, cosine};
    }
    // Returns s of the lateral edge at this height above the tip.
    double at_height(double z_mm) const {
        if (!parts_.empty()) return parts_[lateral_part(z_mm)].at_height(z_mm);
        if (z_mm >= corner_) return corner_end() + z_mm - corner_;
        return core_ + corner_ * math::acos(std::clamp(1 - z_mm / corner_, -1.0, 1.0));
    }
    // Returns the number of the part that is not level and has this height; the upper one at a joint.
    std::size_t lateral_part(double z_mm) const;
    // Calls visit(part, z0, z1) for the share of each lateral part between two heights.
    template <class Visit>
    void over_parts(double z0_mm, double z1_mm, const Visit& visit) const {
        for (const Part& part : parts_) {
            const double z0 = std::max(z0_mm, part.element.from.z), z1 = std::min(z1_mm, part.element.to.z);
            if (!part.is_level() && z1 > z0) visit(part, z0, z1);
        }
    }

  private:
    // The part that begins at s, or in which s lies.
    const Part& part_at(double s) const {
        std::size_t n = parts_.size() - 1;
        while (n > 0 && s < parts_[n].s0) --n;
        return parts_[n];
    }

    double core_, corner_, end_;
    std::vector<Part> parts_;
};

// Returns points along the profile, arcs in steps of at most this angle; empty for flat, ball and bull.
std::vector<PlanePoint> profile_outline(const Cutter& cutter, double step_rad);

}  // namespace tribo::milling

// SPDX-License-Identifier: MIT
#include "milling/tool/cutter_profile.hpp"

namespace tribo::milling {

CutterProfile::CutterProfile(const Cutter& cutter)
    : core_(cutter.radius_mm() - cutter.corner_radius_mm()),
      corner_(cutter.corner_radius_mm()),
      end_(core_ + corner_ * math::kHalfPi + cutter.length_mm - corner_) {
    if (!cutter.has_profile()) return;
    end_ = 0;
    for (const ProfileElement& element : profile_elements(cutter)) {
        Part part{end_, end_, element};
        part.s1 += element.is_arc() ? std::abs(element.radius_mm) * part.turn_rad()
                                    : norm(element.to - element.from);
        end_ = part.s1;
        parts_.push_back(part);
    }
}

std::vector<PlanePoint> profile_outline(const Cutter& cutter, double step_rad) {
    std::vector<PlanePoint> outline;
    const CutterProfile profile(cutter);
    for (const CutterProfile::Part& part : profile.parts()) {
        if (outline.empty()) outline.push_back(part.element.from);
        const int steps = std::max(1, static_cast<int>(std::ceil(part.turn_rad() / step_rad)));
        for (int n = 1; n <= steps; ++n) {
            const ProfilePoint at = part.at(part.s0 + (part.s1 - part.s0) * n / steps);
            outline.push_back({at.radius_mm, at.height_mm});
        }
    }
    return outline;
}

std::size_t CutterProfile::lateral_part(double z_mm) const {
    std::size_t found = parts_.size();
    for (std::size_t n = 0; n < parts_.size(); ++n) {
        if (parts_[n].is_level()) continue;
        if (found == parts_.size() || parts_[n].element.from.z <= z_mm) found = n;
    }
    return found;
}

double CutterProfile::Part::turn_rad() const {
    if (!element.is_arc()) return 0;
    const double sine = cross(element.from_normal, element.to_normal);
    return math::atan2(std::abs(sine), dot(element.from_normal, element.to_normal));
}

double CutterProfile::Part::at_height(double z_mm) const {
    const ProfileElement& e = element;
    const double share = std::clamp((z_mm - e.from.z) / (e.to.z - e.from.z), 0.0, 1.0);
    if (!e.is_arc() || share == 0 || share == 1) return s0 + share * (s1 - s0);
    // The normal at this height, in the half of the plane that points away from the axis.
    const double up = std::clamp((z_mm - e.centre.z) / e.radius_mm, -1.0, 1.0);
    const PlanePoint normal{std::sqrt(1 - up * up), up};
    const double turned = math::atan2(std::abs(cross(e.from_normal, normal)), dot(e.from_normal, normal));
    return std::min(s0 + std::abs(e.radius_mm) * turned, s1);
}

ProfilePoint CutterProfile::Part::at(double s) const {
    const ProfileElement& e = element;
    if (!e.is_arc()) {
        const PlanePoint p = e.from + ((s - s0) / (s1 - s0)) * (e.to - e.from);
        return {p.r, p.z, e.from_normal.r, -e.from_normal.z};
    }
    double sine, cosine;
    math::sincos((s - s0) / e.radius_mm, sine, cosine);
    const PlanePoint a = e.from_normal, normal{a.r * cosine - a.z * sine, a.z * cosine + a.r * sine};
    const PlanePoint p = e.centre + e.radius_mm * normal;
    return {std::max(p.r, 0.0), p.z, normal.r, -normal.z};
}

// Along an arc the radius is that of its centre and the share of the normal, whose integral is a height.
double CutterProfile::Part::radius_integral(double s0_mm, double s1_mm) const {
    const ProfilePoint a = at(s0_mm), b = at(s1_mm);
    const double size = s1_mm - s0_mm;
    if (!element.is_arc()) return 0.5 * (a.radius_mm + b.radius_mm) * size;
    return element.centre.r * size + element.radius_mm * (b.height_mm - a.height_mm);
}

}  // namespace tribo::milling

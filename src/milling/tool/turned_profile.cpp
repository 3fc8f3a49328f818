// SPDX-License-Identifier: MIT
#include "milling/tool/turned_profile.hpp"

#include <algorithm>
#include <cmath>

namespace tribo::milling {
namespace {

ProfileElement line(PlanePoint from, PlanePoint to) {
    const PlanePoint way = to - from;
    const PlanePoint normal = (1 / norm(way)) * PlanePoint{way.z, -way.r};
    return {from, to, normal, normal, {}, 0};
}

// The bulge is tan(angle / 4): half of the chord over the sagitta, so that no angle is needed.
ProfileElement arc(PlanePoint from, PlanePoint to, double bulge) {
    const PlanePoint way = to - from, left{-way.z, way.r};
    const PlanePoint centre = from + 0.5 * way + (0.25 * (1 / bulge - bulge)) * left;
    const double radius = 0.25 * norm(way) * (1 / bulge + bulge);
    return {from, to, (1 / radius) * (from - centre), (1 / radius) * (to - centre), centre, radius};
}

}  // namespace

double norm(PlanePoint a) {
    return std::sqrt(dot(a, a));
}

std::vector<ProfileElement> profile_elements(const Cutter& cutter) {
    std::vector<ProfileElement> elements;
    const auto add = [&](PlanePoint from, PlanePoint to, double bulge) {
        if (norm(to - from) < kShortest) return;
        elements.push_back(bulge == 0 ? line(from, to) : arc(from, to, bulge));
    };
    PlanePoint last{};
    double bulge = 0;
    for (const ProfileVertex& vertex : cutter.profile) {
        const PlanePoint next{vertex.r_mm, vertex.z_mm};
        add(last, next, bulge);
        last = next;
        bulge = vertex.bulge;
    }
    if (cutter.length_mm > last.z) add(last, {last.r, cutter.length_mm}, 0);
    return elements;
}

double largest_radius_mm(const std::vector<ProfileElement>& elements) {
    double most = 0;
    for (const ProfileElement& e : elements) {
        most = std::max({most, e.from.r, e.to.r});
        const bool passes_side = e.from_normal.z * e.to_normal.z < 0;
        if (passes_side && e.radius_mm > 0) most = std::max(most, e.centre.r + e.radius_mm);
    }
    return most;
}

}  // namespace tribo::milling

// SPDX-License-Identifier: MIT
#include "report/picture/sun_shadow.hpp"

#include <algorithm>
#include <cmath>

#include "report/picture/disc_points.hpp"
#include "report/picture/studio.hpp"

namespace tribo::report {
namespace {

constexpr int kTexels = 1536;
constexpr double kSoft = 7;        // radius of the edge, texels
constexpr double kLift = 2;        // texels that a point is lifted off its surface
constexpr float kDarkest = 0.85F;  // share of the sun that a shadow takes
constexpr double kBelow = 2e-3;    // the ground is so much lower than the part, of its size

struct Range {
    double low = 1e300, high = -1e300;
    void add(double v) {
        low = std::min(low, v);
        high = std::max(high, v);
    }
    double size() const { return high - low; }
};

}  // namespace

SunShadow::SunShadow(const TriangleMesh& mesh)
    : map_(kTexels, kTexels), taps_(disc_points<kTaps>()), sun_(Studio::to_sun()) {
    right_ = normalized(cross(Vec3{0, 0, 1}, sun_));
    up_ = cross(sun_, right_);
    Range across, along, height, x, y, z;
    for (std::uint32_t i = 0; i < mesh.positions.size(); ++i) {
        const Vec3 p = mesh.position(i);
        across.add(dot(p, right_));
        along.add(dot(p, up_));
        height.add(dot(p, sun_));
        x.add(p.x);
        y.add(p.y);
        z.add(p.z);
    }
    ground_mm_ = z.low - kBelow * length(Vec3{x.size(), y.size(), z.size()});
    const double widest = std::max({across.size(), along.size(), 1e-9});
    per_mm_ = (kTexels - 2 * (kSoft + kLift + 1)) / widest;
    left_ = across.low - (kSoft + kLift + 1) / per_mm_;
    top_ = along.high + (kSoft + kLift + 1) / per_mm_;
    low_ = height.low;
    per_height_ = 0.9 / std::max(height.size(), 1e-9);
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const Triangle& t = mesh.triangles[i];
        fill(map_, i, see(mesh.position(t[0])), see(mesh.position(t[1])), see(mesh.position(t[2])));
    }
}

// 0.1 and more for the points of the part.
Seen SunShadow::see(Vec3 p) const {
    return {per_mm_ * (dot(p, right_) - left_), per_mm_ * (top_ - dot(p, up_)),
            0.1 + per_height_ * (dot(p, sun_) - low_)};
}

float SunShadow::light(Vec3 p, Vec3 normal) const {
    const Vec3 out = dot(normal, sun_) < 0 ? -normal : normal;
    const Seen at = see(p + (kLift / per_mm_) * out);
    // A flat tap on a surface that the sun grazes would lie below it.
    const double steep = std::sqrt(std::max(0.0, 1 - dot(out, sun_) * dot(out, sun_))),
                 margin =
                     per_height_ * kSoft / per_mm_ * std::min(steep / std::max(dot(out, sun_), 0.1), 4.0);
    int hidden = 0;
    for (const Vec3 tap : taps_) {
        const auto x = static_cast<int>(std::floor(at.x + kSoft * tap.x)),
                   y = static_cast<int>(std::floor(at.y + kSoft * tap.y));
        if (x < 0 || y < 0 || x >= kTexels || y >= kTexels) continue;
        const std::size_t texel = map_.at(x, y);
        hidden += map_.triangle[texel] != kNothing &&
                  static_cast<double>(map_.nearness[texel]) > at.nearness + margin;
    }
    return 1 - kDarkest * static_cast<float>(hidden) / static_cast<float>(kTaps);
}

Vec3 SunShadow::on_ground(Vec3 p) const {
    return p - ((p.z - ground_mm_) / sun_.z) * sun_;
}

}  // namespace tribo::report

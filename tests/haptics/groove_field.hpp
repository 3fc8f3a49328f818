// SPDX-License-Identifier: MIT
// Surfaces with closed forms for a probe to touch.
#pragma once

#include <algorithm>
#include <cmath>

#include "contact/distance_field.hpp"

namespace tribo::haptics::test {

// Material below z = 0.
class Floor final : public contact::DistanceField {
  public:
    double distance_mm(Vec3 p) const override { return p.z; }
    Vec3 normal(Vec3) const override { return {0, 0, 1}; }
};

// Round grooves along y at every pitch in x, whose cusps stand `height` above their bottoms (z = 0): exact
// distance to the nearest groove, a lower bound beyond its cusps, as of carved material.
class Grooves final : public contact::DistanceField {
  public:
    Grooves(double pitch, double height)
        : pitch_(pitch), radius_((0.25 * pitch * pitch + height * height) / (2 * height)) {}

    double distance_mm(Vec3 p) const override { return radius_ - length(offset(p)); }
    Vec3 normal(Vec3 p) const override { return -normalized(offset(p), {0, 0, -1}); }
    double radius_mm() const { return radius_; }
    // In closed form: the foot in the groove that the point is in, or the nearer of its cusps.
    contact::SurfaceSample nearest(Vec3 p, double, contact::NearHint&) const override {
        const double middle = pitch_ * std::round(p.x / pitch_);
        const Vec3 d = offset(p);
        const double depth = length(d);
        contact::SurfaceSample best{1e9, {0, 0, 1}, 0};
        if (depth > radius_) return {radius_ - depth, normal(p), 0};
        if (depth > 0 && std::abs(d.x) / depth * radius_ <= 0.5 * pitch_ && d.z < 0)
            best = {radius_ - depth, normal(p), 0};
        const double cusp = radius_ - std::sqrt(radius_ * radius_ - 0.25 * pitch_ * pitch_);
        for (const double side : {-0.5, 0.5}) {
            const Vec3 off{p.x - middle - side * pitch_, 0, p.z - cusp};
            if (length(off) < best.distance_mm) best = {length(off), normalized(off), 0};
        }
        return best;
    }

  private:
    // From the nearest groove's axis. Above all axes there is air.
    Vec3 offset(Vec3 p) const {
        return {p.x - pitch_ * std::round(p.x / pitch_), 0, std::min(p.z - radius_, 0.0)};
    }
    double pitch_, radius_;
};

// A wall of a given thickness: -thickness < z < 0.
class Wall final : public contact::DistanceField {
  public:
    explicit Wall(double thickness) : half_(0.5 * thickness) {}
    double distance_mm(Vec3 p) const override { return std::abs(p.z + half_) - half_; }
    Vec3 normal(Vec3 p) const override { return {0, 0, p.z + half_ < 0 ? -1.0 : 1.0}; }

  private:
    double half_;
};

// Air above the floor z = 0 and right of the wall x = 0: where the two meet, a corner.
class Corner final : public contact::DistanceField {
  public:
    double distance_mm(Vec3 p) const override { return std::min(p.x, p.z); }
    Vec3 normal(Vec3 p) const override { return p.x < p.z ? Vec3{1, 0, 0} : Vec3{0, 0, 1}; }
};

}  // namespace tribo::haptics::test

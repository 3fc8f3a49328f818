// SPDX-License-Identifier: MIT
// A cutter with a profile as the union of convex solids, for the distances of its sweeps.
//
// A zone is a run of lines and convex arcs of the profile up to the next vertex that is concave. Its solid is
// the intersection of what lies inside each of them. Above and below the run it goes on into the cutter, up
// to half way to the other side, so that zones overlap: where they meet no surface is left within the cutter.
// A concave arc is replaced by tangents (kConcaveErrorMm), each with a zone of its own.
//
// As seen from a point that moves, the distance to a zone is convex wherever the point goes straight, because
// the profile never hangs back: every outward normal points away from the axis or along it.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "milling/tool/turned_profile.hpp"

namespace tribo::milling {

// Largest distance of the tangents from a concave arc.
inline constexpr double kConcaveErrorMm = 3e-5;

class ConvexZones {
  public:
    explicit ConvexZones(const Cutter& cutter);

    // Distance to the surface of a zone, and its gradient: a unit vector with r >= 0.
    struct Seen {
        double distance_mm = 0;
        PlanePoint normal;
    };

    std::size_t size() const { return zones_.size(); }
    // `at` is a point of the half plane, r >= 0. The distance is negative inside, has slope 1, and in front
    // of an edge it is the largest of the distances to the surfaces that meet there. Real-time safe.
    Seen look(std::size_t zone, PlanePoint at) const;
    // Returns the gradient of another face that meets there within `slack_mm`; the same where there is none.
    PlanePoint other_normal(std::size_t zone, PlanePoint at, double slack_mm) const;
    // The same for the cutter: the least over the zones.
    double distance_mm(PlanePoint at) const;
    Seen look(PlanePoint at) const;

    double radius_mm() const { return radius_mm_; }
    double length_mm() const { return length_mm_; }

  private:
    // A line, or a convex arc with its normals from `first` to `last`, counter-clockwise.
    struct Face {
        PlanePoint first, last;
        double offset_mm = 0;  // of a line along its normal
        PlanePoint centre;
        double radius_mm = 0;  // 0: a line

        Seen look(PlanePoint at) const;
    };
    struct Zone {
        std::size_t first, end;  // of faces_
    };
    struct Run;
    void add_run(const std::vector<ProfileElement>& elements, const Run& run);
    void add_concave(const std::vector<ProfileElement>& elements, std::size_t arc);
    double add_lower_end(const std::vector<ProfileElement>& elements, std::size_t number, PlanePoint normal);
    double add_upper_end(const std::vector<ProfileElement>& elements, std::size_t number, PlanePoint normal);
    double add_end(double up, const std::optional<PlanePoint>& end);
    void add_side(double radius_mm);
    void add_face(const ProfileElement& element);
    void add_level(double up, double height_mm);

    std::vector<Face> faces_;
    std::vector<Zone> zones_;
    double radius_mm_, length_mm_;
};

}  // namespace tribo::milling

// SPDX-License-Identifier: MIT
// A cutter with a profile as the union of solids that are convex but for hollow arcs, for the distances of
// its sweeps.
//
// A zone is a run of lines and convex arcs of the profile up to the next vertex that is concave, or one
// concave arc. Its solid is the intersection of what lies inside each of them. Above and below the run it
// goes on into the cutter, up to half way to the other side, so that zones overlap: where they meet no
// surface is left within the cutter. Where there is little way on, as at a convex joint with a concave arc, a
// further zone overlaps both.
//
// As seen from a point that moves, the distance to a zone is convex wherever the point goes straight, because
// the profile never hangs back: every outward normal points away from the axis or along it. Only that to a
// concave arc bends the other way, by no more than bend_per_mm().
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "milling/tool/turned_profile.hpp"

namespace tribo::milling {

class ConvexZones {
  public:
    explicit ConvexZones(const Cutter& cutter);

    // Distance to the surface of a zone, and its gradient: a vector with r >= 0, of length 1 but in a hollow
    // half way from its arc to the centre, where the distance is less than the way.
    struct Seen {
        double distance_mm = 0;
        PlanePoint normal;
    };

    std::size_t size() const { return zones_.size(); }
    // Of the distance to a zone along a straight way of the point: at most so much does its slope fall, per
    // mm of the way. 0: it is convex.
    double bend_per_mm(std::size_t zone) const { return zones_[zone].bend_per_mm; }
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
    // A line, or an arc with its normals from `first` to `last`: counter-clockwise if it is convex, else
    // clockwise.
    struct Face {
        PlanePoint first, last;
        double offset_mm = 0;  // of a line along its normal
        PlanePoint centre;
        double radius_mm = 0;  // 0: a line; < 0: concave

        Seen look(PlanePoint at) const;
        Seen look_into_hollow(PlanePoint off) const;
    };
    struct Zone {
        std::size_t first, end;  // of faces_
        double bend_per_mm = 0;
    };
    struct Run;
    static Face face_of(const ProfileElement& element);
    static double beyond_mm(const Face& face, const ProfileElement& element);
    static std::size_t joint_between_runs(const std::vector<ProfileElement>& elements, const Run& run);
    static void split_into_runs(const std::vector<ProfileElement>& elements, const Run& run,
                                std::vector<Run>& runs);
    void add_run(const std::vector<ProfileElement>& elements, const Run& run);
    void join(const std::vector<ProfileElement>& elements, std::size_t number);
    void add_bridge(const ProfileElement& below, const ProfileElement& above);
    void add_column(const std::vector<ProfileElement>& elements, std::size_t number, double up);
    void add_core(const std::vector<ProfileElement>& elements, std::size_t number);
    double add_lower_end(const std::vector<ProfileElement>& elements, std::size_t number);
    double add_upper_end(const std::vector<ProfileElement>& elements, std::size_t number);
    double add_end(double up, const std::optional<PlanePoint>& end);
    void add_side(double radius_mm);
    void add_face(const ProfileElement& element);
    void add_level(double up, double height_mm);

    std::vector<Face> faces_;
    std::vector<Zone> zones_;
    double radius_mm_, length_mm_;
};

}  // namespace tribo::milling

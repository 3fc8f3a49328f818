// SPDX-License-Identifier: MIT
// Polygons to triangles. Exporters write concave faces into files whose format promises convex ones (98 of
// 90,379 measured VRML faces). Therefore every face with more than three corners is tested, whatever its
// flags say.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/mesh.hpp"

namespace tribo::readers {

// One object per file. Allocates only when a face is longer than all faces before it.
class PolygonTriangulator {
  public:
    // Upper limit of corner tests for all concave faces of a file (one to two seconds), against files made to
    // be slow.
    static constexpr std::uint64_t kMaxTests = 40'000'000;
    // A face of n corners takes n^3 / 3 tests at most: a single face of this many is always cut.
    static constexpr std::uint64_t kAlwaysCut = 480;
    // What a reader says where the tests are used up.
    static constexpr const char* kTooConcave =
        "the concave faces are too many and too long to be cut into triangles";
    static constexpr const char* kTooConcaveRemedy =
        "export the model as triangles, or in faces of at most 480 corners";

    // Appends the triangles of the face whose corner i has index corners[i] and position points[i]. Uses a
    // fan from the first corner if it is correct, else ear clipping (Meisters 1975) in the plane of the
    // largest projection of the face. Repeated neighbours count once; a face with less than three corners
    // gives nothing. Returns false when the tests are used up.
    bool append(std::span<const std::uint32_t> corners, std::span<const Vec3> points,
                std::vector<Triangle>& out);

    // Number of faces that intersect themselves or have no area. They were triangulated anyway.
    std::uint64_t crossing_faces() const { return crossing_; }

  private:
    struct Corner {
        double u, v;  // in the plane, counter-clockwise
        std::uint32_t index;
        std::uint32_t before, after;
    };
    void project(std::span<const std::uint32_t> corners, std::span<const Vec3> points);
    double turn(const Corner& a, const Corner& b, const Corner& c) const;
    bool fan_fits() const;
    bool is_ear(std::uint32_t corner);
    bool clip_ears(std::vector<Triangle>& out);

    std::vector<Corner> corners_;
    double flat_ = 0;  // turns up to this value count as straight
    std::uint64_t tests_ = 0, crossing_ = 0;
};

}  // namespace tribo::readers

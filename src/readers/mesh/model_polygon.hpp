// SPDX-License-Identifier: MIT
// Polygons to triangles. Exporters leave concave faces in files whose format promises convex ones (98 of
// 90,379 measured VRML faces), so every face with more than three corners is tested, whatever its flags say.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/mesh.hpp"

namespace tribo::readers {

// One object per file; allocates only while its longest face grows.
class PolygonTriangulator {
  public:
    // Corner-in-triangle tests for all concave faces of a file, one to two seconds: files made to be slow end
    // here.
    static constexpr std::uint64_t kMaxTests = 40'000'000;

    // Appends the triangles of the face whose corner i is number corners[i] at points[i]. A fan from the
    // first corner where that is right, else ear clipping (Meisters 1975) in the plane along which the face
    // is largest. Repeated neighbours count once; a face of less than three corners gives nothing. False when
    // the tests are spent.
    bool append(std::span<const std::uint32_t> corners, std::span<const Vec3> points,
                std::vector<Triangle>& out);

    // Faces found to cross themselves or to have no area: they were cut somehow.
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
    double flat_ = 0;  // a turn up to this is straight on
    std::uint64_t tests_ = 0, crossing_ = 0;
};

}  // namespace tribo::readers

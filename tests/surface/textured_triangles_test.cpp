// SPDX-License-Identifier: MIT
#include "surface/textured_triangles.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "grooves.hpp"

namespace tribo::surface {
namespace {

// Grooves of a ball of radius 5 with a sidestep of 1 (scallop 25 um), with feed marks along x: a wave.
class Marked final : public contact::DistanceField {
  public:
    Marked(double mark_pitch, double mark_height) : pitch_(mark_pitch), height_(mark_height) {}
    double distance_mm(Vec3 p) const override {
        const double wave = 0.5 * height_ * std::cos(2 * std::numbers::pi * p.x / pitch_);
        return 0.9 * grooves_.distance_mm({p.x, p.y, p.z + wave});
    }
    Vec3 normal(Vec3) const override { return {0, 0, 1}; }

  private:
    test::Grooves grooves_{1, 5, test::row(-10, 1, 21)};
    double pitch_, height_;
};

const double kScallop = 5 - std::sqrt(25 - 0.25);

TEST(TexturedTriangles, find_the_pitch_and_height_of_scallops_and_feed_marks) {
    const Marked surface(0.5, 0.008);
    const auto record = textured_triangles(surface, {{0, 0, 1}, {0, 0, 1}, {1, 0, 0}});
    ASSERT_TRUE(record);
    const contact::GrooveGeometry& g = record->grooves;
    EXPECT_NEAR(g.pitch_across_mm, 1, 0.02);
    EXPECT_NEAR(g.height_across_mm, kScallop, 0.1 * kScallop);
    EXPECT_NEAR(g.pitch_along_mm, 0.5, 0.01);
    EXPECT_NEAR(g.height_along_mm, 0.008, 0.0008);
}

TEST(TexturedTriangles, keep_a_pitch_that_the_job_knows) {
    const Marked surface(0.5, 0.008);
    const auto record = textured_triangles(surface, {{0, 0, 1}, {0, 0, 1}, {1, 0, 0}}, {1.0, 0.5, 6});
    ASSERT_TRUE(record);
    const contact::GrooveGeometry& g = record->grooves;
    EXPECT_EQ(g.pitch_across_mm, 1);
    EXPECT_EQ(g.pitch_along_mm, 0.5);
    EXPECT_NEAR(g.height_across_mm, kScallop, 0.1 * kScallop);
    EXPECT_NEAR(g.height_along_mm, 0.008, 0.0008);
}

TEST(TexturedTriangles, lie_on_the_machined_surface_in_a_fan_of_eight) {
    const Marked surface(0.5, 0.008);
    const auto record = textured_triangles(surface, {{0.1, 0, 1}, {0, 0, 1}, {1, 0, 0}}, {1.0, 0.5, 6});
    ASSERT_TRUE(record);
    double area = 0;
    for (const contact::TexturedTriangle& t : record->triangles()) {
        for (const Vec3& corner : t.corners_mm) EXPECT_NEAR(surface.distance_mm(corner), 0, 1e-3);
        const Vec3 n = cross(t.corners_mm[1] - t.corners_mm[0], t.corners_mm[2] - t.corners_mm[0]);
        EXPECT_GT(dot(normalized(n), t.normal), 0.9999);
        area += 0.5 * n.z;
    }
    EXPECT_NEAR(area, 1 * 0.5, 1e-9);
    // At the bottom of a groove: the cusps at both sides are a scallop higher.
    EXPECT_NEAR(record->height_mm[0][1] - record->height_mm[1][1], kScallop, 1e-4);
    EXPECT_NEAR(record->height_mm[2][1] - record->height_mm[1][1], kScallop, 1e-4);
}

TEST(TexturedTriangles, are_none_where_there_is_no_surface) {
    const Marked surface(0.5, 0.008);
    EXPECT_FALSE(textured_triangles(surface, {{0, 0, 50}, {0, 0, 1}, {1, 0, 0}}));
}

}  // namespace
}  // namespace tribo::surface

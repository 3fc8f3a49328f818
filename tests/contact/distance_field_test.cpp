// SPDX-License-Identifier: MIT
#include "contact/distance_field.hpp"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "base/noise_hash.hpp"

namespace tribo::contact {
namespace {

// The material that two balls of air leave: where they meet it has an edge, a circle about the z axis.
class TwoBalls final : public DistanceField {
  public:
    TwoBalls(double radius_mm, double apart_mm) : radius_(radius_mm), half_(0.5 * apart_mm) {}
    double distance_mm(Vec3 p) const override { return sample(p).distance_mm; }
    Vec3 normal(Vec3 p) const override { return sample(p).normal; }
    SurfaceSample sample(Vec3 p) const override { return of(p.z > 0 ? 1 : 0, p); }
    SurfaceSample sample_piece(std::uint32_t piece, Vec3 p) const override {
        ++asked;
        return of(piece, p);
    }
    double edge_radius() const { return std::sqrt(radius_ * radius_ - half_ * half_); }
    Vec3 on_edge(double angle) const {
        return {edge_radius() * std::cos(angle), edge_radius() * std::sin(angle), 0};
    }
    // A point to which the edge at this angle is the nearest material.
    Vec3 beside_edge(double angle, double way_mm, double share) const {
        const Vec3 at = on_edge(angle);
        return at + way_mm * normalized(share * of(0, at).normal + (1 - share) * of(1, at).normal);
    }

    mutable long asked = 0;

  private:
    SurfaceSample of(std::uint32_t piece, Vec3 p) const {
        const Vec3 off = p - Vec3{0, 0, piece == 1 ? half_ : -half_};
        return {radius_ - length(off), -normalized(off, {0, 0, 1}), piece};
    }
    double radius_, half_;
};

struct Case {
    TwoBalls field;
    double angle, way, share, turn;
};
Case random_case(const CounterNoise& noise, std::uint64_t& drawn) {
    const auto between = [&](double low, double high) { return low + (high - low) * noise.uniform(drawn++); };
    const double radius = between(0.5, 10), apart = radius * between(0.05, 1.5);
    return {TwoBalls(radius, apart), between(0, 2 * std::numbers::pi), radius * between(0.02, 0.5),
            between(0.1, 0.9), between(-0.1, 0.1)};
}

// Each round asks both pieces.
TEST(DistanceField, an_edge_that_bends_is_followed_in_three_rounds_and_once_its_bend_is_known_in_two) {
    const CounterNoise noise(8);
    std::uint64_t drawn = 0;
    constexpr int kCases = 2000;
    std::array<long, 2> asked{};
    for (int n = 0; n < kCases; ++n) {
        const Case c = random_case(noise, drawn);
        HalfSpaces sides;
        for (const std::uint32_t piece : {0u, 1u}) {
            const SurfaceSample s = c.field.sample_piece(piece, c.field.on_edge(c.angle));
            sides.put({s.normal, dot(s.normal, c.field.on_edge(c.angle)), piece}, 1);
        }
        double angle = c.angle;
        Vec3 at = c.field.on_edge(angle);
        for (long& all : asked) {
            angle += c.turn;
            const Vec3 p = c.field.beside_edge(angle, c.way, c.share), flat = sides.nearest(p);
            c.field.asked = 0;
            const HalfSpaces::Edge edge = sides.edge_at(flat);
            ASSERT_GT(squared_length(edge.along), 0) << n;
            const Foot foot = nearest_on(c.field, p, sides.nearest_on_bend(p, edge, flat, at), sides);
            ASSERT_TRUE(foot.found) << n;
            EXPECT_NEAR(foot.sample.distance_mm, c.way, 1e-5) << n;
            EXPECT_LE(c.field.asked, 2 * 4) << n;
            all += c.field.asked;
            at = foot.at_mm;
            sides = foot.sides;
        }
    }
    EXPECT_LE(asked[0], 2 * 3.3 * kCases);
    EXPECT_LE(asked[1], 2 * 2.3 * kCases);
}

// Two planes that meet, and a third one that touches their edge, as a searched sweep gives it: asked for all
// pieces it is off by `error_mm` from what it is when asked alone.
class UnsureEdge final : public DistanceField {
  public:
    static constexpr Vec3 kEdge{90.3, 50.1, -40.7};  // a place on it
    explicit UnsureEdge(double error_mm) : error_(error_mm) {}
    double distance_mm(Vec3 p) const override { return sample(p).distance_mm; }
    Vec3 normal(Vec3 p) const override { return sample(p).normal; }
    SurfaceSample sample(Vec3 p) const override {
        if (std::abs(p.y - kEdge.y) > 1e-3) return sample_piece(p.y > kEdge.y ? 1 : 0, p);
        SurfaceSample s = sample_piece(2, p);
        s.distance_mm += error_;
        return s;
    }
    SurfaceSample sample_piece(std::uint32_t piece, Vec3 p) const override {
        static constexpr std::array<Vec3, 3> kNormals{{{0, -0.6, 0.8}, {0, 0.6, 0.8}, {0, 0, 1}}};
        return {dot(kNormals[piece], p - kEdge), kNormals[piece], piece};
    }

  private:
    double error_;
};

// The place was never taken for found, and where a step had no length, its bend, 0 / 0, made the place NaN.
TEST(DistanceField, an_edge_is_found_where_a_searched_sweep_gives_two_answers) {
    const CounterNoise noise(9);
    std::uint64_t drawn = 0;
    const auto between = [&](double low, double high) { return low + (high - low) * noise.uniform(drawn++); };
    for (int n = 0; n < 1000; ++n) {
        const UnsureEdge field(between(-1e-5, 1e-5));
        HalfSpaces sides;
        for (const std::uint32_t piece : {0u, 1u}) {
            const SurfaceSample s = field.sample_piece(piece, field.kEdge);
            sides.put({s.normal, dot(s.normal, field.kEdge), piece}, 1);
        }
        const Vec3 p = field.kEdge + Vec3{between(-1, 1), between(-0.4, 0.4), between(1, 2)};
        for (const Foot& foot :
             {nearest_on(field, p, field.kEdge, sides), nearest_from(field, p, field.kEdge)}) {
            ASSERT_NEAR(foot.sample.distance_mm, std::hypot(p.y - field.kEdge.y, p.z - field.kEdge.z), 3e-5)
                << n;
            ASSERT_NEAR(distance(foot.at_mm, p), foot.sample.distance_mm, 1e-9) << n;
        }
    }
}

}  // namespace
}  // namespace tribo::contact

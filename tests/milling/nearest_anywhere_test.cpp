// SPDX-License-Identifier: MIT
// The nearest surface around any passes, asked anew and along walks: nothing that a ray in any direction hits
// is nearer, and what is told is the surface or nothing, not a bound.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "base/spiral.hpp"
#include "milling/any_passes.hpp"

namespace tribo::milling {
namespace {

constexpr double kFar = 1e30;

// Walls less thick than this may count or not, mm.
constexpr double kThin = 1.2 * contact::kThinnestWall;

// The shortest way to material of all directions of a spiral (Vogel 1979), up to `most`.
double shortest_ray_mm(const field::CarvedField& field, Vec3 p, double most) {
    constexpr int kRays = 300;
    double shortest = kFar;
    for (int n = 0; n < kRays; ++n) {
        const Vec3 ray = tribo::test::spiral_direction(n, kRays);
        double way = std::max(0.0, field.distance_mm(p));
        while (way < std::min(shortest, most)) {
            const double air = field.distance_mm(p + way * ray);
            if (air < -0.5 * kThin) shortest = way;
            way += std::max(air, 0.5 * kThin);
        }
    }
    return shortest;
}

struct Checked {
    long places = 0, lost = 0, bounds = 0;
    void check(const field::CarvedField& field, Vec3 p, double within, double ray,
               const contact::SurfaceSample& told) {
        // A step of the rays, and what is not looked for (ShownSurface).
        const double error = 2 * kThin + 0.01 * field.cell_mm();
        ++places;
        lost += ray < std::min(told.distance_mm, within) - error ? 1 : 0;
        const Vec3 foot = p - told.distance_mm * told.normal;
        bounds += told.distance_mm < within - 1e-9 && std::abs(field.distance_mm(foot)) > kThin ? 1 : 0;
    }
};

Checked walk_anywhere(std::uint64_t seed, std::uint64_t scenes, double meeting_share) {
    Checked checked;
    for (std::uint64_t n = 0; n < scenes; ++n) {
        test::Draw draw(seed, n);
        const test::AnyPasses stock(draw, meeting_share, n % 2 == 0);
        for (int walk = 0; walk < 6; ++walk) {
            const double radius = draw.between(0.1, 1.5), within = (walk % 3 == 0 ? 1.2 : 2) * radius;
            const Vec3 on_way = stock.on_way(draw);
            Vec3 p = on_way + draw.aside(2, 0, 4);
            const double way = draw.between(0.01, 0.3);
            const Vec3 step = way * normalized(draw.aside(1, -1, 1), Vec3{1, 0, 0});
            contact::NearHint hint;
            hint.at_mm = hint.from_mm = p;
            for (int k = 0; k < 12; ++k, p += step) {
                const double air = stock.field->distance_mm(p);
                if (air <= 0 || air >= radius) continue;
                const double ray = shortest_ray_mm(*stock.field, p, within);
                contact::NearHint none;
                checked.check(*stock.field, p, within, ray, stock.field->nearest(p, within, none));
                checked.check(*stock.field, p, within, ray, stock.field->nearest(p, within, hint));
            }
        }
    }
    return checked;
}

// Where two edges are within a cell of each other, a search may still end at the farther one: 20 of a
// million. Where passes just meet, some more, in walls of some micrometres.
void expect_found(std::uint64_t seed, std::uint64_t scenes) {
    for (const double meeting_share : {0.0, 0.5}) {
        const Checked checked = walk_anywhere(seed, scenes, meeting_share);
        EXPECT_LE(checked.lost, checked.places / (meeting_share == 0 ? 20000 : 5000)) << checked.places;
        EXPECT_LE(checked.bounds, checked.places / 20000) << checked.places;
        EXPECT_GT(checked.places, static_cast<long>(20 * scenes));
    }
}

TEST(NearestAnywhere, is_no_farther_than_what_any_ray_hits) {
    expect_found(101, 60);
}

// For a long `make soak`.
TEST(NearestAnywhere, DISABLED_is_no_farther_than_what_any_ray_hits_in_a_million_places) {
    expect_found(201, 20000);
}

}  // namespace
}  // namespace tribo::milling

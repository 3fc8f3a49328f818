// SPDX-License-Identifier: MIT
// The nearest surface point over scallops, cusps included, against their closed form: at places that wander,
// with what is known from place to place.
#include <cmath>
#include <gtest/gtest.h>

#include "base/noise_hash.hpp"
#include "field/carved/carved_field.hpp"
#include "field/shape/box_shape.hpp"
#include "milling/sweep/sweep.hpp"

namespace tribo::milling {
namespace {

constexpr double kTool = 5, kPitch = 1, kTruth = 1e-4;  // 0.1 um

// Grooves along y, kPitch apart, with their bottoms at z = -1.
std::unique_ptr<field::CarvedField> scallops(double cell_mm) {
    auto stock = std::make_unique<field::CarvedField>(
        std::make_unique<field::BoxShape>(Box3{{0, 0, -6}, {20, 20, 0}}), cell_mm);
    Cutter cutter;
    cutter.kind = CutterKind::ball;
    cutter.diameter_mm = 2 * kTool;
    cutter.length_mm = 30;
    for (int x = -3; x <= 23; ++x) {
        motion::Move move;
        move.start.tip_mm = {x * kPitch, -20, -1};
        move.end.tip_mm = {x * kPitch, 40, -1};
        stock->carve(make_sweep(cutter, move));
    }
    return stock;
}

// From the cusps, and from the grooves where their arc faces the point.
double distance_to_scallops(Vec3 p) {
    double least = 1e9;
    for (int n = 0; n <= 20; ++n) {
        const double half = 0.5 * kPitch, cusp_z = kTool - 1 - std::sqrt(kTool * kTool - half * half);
        least = std::min(least, std::hypot(p.x - n * kPitch - half, p.z - cusp_z));
        const double across = p.x - n * kPitch, up = p.z - (kTool - 1), from_axis = std::hypot(across, up);
        if (up < 0 && std::abs(across) / from_axis * kTool <= half)
            least = std::min(least, kTool - from_axis);
    }
    return least;
}

TEST(NearestPoint, is_that_of_the_closed_form_wherever_the_point_wanders) {
    for (const double cell : {0.1, 0.25}) {
        const auto stock = scallops(cell);
        const CounterNoise noise(3);
        std::uint64_t drawn = 0;
        const auto between = [&](double low, double high) {
            return low + (high - low) * noise.uniform(drawn++);
        };
        for (int walk = 0; walk < 600; ++walk) {
            const double radius = between(0.02, 0.6), step = std::pow(10, between(-4, -0.5));
            Vec3 p{between(6, 14), between(6, 14), -0.97 + radius};
            contact::NearHint hint;
            hint.at_mm = p;
            for (int n = 0; n < 200; ++n) {
                const double truth = distance_to_scallops(p);
                const contact::SurfaceSample s = stock->nearest(p, 1, hint);
                ASSERT_NEAR(s.distance_mm, truth, kTruth) << cell << " " << walk << " " << n;
                hint.at_mm = p - s.distance_mm * s.normal;
                // On along the surface, at about the ball's height.
                p += step * Vec3{between(-1, 1), between(-1, 1), 0};
                p.x = std::clamp(p.x, 4.0, 16.0);
                p.y = std::clamp(p.y, 4.0, 16.0);
                p.z = -0.97 + radius + 0.2 * step * between(-1, 1);
            }
        }
    }
}

}  // namespace
}  // namespace tribo::milling

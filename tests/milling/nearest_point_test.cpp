// SPDX-License-Identifier: MIT
// The nearest surface point of milled stock, cusps and corners included, at places that wander, with what is
// known from place to place: against a closed form over scallops, elsewhere against a search over directions
// that knows only the sweeps.
#include <cmath>
#include <gtest/gtest.h>
#include <memory>

#include "base/noise_hash.hpp"
#include "base/spiral.hpp"
#include "contact/search_memory.hpp"
#include "field/carved/carved_field.hpp"
#include "field/shape/box_shape.hpp"
#include "haptics/milled_field.hpp"
#include "milling/sweep/sweep.hpp"
#include "motion/path/moves.hpp"

namespace tribo::milling {
namespace {

constexpr double kTool = 5, kPitch = 1, kTruth = 2e-5;  // 0.02 um

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
    const auto memory = std::make_unique<contact::SearchMemory>();
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
            memory->forget();
            contact::NearHint hint;
            hint.memory = memory.get();
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

// Grooves of a ball along y, `pitch` apart and as deep as leaves cusps of `height`, all over a plate and its
// edges. Far from its ends along y the distance to it is that to a profile in the plane of x and z.
struct Plate {
    static constexpr int kPasses = 16;
    double pitch, radius, bottom, width;
    std::unique_ptr<field::CarvedField> stock;

    Plate(double pitch_mm, double height_mm, double cell_mm)
        : pitch(pitch_mm),
          radius((0.25 * pitch * pitch + height_mm * height_mm) / (2 * height_mm)),
          bottom(-2 * height_mm),
          width(kPasses * pitch),
          stock(haptics::test::scalloped_plate(pitch, height_mm, 2 * pitch, kPasses, cell_mm).field) {}
    // From a point above the plate's underside: the cusps, the upper edges of both sides, the arcs that face
    // the point, and the sides where it is below those edges.
    double distance_mm(Vec3 p) const {
        const double centre_z = bottom + radius;
        const double cusp_z = centre_z - std::sqrt(radius * radius - 0.25 * pitch * pitch);
        double least = 1e9;
        for (int n = 0; n <= kPasses; ++n) {
            const double x = n * pitch, across = p.x - x, from_axis = std::hypot(across, p.z - centre_z);
            if (n < kPasses) least = std::min(least, std::hypot(across - 0.5 * pitch, p.z - cusp_z));
            const double foot = across / from_axis * radius;
            if (p.z < centre_z && std::abs(foot) <= 0.5 * pitch && x + foot >= 0 && x + foot <= width)
                least = std::min(least, std::abs(radius - from_axis));
        }
        for (const double side : {0.0, width}) {
            const double out = side == 0 ? -p.x : p.x - width;
            least = std::min(least, std::hypot(out, p.z - bottom));
            if (p.z < bottom && out > 0) least = std::min(least, out);
        }
        return least;
    }
};

// Farther away a carved field gives a lower bound.
constexpr double kReachCells = 42;

// Balls from a tenth of a groove to several grooves over the plate and its edges, with and without what is
// known from the last place. At a grid of two cells a groove a search must not pass over a cusp.
void expect_that_of_plates(int plates) {
    const auto memory = std::make_unique<contact::SearchMemory>();
    const CounterNoise noise(41);
    std::uint64_t drawn = 0;
    const auto between = [&](double low, double high) { return low + (high - low) * noise.uniform(drawn++); };
    for (int k = 0; k < plates; ++k) {
        const double pitch = between(0.1, 2);
        const Plate plate(pitch, pitch * std::pow(10, between(-2, -0.6)), between(0.1, 0.5) * pitch);
        for (int walk = 0; walk < 100; ++walk) {
            const double radius = std::min(pitch * between(0.1, 8), 40 * plate.stock->cell_mm()),
                         step = pitch * std::pow(10, between(-3, 0.5));
            memory->forget();
            contact::NearHint hint;
            hint.memory = memory.get();
            double x = between(-radius, plate.width + radius), y = between(0.4, 0.6) * plate.width;
            for (int n = 0; n < 10; ++n) {
                x = std::clamp(x + step * between(-1, 1), -radius, plate.width + radius);
                // Down to where a ball of this radius touches, or a little more or less.
                double low = plate.bottom - pitch, high = plate.bottom + 2 * radius + pitch;
                while (high - low > 1e-3 * radius) {
                    const double z = 0.5 * (low + high);
                    (plate.distance_mm({x, y, z}) < radius ? low : high) = z;
                }
                const Vec3 p{x, y + step * between(-1, 1), high + 0.1 * step * between(-1, 1)};
                if (plate.stock->distance_mm(p) <= 0) continue;
                const double truth = plate.distance_mm(p);
                if (n == 0) hint.at_mm = hint.from_mm = p;
                const double known = plate.stock->nearest(p, 2 * radius, hint).distance_mm;
                contact::NearHint none;
                none.at_mm = none.from_mm = p;
                const double cold = plate.stock->nearest(p, 2 * radius, none).distance_mm;
                if (truth >= std::min(2 * radius, kReachCells * plate.stock->cell_mm())) continue;
                ASSERT_NEAR(known, truth, kTruth) << k << " " << walk << " " << n;
                ASSERT_NEAR(cold, truth, kTruth) << k << " " << walk << " " << n;
            }
        }
    }
}

TEST(NearestPoint, is_that_of_the_closed_form_over_random_plates_and_their_edges) {
    expect_that_of_plates(40);
}

// For a long `make soak`.
TEST(NearestPoint, DISABLED_is_that_of_the_closed_form_a_million_times) {
    expect_that_of_plates(1100);
}

Cutter cutter_of(CutterKind kind, double diameter_mm) {
    Cutter cutter;
    cutter.kind = kind;
    cutter.diameter_mm = diameter_mm;
    cutter.length_mm = 30;
    return cutter;
}

// What was found for a point a little away saves searches. After a cut, on the way back, the answers are
// those of a search that remembers nothing.
TEST(NearestPoint, with_memory_saves_searches_and_is_the_same_before_and_after_a_cut) {
    constexpr double kPitch = 0.4, kRadius = 1.2;
    constexpr int kSteps = 400;
    const CounterNoise noise(5);
    const auto memory = std::make_unique<contact::SearchMemory>();
    long with_memory = 0, without = 0;
    for (std::uint64_t k = 0; k < 40; ++k) {
        const Plate plate(kPitch, 0.05, 0.4 * kPitch);
        memory->forget();
        const Vec3 from{3 + noise.uniform(5 * k), 3 + noise.uniform(5 * k + 1), 1.1};
        const auto query = [&](int step) {
            const Vec3 p = from + (step * 1e-3) * Vec3{2, 1, 0};
            // No hint: both have to prove that no place is nearer.
            contact::NearHint hint, none;
            hint.at_mm = hint.from_mm = none.at_mm = none.from_mm = p;
            hint.memory = memory.get();
            ASSERT_NEAR(plate.stock->nearest(p, 2 * kRadius, hint).distance_mm,
                        plate.stock->nearest(p, 2 * kRadius, none).distance_mm, kTruth)
                << k << " " << step;
            with_memory += hint.searches;
            without += none.searches;
        };
        for (int n = 0; n < kSteps; ++n) query(n);
        const Vec3 at = from + (kSteps * 1e-3) * Vec3{2, 1, 0};
        motion::Move cut;
        cut.start.tip_mm = {at.x - 1, at.y + noise.uniform(5 * k + 2) - 0.5,
                            -0.07 - 0.1 * noise.uniform(5 * k + 3)};
        cut.end.tip_mm = cut.start.tip_mm + Vec3{2 * noise.uniform(5 * k + 4), 0.3, 0};
        plate.stock->carve(make_sweep(cutter_of(CutterKind::ball, 0.8), cut));
        for (int n = kSteps; n-- > kSteps - 20;) query(n);
    }
    EXPECT_LT(with_memory, 0.85 * static_cast<double>(without));
}

// Stock with all that was carved from it.
struct Carved {
    Box3 box_mm;
    field::BoxShape box;
    field::CarvedField stock;
    std::vector<std::unique_ptr<const field::Shape>> sweeps;

    Carved(const Box3& of, double cell_mm)
        : box_mm(of), box(of), stock(std::make_unique<field::BoxShape>(of), cell_mm) {}
    void mill(const Cutter& cutter, const motion::Move& move) {
        for (const motion::Move& piece : motion::to_elementary(move)) {
            stock.carve(make_sweep(cutter, piece));
            sweeps.push_back(make_sweep(cutter, piece));
        }
    }
    // A ball of this radius is air around the point; 0 or less in material.
    double air_mm(Vec3 p) const {
        double air = box.distance_mm(p);
        for (const auto& sweep : sweeps) air = std::max(air, -sweep->distance_below(p, -air));
        return air;
    }
    // From a point in air to the first material in a direction (Hart 1996).
    double ray_mm(Vec3 p, Vec3 way) const {
        double at = 0;
        for (int steps = 0; steps < 100; ++steps) {
            const double air = air_mm(p + at * way);
            if (air < 1e-7 || at > 10) break;
            at += air;
        }
        return at;
    }
    // The shortest of all rays, by a search over directions from the best of many.
    double nearest_mm(Vec3 p) const {
        constexpr int kWays = 150, kStarts = 4;
        std::vector<std::pair<double, Vec3>> rays;
        for (int n = 0; n < kWays; ++n) {
            const Vec3 way = tribo::test::spiral_direction(n, kWays);
            rays.emplace_back(ray_mm(p, way), way);
        }
        std::sort(rays.begin(), rays.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
        double nearest = 1e9;
        for (int n = 0; n < kStarts; ++n) {
            auto [least, way] = rays[static_cast<std::size_t>(n)];
            const Vec3 u = normalized(cross(way, std::abs(way.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0}));
            for (double step = 0.1; step > 1e-4;) {
                // Along an edge only few ways lead on: others each time.
                Vec3 best = way;
                for (int k = 0; k < 16; ++k) {
                    const double turn = 0.39269908169872414 * k + 1e3 * step;
                    const Vec3 next =
                        normalized(way + step * (std::cos(turn) * u + std::sin(turn) * cross(way, u)));
                    const double mm = ray_mm(p, next);
                    if (mm < least) {
                        least = mm;
                        best = next;
                    }
                }
                if (best == way) step *= 0.5;
                way = best;
            }
            nearest = std::min(nearest, least);
        }
        return nearest;
    }
};

// Walks of a point through the air near the surface: its distance to it is `radius` or less. The hint is that
// of the walk.
void expect_nearest(const Carved& part, const Box3& inside, double most_radius_mm, int walks, int steps) {
    const auto memory = std::make_unique<contact::SearchMemory>();
    const CounterNoise noise(17);
    std::uint64_t drawn = 0;
    const auto between = [&](double low, double high) { return low + (high - low) * noise.uniform(drawn++); };
    int measured = 0;
    for (int walk = 0; walk < walks; ++walk) {
        const double step = std::pow(10, between(-3, -0.5)), most = between(0.05, most_radius_mm);
        Vec3 p;
        do {
            p = {between(inside.min.x, inside.max.x), between(inside.min.y, inside.max.y),
                 between(inside.min.z, inside.max.z)};
        } while (part.air_mm(p) <= 1e-3 || part.air_mm(p) > most);
        memory->forget();
        contact::NearHint hint;
        hint.memory = memory.get();
        hint.at_mm = p;
        for (int n = 0; n < steps; ++n) {
            const contact::SurfaceSample s = part.stock.nearest(p, 2 * most_radius_mm, hint);
            const double truth = part.nearest_mm(p);
            if (truth < 2 * most_radius_mm) {
                ++measured;
                // On the surface, and nothing nearer; the search over directions ends a little too far.
                ASSERT_NEAR(part.air_mm(p - s.distance_mm * s.normal), 0, kTruth) << walk << " " << n;
                ASSERT_LE(s.distance_mm, truth + kTruth) << walk << " " << n;
                ASSERT_GE(s.distance_mm, truth - 10 * kTruth) << walk << " " << n;
            }
            Vec3 next;
            do {
                next = p + step * Vec3{between(-1, 1), between(-1, 1), between(-1, 1)};
            } while (part.air_mm(next) <= 1e-4 || part.air_mm(next) > most + step);
            p = next;
        }
    }
    EXPECT_GT(measured, walks * steps / 2);
}

// Four sweeps meet in each corner between the marks.
TEST(NearestPoint, is_the_shortest_of_all_rays_over_a_grid_of_marks) {
    Carved part({{0, 0, -6}, {8, 8, 0}}, 0.15);
    const Cutter ball = cutter_of(CutterKind::ball, 8);
    for (double x = 1; x <= 7; x += 1) {
        for (double y = 1; y <= 7; y += 0.5) {
            motion::Move mark;
            mark.start.tip_mm = {x - 0.3, y, -0.6};
            mark.end.tip_mm = {x + 0.3, y, -0.6};
            part.mill(ball, mark);
        }
    }
    expect_nearest(part, {{2, 2, -0.6}, {6, 6, 1.5}}, 2, 40, 12);
}

TEST(NearestPoint, is_the_shortest_of_all_rays_over_five_axis_passes) {
    Carved part({{0, 0, -6}, {8, 8, 0}}, 0.15);
    const Cutter ball = cutter_of(CutterKind::ball, 8);
    const auto pose = [](double x, double y) {
        const Vec3 axis =
            normalized(Vec3{0.15 * std::cos(0.3 * x + 0.2 * y), 0.2 + 0.15 * std::sin(0.3 * y), 1});
        return motion::ToolPose{Vec3{x, y, -0.8 + 0.2 * std::sin(0.5 * x) * std::cos(0.4 * y) + 4} - 4 * axis,
                                axis};
    };
    for (double x = 0; x <= 8; x += 0.8) {
        const motion::ToolPose a = pose(x, 0), mid = pose(x, 4), b = pose(x, 8);
        motion::Move move;
        move.start = a;
        move.end = b;
        move.quadratic = motion::Quadratic{2 * mid.tip_mm - 0.5 * (a.tip_mm + b.tip_mm),
                                           2 * mid.axis - 0.5 * (a.axis + b.axis)};
        part.mill(ball, move);
    }
    expect_nearest(part, {{2, 2, -1}, {6, 6, 1.5}}, 2, 8, 6);
}

// The depth in the sweep of a tilted flat cutter is less than the distance to its floor: no place is proven
// by the shapes that meet there alone.
Carved passes_of_a_tilted_flat_cutter() {
    Carved part({{0, 0, -6}, {8, 8, 0}}, 0.2);
    const Cutter flat = cutter_of(CutterKind::flat, 6);
    const auto pose = [](double x, double y) {
        const Vec3 axis = normalized(Vec3{0.1 * std::sin(0.5 * y), 0.25 + 0.1 * std::sin(0.3 * x), 1});
        return motion::ToolPose{{x, y - 1, -1 + 0.2 * std::sin(0.4 * x + 0.3 * y)}, axis};
    };
    for (double x = 0; x <= 8; x += 1.6) {
        motion::Move move;
        move.start = pose(x, -1);
        move.end = pose(x, 9);
        part.mill(flat, move);
    }
    return part;
}

TEST(NearestPoint, is_the_shortest_of_all_rays_over_passes_of_a_tilted_flat_cutter) {
    expect_nearest(passes_of_a_tilted_flat_cutter(), {{2, 2, -2}, {6, 6, 1.5}}, 2, 10, 6);
}

// What was searched once over a smooth floor is not searched again at each small step.
TEST(NearestPoint, is_searched_seldom_over_passes_of_a_tilted_flat_cutter) {
    const Carved part = passes_of_a_tilted_flat_cutter();
    const auto memory = std::make_unique<contact::SearchMemory>();
    long searches = 0;
    for (int k = 0; k < 10; ++k) {
        contact::NearHint hint;
        hint.memory = memory.get();
        Vec3 p{2 + 0.1 * k, 2, 1};
        hint.at_mm = hint.from_mm = p;
        for (int n = 0; n < 400; ++n) {
            p.y += 0.008;
            const contact::SurfaceSample s = part.stock.nearest(p, 4, hint);
            ASSERT_NEAR(part.air_mm(p - s.distance_mm * s.normal), 0, kTruth) << k << " " << n;
            if (n % 40 == 0) {
                ASSERT_LE(s.distance_mm, part.nearest_mm(p) + kTruth) << k << " " << n;
            }
        }
        searches += hint.searches;
    }
    EXPECT_LT(searches, 40'000);
}

// The rim of a groove goes over from one sweep's to the next one's every 0.3 mm. A search from a start up to
// a millimetre, five cells, along it ends at the nearest place, on an edge.
TEST(NearestPoint, is_found_along_a_rim_that_many_sweeps_left) {
    Carved part({{0, 0, -4}, {20, 20, 0}}, 0.2);
    const Cutter ball = cutter_of(CutterKind::ball, 3);
    const auto tip = [](double turn) { return Vec3{10 + 7 * std::cos(turn), 10 + 7 * std::sin(turn), -0.6}; };
    constexpr double kTurn = 0.3 / 7;
    for (int n = 0; n < 40; ++n) {
        motion::Move move;
        move.start.tip_mm = tip(n * kTurn);
        move.end.tip_mm = tip((n + 1) * kTurn);
        part.mill(ball, move);
    }
    const CounterNoise noise(29);
    for (std::uint64_t k = 0; k < 200; ++k) {
        const auto between = [&](std::uint64_t n, double low, double high) {
            return low + (high - low) * noise.uniform(4 * k + n);
        };
        // Over the groove, nearer to its outer rim than to any other place.
        const double turn = between(0, 10, 30) * kTurn, away = between(1, -1, 1) / 7;
        const Vec3 p{10 + (7 + between(2, 0.3, 0.9)) * std::cos(turn),
                     10 + (7 + between(2, 0.3, 0.9)) * std::sin(turn), between(3, 1.2, 2)};
        const double rim = 7 + std::sqrt(1.5 * 1.5 - 0.9 * 0.9);
        const Vec3 start{10 + rim * std::cos(turn + away), 10 + rim * std::sin(turn + away), 0};
        const contact::Foot foot = contact::nearest_from(part.stock, p, start, 0.13);
        EXPECT_TRUE(foot.found) << k;
        EXPECT_GE(foot.sides.count, 2) << k;
        EXPECT_LE(foot.sample.distance_mm, part.nearest_mm(p) + kTruth) << k;
    }
}

// A point near the axis of a hole, or of the round end of a slot, is nearly as far from all of its mouth: an
// edge that bends about the point as a circle does.
TEST(NearestPoint, is_that_of_the_closed_form_over_the_mouths_of_holes_and_slots) {
    const auto memory = std::make_unique<contact::SearchMemory>();
    const CounterNoise noise(23);
    std::uint64_t drawn = 0;
    const auto between = [&](double low, double high) { return low + (high - low) * noise.uniform(drawn++); };
    for (int k = 0; k < 60; ++k) {
        const bool is_slot = k % 3 == 0;  // of a ball: over its middle nothing is nearer than the mouth
        const double tool = between(0.5, 3), cell = between(0.05, 0.3) * tool, edge = 2 * tool + 1,
                     deep = is_slot ? between(0.2, 0.9) * tool : 1.9 * tool,
                     mouth = is_slot ? std::sqrt(deep * (2 * tool - deep)) : tool,
                     slot = is_slot ? between(0.5, 2) * tool : 0;
        Carved part({{-edge, -edge, -2 * tool}, {edge + slot, edge, 0}}, cell);
        motion::Move move;
        move.start.tip_mm = {0, 0, is_slot ? -deep : 5};
        move.end.tip_mm = {slot, 0, -deep};
        part.mill(cutter_of(is_slot ? CutterKind::ball : CutterKind::flat, 2 * tool), move);
        const double least_high = is_slot ? tool - deep : 0;
        for (int walk = 0; walk < 20; ++walk) {
            const double off = mouth * std::pow(10, between(-4, -0.5)),
                         high = least_high + mouth * between(0.05, 0.7);
            memory->forget();
            contact::NearHint hint;
            hint.memory = memory.get();
            double turn = between(-3, 3);
            for (int n = 0; n < 20; ++n) {
                turn += between(-0.3, 0.3);
                const Vec3 p{off * std::cos(turn), off * std::sin(turn), high};
                if (n == 0) hint.at_mm = hint.from_mm = p;
                const double aside = std::hypot(p.x - std::clamp(p.x, 0.0, slot), p.y);
                ASSERT_NEAR(part.stock.nearest(p, 4 * tool, hint).distance_mm,
                            std::hypot(mouth - aside, high), kTruth)
                    << k << " " << walk << " " << n;
            }
        }
    }
}

// Ribs with sharp edges, and walls that lean.
TEST(NearestPoint, is_the_shortest_of_all_rays_between_ribs) {
    for (const double lean : {0.0, 0.15}) {
        Carved part({{-6, -6, -6}, {6, 6, 0}}, 0.2);
        const Cutter flat = cutter_of(CutterKind::flat, 2);
        for (double y = -4.4; y <= 4.4; y += 2.2) {
            motion::Move slot;
            slot.start = {{-9, y, -3}, {0, -std::sin(lean), std::cos(lean)}};
            slot.end = {{9, y, -3}, {0, std::sin(lean), std::cos(lean)}};
            for (const motion::Move& piece : motion::to_elementary(slot)) part.mill(flat, piece);
        }
        expect_nearest(part, {{-4, -4, -3}, {4, 4, 0.8}}, 0.8, lean > 0 ? 10 : 40, lean > 0 ? 6 : 12);
    }
}

}  // namespace
}  // namespace tribo::milling

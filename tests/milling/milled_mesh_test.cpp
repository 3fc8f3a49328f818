// SPDX-License-Identifier: MIT
// The mesh of milled parts: closed and nowhere through itself, and good as a blank again.
#include <gtest/gtest.h>
#include <random>

#include "field/contour/contour.hpp"
#include "field/contour/contour_refine.hpp"
#include "field/mesh/mesh_shape.hpp"
#include "field/self_intersection.hpp"
#include "field/shape/box_shape.hpp"
#include "milling/sweep/sweep.hpp"
#include "motion/path/moves.hpp"

namespace tribo::milling {
namespace {

constexpr Box3 kBlank{{-12, -9, -7}, {12, 9, 0}};

// Cutters and moves far apart in size, tilt and direction; the same for one number on every system.
class RandomPart {
  public:
    explicit RandomPart(unsigned number) : bits_(number) {}

    field::CarvedField make(double cell) {
        field::CarvedField part(std::make_unique<field::BoxShape>(kBlank), cell);
        carve(part);
        return part;
    }
    void carve(field::CarvedField& part) {
        const int moves = 3 + static_cast<int>(uniform(0, 12));
        Cutter cutter = any_cutter();
        for (int n = 0; n < moves; ++n) {
            if (uniform(0, 1) < 0.3) cutter = any_cutter();
            for (const motion::Move& piece : motion::to_elementary(any_move()))
                part.carve(make_sweep(cutter, piece));
        }
    }
    double uniform(double low, double high) {
        return low + (high - low) * static_cast<double>(bits_()) * 0x1p-32;
    }

  private:
    Cutter any_cutter() {
        Cutter c;
        c.kind = static_cast<CutterKind>(static_cast<int>(uniform(0, 3)));
        c.diameter_mm = std::exp(uniform(std::log(0.3), std::log(12)));
        c.corner_mm = c.kind == CutterKind::bull ? uniform(0.05, 0.95) * c.radius_mm() : 0;
        c.length_mm = 30;
        return c;
    }
    Vec3 any_axis() {
        const double tilt = uniform(0, 1) < 0.4 ? 0 : uniform(0, 0.9);
        return normalized({uniform(-tilt, tilt), uniform(-tilt, tilt), 1});
    }
    motion::Move any_move() {
        motion::Move m;
        m.feed_mm_per_min = 600;
        m.start = {{uniform(-14, 14), uniform(-11, 11), uniform(-5, 0.5)}, any_axis()};
        m.end = {{uniform(-14, 14), uniform(-11, 11), uniform(-5, 0.5)}, m.start.axis};
        if (uniform(0, 1) < 0.5) m.end.tip_mm.z = m.start.tip_mm.z;
        if (uniform(0, 1) < 0.2) m.end.tip_mm.y = m.start.tip_mm.y;
        if (uniform(0, 1) < 0.25) m.end.axis = any_axis();
        return m;
    }
    std::mt19937 bits_;
};

void expect_solid(const TriangleMesh& mesh, const char* what, unsigned number, double cell) {
    EXPECT_TRUE(is_closed(mesh)) << what << " " << number << " at " << cell;
    EXPECT_TRUE(test::SelfIntersections(mesh).pairs().empty()) << what << " " << number << " at " << cell;
}

TEST(MilledMesh, of_fifty_random_parts_is_closed_and_does_not_meet_itself) {
    for (unsigned number = 0; number < 50; ++number) {
        RandomPart part(number);
        const double cell = std::exp(part.uniform(std::log(0.15), std::log(1.2)));
        const field::CarvedField milled = part.make(cell);
        expect_solid(field::contour(milled), "part", number, cell);
        expect_solid(field::fine_contour(milled), "mended part", number, cell);
    }
}

TEST(MilledMesh, is_a_blank_at_any_grid) {
    for (unsigned number = 100; number < 106; ++number) {
        const TriangleMesh first = field::contour(RandomPart(number).make(0.4));
        for (const double cell : {0.25, 0.4, 0.63}) {
            auto blank = field::MeshShape::make(first);
            ASSERT_TRUE(blank.has_value());
            field::CarvedField part(std::move(*blank), cell);
            RandomPart(number + 1000).carve(part);
            const TriangleMesh second = field::contour(part);
            expect_solid(second, "part on a part", number, cell);
            EXPECT_LT(volume_mm3(second), volume_mm3(first));
        }
    }
}

}  // namespace
}  // namespace tribo::milling

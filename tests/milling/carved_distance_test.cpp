// SPDX-License-Identifier: MIT
// The distance of stock after any passes against that of its shapes, asked one by one.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "milling/any_passes.hpp"
#include "milling/tool/cutter_shape.hpp"

namespace tribo::milling {
namespace {

using test::Draw;
using Shapes = std::vector<std::unique_ptr<const field::Shape>>;

// Whether a place is near the surface. `shapes`: the blank, then what was carved.
bool is_that_of(const Shapes& shapes, const field::CarvedField& field, Vec3 p) {
    constexpr double kError = 2e-4;
    double want = shapes[0]->distance_mm(p);
    for (std::size_t s = 1; s < shapes.size(); ++s) want = std::max(want, -shapes[s]->distance_mm(p));
    const double got = field.distance_mm(p), cell = field.cell_mm();
    if (std::abs(want) > kError) {
        EXPECT_EQ(got > 0, want > 0) << want << " " << got;
    }
    EXPECT_LE(got, std::max(want + kError, field::FieldQuery::kClearCells * cell));
    if (std::abs(want) > 0.1 * cell) return false;
    EXPECT_NEAR(got, want, kError);
    return true;
}

TEST(CarvedDistance, is_that_of_the_shape_that_leaves_least) {
    int near_surface = 0;
    for (std::uint64_t n = 0; n < 60; ++n) {
        test::Draw draw(94, n);
        const test::AnyPasses stock(draw, 0, n % 2 == 0);
        for (int k = 0; k < 20000; ++k)
            near_surface += is_that_of(stock.shapes, *stock.field, draw.aside(12, -16, 0.5)) ? 1 : 0;
    }
    EXPECT_GT(near_surface, 5000);
}

Cutter any_cutter(Draw& draw) {
    constexpr CutterKind kKinds[] = {CutterKind::flat, CutterKind::ball,   CutterKind::taper,
                                     CutterKind::v,    CutterKind::drill,  CutterKind::chamfer,
                                     CutterKind::lens, CutterKind::barrel, CutterKind::lollipop};
    Cutter c;
    c.kind = draw.one_of(kKinds);
    c.diameter_mm = draw.between(4, 14);
    c.length_mm = c.kind == CutterKind::barrel ? 2 * c.diameter_mm : 0;
    c.taper_deg = c.kind == CutterKind::taper ? draw.between(5, 20) : 0;
    c.tip_mm = c.kind == CutterKind::taper || c.kind == CutterKind::chamfer ? 0.4 * c.diameter_mm : 0;
    c.point_deg = c.kind == CutterKind::v || c.kind == CutterKind::chamfer ? draw.between(50, 130) : 0;
    c.neck_mm = c.kind == CutterKind::lollipop ? 0.5 * c.diameter_mm : 0;
    c.side_mm = c.kind == CutterKind::lens     ? c.diameter_mm
                : c.kind == CutterKind::barrel ? 16 * c.diameter_mm
                                               : 0;
    const auto made = make_profile(c);
    EXPECT_TRUE(made) << (made ? "" : made.error().text());
    return c;
}

// A tool that goes back up the way where it stands takes nothing, whatever shape then is said to have left
// the end of its slot.
TEST(CarvedDistance, stays_where_a_tool_goes_back_up) {
    int near_surface = 0;
    for (std::uint64_t n = 0; n < 50; ++n) {
        Draw draw(95, n);
        const Box3 box{{0, 0, -draw.between(8, 12)}, {30, 24, 0}};
        const Cutter cutter = any_cutter(draw);
        field::CarvedField field(std::make_unique<field::BoxShape>(box), draw.between(0.1, 0.3));
        Shapes shapes;
        shapes.push_back(std::make_unique<field::BoxShape>(box));
        const double deep = draw.between(2, 6);
        const Vec3 from{draw.between(8, 10), 12, -deep}, to{draw.between(18, 22), 12, -deep},
            up{0, 0, deep + 3};
        for (const auto& [a, b] : {std::pair{from + up, from}, {from, to}, {to, to + up}}) {
            motion::Move move;
            move.start.tip_mm = a;
            move.end.tip_mm = b;
            shapes.push_back(make_sweep(cutter, move));
            field.carve(make_sweep(cutter, move));
        }
        const double reach = 0.6 * cutter.diameter_mm;
        for (int k = 0; k < 4000; ++k)
            near_surface += is_that_of(shapes, field, to + draw.aside(reach, -1, deep)) ? 1 : 0;
    }
    EXPECT_GT(near_surface, 2000);
}

}  // namespace
}  // namespace tribo::milling

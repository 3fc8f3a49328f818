// SPDX-License-Identifier: MIT
// Stock after passes that are drawn at random: flat, bull and ball nose cutters, upright or leaning, some
// with an axis that turns, some side by side so that they meet, overlap by 1 nm to 0.2 mm, or leave a thin
// wall.
#pragma once

#include <memory>
#include <vector>

#include "base/draw.hpp"
#include "field/carved/carved_field.hpp"
#include "field/shape/box_shape.hpp"
#include "milling/sweep/sweep.hpp"

namespace tribo::milling::test {

using tribo::test::Draw;

struct AnyPasses {
    static constexpr double kTop = 0;  // of the stock, z, mm
    std::unique_ptr<field::CarvedField> field;
    std::vector<std::unique_ptr<const field::Shape>> shapes;  // the blank, then the same sweeps
    std::vector<motion::Move> moves;

    // Of the sweeps: how many are beside the one before. `upright`: no axis leans.
    AnyPasses(Draw& draw, double meeting_share, bool upright) {
        const Box3 box{{-15, -15, -20}, {15, 15, kTop}};
        field = std::make_unique<field::CarvedField>(std::make_unique<field::BoxShape>(box),
                                                     draw.between(0.2, 0.7));
        shapes.push_back(std::make_unique<field::BoxShape>(box));
        const double count = draw.between(2, 7);
        Cutter cutter;
        motion::Move move;
        while (static_cast<double>(moves.size()) < count) {
            if (!moves.empty() && draw.by_chance(meeting_share)) {
                constexpr double kOverlaps[] = {0, 1e-9, 1e-7, 1e-5, 1e-3, 0.03, 0.2, -0.003, -0.05, -0.2};
                const Vec3 way = move.end.tip_mm - move.start.tip_mm,
                           beside = normalized(Vec3{-way.y, way.x, 0});
                const Vec3 by = (cutter.diameter_mm - draw.one_of(kOverlaps)) * beside;
                move.start.tip_mm += by;
                move.end.tip_mm += by;
            } else {
                constexpr CutterKind kKinds[] = {CutterKind::flat, CutterKind::bull, CutterKind::ball};
                cutter = {};
                cutter.kind = draw.one_of(kKinds);
                cutter.diameter_mm = draw.between(2, 8);
                cutter.length_mm = 60;
                if (cutter.kind == CutterKind::bull)
                    cutter.corner_mm = draw.between(0.1, 0.45) * cutter.diameter_mm;
                const Vec3 middle = draw.aside(5, -12, -1);
                const double half_mm = draw.between(1.5, 10);
                const Vec3 half = half_mm * normalized(draw.aside(1), Vec3{1, 0, 0});
                const bool turns = draw.by_chance(0.5);
                move.start = {middle - half, normalized(Vec3{0, 0, 1} + draw.aside(upright ? 0 : 0.3))};
                move.end = {middle + half + Vec3{0, 0, draw.by_chance(0.3) ? draw.between(-2, 2) : 0},
                            normalized(move.start.axis + draw.aside(upright || !turns ? 0 : 0.2))};
            }
            moves.push_back(move);
            shapes.push_back(make_sweep(cutter, move));
            field->carve(make_sweep(cutter, move));
        }
    }
    // A place on the way of one of the cutters.
    Vec3 on_way(Draw& draw) const {
        const motion::Move& move =
            moves[static_cast<std::size_t>(draw.between(0, static_cast<double>(moves.size())))];
        return lerp(move.start.tip_mm, move.end.tip_mm, draw.between(0, 1));
    }
};

}  // namespace tribo::milling::test

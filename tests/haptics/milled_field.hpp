// SPDX-License-Identifier: MIT
// Milled stock for a probe to touch, and beside it, independent of the field, where its air is: the union of
// what the cutter swept and of what lies outside the box.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "field/carved/carved_field.hpp"
#include "field/shape/box_shape.hpp"
#include "milling/sweep/sweep.hpp"

namespace tribo::haptics::test {

struct Milled {
    std::string name;
    std::unique_ptr<field::CarvedField> field;
    Box3 box_mm;
    Box3 strokes_mm;        // where the probe goes; z from the highest surface there
    double feature_mm = 1;  // smallest size of what was milled
    bool open = false;      // strokes leave the stock over its edges
    double deepest_mm = 1;  // of a probe under the top: its sides stay further away
    // How deep in material a point is: the exact distance to the air; 0 or less in air.
    std::function<double(Vec3)> depth_mm;
};

inline milling::Cutter ball_mill(double radius_mm) {
    milling::Cutter cutter;
    cutter.kind = milling::CutterKind::ball;
    cutter.diameter_mm = 2 * radius_mm;
    cutter.length_mm = std::max(30.0, 8 * radius_mm);
    return cutter;
}

// In the box: how far it is to its outside.
inline double depth_in_box(const Box3& box, Vec3 p) {
    return std::min({p.x - box.min.x, box.max.x - p.x, p.y - box.min.y, box.max.y - p.y, p.z - box.min.z,
                     box.max.z - p.z});
}

// Passes of a ball along y, `pitch` apart, that leave cusps of `height`: grooves of z = -height - sink at
// their bottoms in a plate of `thickness` under them. `open`: strokes go over the plate's edges.
inline Milled scalloped_plate(double pitch, double height, double thickness, int passes, double cell,
                              bool open = false) {
    Milled m;
    const double radius = (0.25 * pitch * pitch + height * height) / (2 * height);
    const double width = pitch * passes, bottom = -2 * height;
    m.name = "scallops " + std::to_string(pitch) + ", plate " + std::to_string(thickness);
    m.feature_mm = std::min(pitch, thickness);
    m.box_mm = {{0, 0, bottom - thickness}, {width, width, 0}};
    m.open = open;
    const double edge = open ? -0.3 * width : 0.25 * width;
    m.deepest_mm = 0.125 * width;
    m.strokes_mm = {{edge, edge, bottom - thickness}, {width - edge, width - edge, bottom + height}};
    m.field = std::make_unique<field::CarvedField>(std::make_unique<field::BoxShape>(m.box_mm), cell);
    const milling::Cutter cutter = ball_mill(radius);
    for (int n = -1; n <= passes + 1; ++n) {
        motion::Move move;
        move.start.tip_mm = {n * pitch, -2 * radius, bottom};
        move.end.tip_mm = {n * pitch, width + 2 * radius, bottom};
        m.field->carve(milling::make_sweep(cutter, move));
    }
    m.depth_mm = [box = m.box_mm, pitch, radius, bottom, passes](Vec3 p) {
        const double n = std::clamp(std::round(p.x / pitch), -1.0, passes + 1.0);
        const double across = p.x - n * pitch, up = std::min(p.z - (bottom + radius), 0.0);
        return std::min(depth_in_box(box, p), std::hypot(across, up) - radius);
    };
    return m;
}

// A plate from which nothing was cut.
inline Milled bare_plate(double thickness, double edge, double cell) {
    Milled m;
    m.name = "bare plate " + std::to_string(thickness);
    m.feature_mm = thickness;
    m.box_mm = {{0, 0, -thickness}, {edge, edge, 0}};
    m.open = true;
    m.deepest_mm = 0.125 * edge;
    m.strokes_mm = {{-0.3 * edge, -0.3 * edge, -thickness}, {1.3 * edge, 1.3 * edge, 0}};
    m.field = std::make_unique<field::CarvedField>(std::make_unique<field::BoxShape>(m.box_mm), cell);
    m.depth_mm = [box = m.box_mm](Vec3 p) { return depth_in_box(box, p); };
    return m;
}

// A ball of radius 5 whose axis sways, along y in quadratic pieces of 5 mm, `pitch` apart, over a gently
// curved base: air is where the centre's curve is near, or the tool above it.
inline Milled five_axis_patch(double pitch, double edge, double cell) {
    constexpr double kRadius = 5, kPiece = 5;
    Milled m;
    m.name = "five-axis patch " + std::to_string(pitch);
    m.feature_mm = pitch;
    m.box_mm = {{0, 0, -4}, {edge, edge, 0}};
    m.strokes_mm = {{1, 1, -4}, {edge - 1, edge - 1, -0.3}};
    m.field = std::make_unique<field::CarvedField>(std::make_unique<field::BoxShape>(m.box_mm), cell);
    const auto pose = [](double x, double y) {
        const Vec3 axis =
            normalized(Vec3{0.15 * std::cos(0.3 * x + 0.2 * y), 0.2 + 0.15 * std::sin(0.25 * y), 1});
        const Vec3 centre{x, y, -1 + 0.3 * std::sin(0.3 * x) * std::cos(0.25 * y) + kRadius};
        return motion::ToolPose{centre - kRadius * axis, axis};
    };
    const milling::Cutter cutter = ball_mill(kRadius);
    std::vector<motion::Move> moves;
    for (double x = -2 * pitch; x <= edge + 2 * pitch; x += pitch) {
        for (double y = -kPiece; y < edge + kPiece; y += kPiece) {
            const motion::ToolPose a = pose(x, y), mid = pose(x, y + 0.5 * kPiece), b = pose(x, y + kPiece);
            motion::Move move;
            move.start = a;
            move.end = b;
            move.quadratic = motion::Quadratic{2 * mid.tip_mm - 0.5 * (a.tip_mm + b.tip_mm),
                                               2 * mid.axis - 0.5 * (a.axis + b.axis)};
            moves.push_back(move);
            m.field->carve(milling::make_sweep(cutter, move));
        }
    }
    // The ball's centre at instants 0.02 mm apart: between them the sweep is 1e-5 mm wider at most.
    std::vector<Vec3> centres;
    std::vector<std::size_t> first_of_pass;
    for (const motion::Move& move : moves) {
        constexpr int kInstants = 250;
        for (int n = 0; n < kInstants; ++n) {
            const double t = (n + 0.5) / kInstants, s = 1 - t;
            const auto along = [&](Vec3 a, Vec3 c, Vec3 b) { return s * s * a + 2 * s * t * c + t * t * b; };
            centres.push_back(
                along(move.start.tip_mm, move.quadratic->tip_control_mm, move.end.tip_mm) +
                kRadius * normalized(along(move.start.axis, move.quadratic->axis_control, move.end.axis)));
        }
    }
    const double pieces = std::ceil((edge + 2 * kPiece) / kPiece);
    m.depth_mm = [box = m.box_mm, centres = std::move(centres), pitch, pieces](Vec3 p) {
        // Where the surface is, passes within a mm of the point make it, close to the point's y.
        const double per_pass = 250 * pieces, passes = static_cast<double>(centres.size()) / per_pass;
        const double near = std::round(p.x / pitch) + 2, aside = 1 + std::ceil(1 / pitch);
        double least = depth_in_box(box, p);
        for (double pass = std::max(0.0, near - aside); pass <= std::min(passes - 1, near + aside); ++pass) {
            const double middle = (p.y + kPiece) * 250 / kPiece;
            const double from = std::clamp(middle - 100, 0.0, per_pass - 1),
                         to = std::min(from + 200, per_pass);
            for (double n = from; n < to; ++n) {
                const Vec3 c = centres[static_cast<std::size_t>(pass * per_pass + n)];
                // Far above the centres the tool is: nothing of that matters within a mm of the surface.
                least = std::min(least, distance(p, c) - kRadius);
            }
        }
        return p.z > -0.05 ? std::min(least, 0.0) : least;
    };
    return m;
}

}  // namespace tribo::haptics::test

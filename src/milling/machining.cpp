// SPDX-License-Identifier: MIT
#include "milling/machining.hpp"

#include <algorithm>
#include <cmath>

#include "milling/sweep.hpp"
#include "motion/path.hpp"

namespace tribo::milling {
namespace {

// An overlap of shank, holder or fixture counts from this depth on: a shank as thick as its cutter slides
// along the wall that the cutter left.
constexpr double kClearance = 0.05;  // mm
// A rapid that takes less than this has only brushed a surface that was cut before.
constexpr double kBrush = 1e-4;  // mm3

motion::Move raised(motion::Move move, double height) {
    move.start.tip_mm += height * move.start.axis;
    move.end.tip_mm += height * move.end.axis;
    if (move.quadratic) move.quadratic->tip_control_mm += height * move.quadratic->axis_control;
    if (move.arc) move.arc->centre_mm += height * move.start.axis;
    return move;
}

}  // namespace

const char* name(CollisionKind kind) {
    switch (kind) {
        case CollisionKind::rapid_through_stock:
            return "rapid-through-stock";
        case CollisionKind::shank:
            return "shank-in-stock";
        case CollisionKind::holder:
            return "holder-in-stock";
        case CollisionKind::tool_in_fixture:
            return "tool-in-fixture";
        case CollisionKind::holder_in_fixture:
            return "holder-in-fixture";
    }
    return "";
}

Machining::Machining(field::CarvedField& stock, std::span<const Cutter> cutters,
                     std::vector<std::unique_ptr<field::CarvedField>> fixtures, MachiningOptions options)
    : stock_(stock), cutters_(cutters), fixtures_(std::move(fixtures)), options_(options) {
    for (const Cutter& cutter : cutters_) {
        probes_.emplace_back(cutter);
        std::vector<HolderStep> steps = cutter.holder;
        if (steps.empty()) steps.push_back({cutter.diameter_mm, 2 * cutter.length_mm});
        std::vector<Cylinder>& body = bodies_.emplace_back();
        double height = cutter.length_mm;
        for (const HolderStep& step : steps) {
            Cylinder& part = body.emplace_back();
            const bool shank = step.diameter_mm <= cutter.diameter_mm * (1 + 1e-9);
            part.in_stock = shank ? CollisionKind::shank : CollisionKind::holder;
            part.solid.kind = CutterKind::flat;
            part.solid.diameter_mm = step.diameter_mm;
            part.solid.length_mm = step.length_mm;
            part.height_mm = height;
            height += step.length_mm;
        }
    }
}

CutPose Machining::pose_between(const motion::Move& move, double from, double to) {
    const motion::ToolPose mid = motion::pose_at(move, 0.5 * (from + to));
    const Vec3 travel = motion::pose_at(move, to).tip_mm - motion::pose_at(move, from).tip_mm;
    CutPose pose{mid.tip_mm, tool_frame(mid.axis, travel, last_x_), 1, 0};
    last_x_ = pose.frame.x;
    const double l = length(travel);
    if (l > 0) {
        pose.down = std::clamp(-dot(travel, mid.axis) / l, -1.0, 1.0);
        pose.across = std::sqrt(std::max(0.0, 1 - pose.down * pose.down));
    }
    return pose;
}

void Machining::measure_rows(const motion::Move& move, std::size_t cutter, std::vector<CutRow>& rows,
                             std::size_t first, std::size_t count) {
    double travelled = 0;
    for (std::size_t n = 0; n < count; ++n) {
        CutRow& row = rows[first + n];
        row.from = static_cast<double>(n) / static_cast<double>(count);
        row.to = static_cast<double>(n + 1) / static_cast<double>(count);
        const double so_far = motion::path_length_mm(move, row.to);
        row.length_mm = so_far - travelled;
        travelled = so_far;
        row.pose = pose_between(move, row.from, row.to);
        probes_[cutter].measure(stock_, row.pose, row.engagement);
        row.chip_mm3 =
            row.length_mm * chip_area_mm2(cutters_[cutter], row.engagement, row.pose.across, row.pose.down);
    }
}

double Machining::first_contact(const motion::Move& move, std::size_t cutter) {
    const double length = motion::path_length_mm(move);
    const auto count = static_cast<std::size_t>(std::max(1.0, std::ceil(length / options_.rapid_row_mm)));
    Engagement engagement;
    for (std::size_t n = 0; n < count; ++n) {
        const double from = static_cast<double>(n) / static_cast<double>(count);
        const double to = static_cast<double>(n + 1) / static_cast<double>(count);
        probes_[cutter].measure(stock_, pose_between(move, from, to), engagement);
        if (!engagement.empty()) return from;
    }
    return 0;
}

void Machining::check_collisions(const motion::Move& move, std::size_t cutter, const field::Shape& sweep,
                                 std::vector<Collision>& collisions) {
    const auto report = [&](CollisionKind kind, Vec3 place) {
        // The fraction of the move at which the tip is nearest to the place: where to look in a picture.
        double best = 0, nearest = 1e300;
        for (int n = 0; n <= 16; ++n) {
            const double d = distance(motion::pose_at(move, n / 16.0).tip_mm, place);
            if (d < nearest) nearest = d, best = n / 16.0;
        }
        collisions.push_back({kind, best, motion::pose_at(move, best).tip_mm});
    };
    for (const auto& fixture : fixtures_) {
        if (const auto place = fixture->overlap(sweep, kClearance))
            report(CollisionKind::tool_in_fixture, *place);
    }
    for (const Cylinder& part : bodies_[cutter]) {
        const auto solid = make_sweep(part.solid, raised(move, part.height_mm));
        if (const auto place = stock_.overlap(*solid, kClearance)) report(part.in_stock, *place);
        for (const auto& fixture : fixtures_) {
            if (const auto place = fixture->overlap(*solid, kClearance))
                report(CollisionKind::holder_in_fixture, *place);
        }
    }
}

std::size_t Machining::run(const motion::Move& move, std::size_t cutter, std::vector<CutRow>& rows,
                           std::size_t first, std::vector<Collision>& collisions) {
    if (move.kind == motion::MoveKind::dwell) return 0;
    std::unique_ptr<field::Shape> sweep = make_sweep(cutters_[cutter], move);
    const field::Shape& shape = *sweep;
    if (move.kind == motion::MoveKind::rapid) {
        const Vec3 x = last_x_;
        const bool inside = stock_.blank().bounds_mm().overlaps(shape.bounds_mm());
        const double at = inside ? first_contact(move, cutter) : 0;
        const double removed = inside ? stock_.carve(std::move(sweep)) : 0;
        if (removed > kBrush) {
            collisions.push_back({CollisionKind::rapid_through_stock, at, motion::pose_at(move, at).tip_mm});
        }
        if (options_.collisions) check_collisions(move, cutter, shape, collisions);
        last_x_ = x;
        return 0;
    }
    const double length = motion::path_length_mm(move);
    const auto count = static_cast<std::size_t>(std::max(1.0, std::ceil(length / options_.row_mm - 1e-9)));
    if (rows.size() < first + count) rows.resize(first + count);
    measure_rows(move, cutter, rows, first, count);
    const double removed = stock_.carve(std::move(sweep));
    double chips = 0;
    for (std::size_t n = 0; n < count; ++n) chips += rows[first + n].chip_mm3;
    for (std::size_t n = 0; n < count; ++n) {
        CutRow& row = rows[first + n];
        row.removed_mm3 = chips > 0 ? removed * row.chip_mm3 / chips : removed / static_cast<double>(count);
    }
    if (options_.collisions) check_collisions(move, cutter, shape, collisions);
    return count;
}

}  // namespace tribo::milling

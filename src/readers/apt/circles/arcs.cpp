// SPDX-License-Identifier: MIT
#include "readers/apt/circles/arcs.hpp"

#include <utility>

#include "readers/apt/circles/catia_circle.hpp"

namespace tribo::readers::apt {

std::unexpected<Error> Arcs::refuse_without_start(const Statement& statement) const {
    return report_.refuse(statement.word, "a circle before any point", "add FROM or GOTO before it");
}

Result<void> Arcs::begin(const Statement& statement) {
    auto found = read_circle(statement, path_, report_);
    if (!found) return std::unexpected(found.error());
    if (!path_.place()) return refuse_without_start(statement);
    circle_ = *std::move(found);
    used_ = held_ = false;
    return {};
}

Result<void> Arcs::go(const motion::ToolPose& end, const Statement& statement) {
    const Vec3 start = path_.place()->tip_mm;
    if (held_) {
        // The start was repeated before points along the circle.
        if (end.tip_mm == start || !is_on(*circle_, end.tip_mm)) {
            if (auto ok = leave(); !ok) return ok;
            return path_.go(end, path_.take_kind(), statement.word);
        }
        held_ = false;
    } else if (!used_ && end.tip_mm == start && !circle_->turn_rad) {
        held_ = true;
        end_ = statement.word;
        return {};
    }
    if (used_ && (end.tip_mm == start || !is_on(*circle_, end.tip_mm))) {
        circle_.reset();
        return path_.go(end, path_.take_kind(), statement.word);
    }
    const auto arc = arc_to(*circle_, start, end.tip_mm, statement.word, report_);
    if (!arc) return std::unexpected(arc.error());
    used_ = true;
    circle_->turn_rad.reset();
    circle_->more_turns = 0;
    return path_.go(end, path_.take_kind(), statement.word, *arc);
}

Result<void> Arcs::leave() {
    if (std::exchange(held_, false)) {
        const motion::ToolPose end = *path_.place();
        const auto arc = arc_to(*circle_, end.tip_mm, end.tip_mm, end_, report_);
        if (!arc) return std::unexpected(arc.error());
        if (report_.first(Note::full_circle)) {
            report_.warn(end_.line, "a circle that ends where it starts is taken as a full turn");
        }
        circle_.reset();
        return path_.go(end, path_.take_kind(), end_, *arc);
    }
    if (used_) circle_.reset();
    used_ = false;
    return {};
}

void Arcs::finish() {
    if (circle_) report_.warn(circle_->at.line, "a circle without a point that ends it was left out");
}

Result<void> Arcs::set_slope(const Statement& statement) {
    if (statement.items.size() != 1) {
        return report_.refuse(statement.word, "ARCSLP with more than the rise of a helix",
                              "let the CAM system write CIRCLE or straight moves");
    }
    const auto rise = report_.number(statement.items[0], kLimits.coordinate, path_.settings.unit_mm);
    if (!rise) return std::unexpected(rise.error());
    if (report_.first(Note::arc_slope))
        report_.warn(statement.word.line, "ARCSLP: a helix rises as its points say");
    return {};
}

Result<void> Arcs::set_direction(const Statement& statement) {
    const bool to_point = matches(statement.word.text, "INDIRP");
    if (statement.items.size() != 3) {
        return report_.refuse(statement.word,
                              to_point ? "INDIRP without a point" : "INDIRV without a direction",
                              to_point ? "write INDIRP/x,y,z" : "write INDIRV/i,j,k");
    }
    const Frame& frame = path_.frames.to_program();
    if (!to_point) {
        const auto found = path_.read_direction(statement, 0);
        if (!found) return std::unexpected(found.error());
        forward_ = frame.turn(*found);
        return {};
    }
    if (!path_.place()) return refuse_without_start(statement);
    const auto point = path_.read_point(statement, 0);
    if (!point) return std::unexpected(point.error());
    forward_ = normalized(frame.point(*point) - path_.place()->tip_mm, Vec3{});
    return {};
}

Result<void> Arcs::set_surface(const Statement& statement) {
    const auto normal = read_plane_normal(statement, path_, report_);
    if (!normal) return std::unexpected(normal.error());
    surface_ = path_.frames.to_program().turn(*normal);
    return {};
}

Result<void> Arcs::go_forward(const Statement& statement) {
    if (!path_.place()) return refuse_without_start(statement);
    if (!forward_) {
        return report_.refuse(statement.word, "a circle of CATIA without INDIRV before it",
                              "add the direction in which it starts");
    }
    const auto found = read_catia_circle(statement, *std::exchange(forward_, std::nullopt),
                                         std::exchange(surface_, std::nullopt), path_, report_);
    if (!found) return std::unexpected(found.error());
    const auto arc = arc_to(found->circle, path_.place()->tip_mm, found->end_mm, statement.word, report_);
    if (!arc) return std::unexpected(arc.error());
    return path_.go({found->end_mm, path_.place()->axis}, path_.take_kind(), statement.word, *arc);
}

}  // namespace tribo::readers::apt

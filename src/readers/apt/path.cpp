// SPDX-License-Identifier: MIT
#include "readers/apt/path.hpp"

#include <algorithm>
#include <utility>

#include "base/text/limit_text.hpp"
#include "readers/text/decimal_text.hpp"

namespace tribo::readers::apt {
namespace {

constexpr std::size_t kMostCutters = 1000;  // each new one is compared with all others
constexpr double kShortestAxis = 1e-6;

}  // namespace

Result<Vec3> Path::read_point(const Statement& statement, std::size_t first) const {
    Vec3 point;
    for (int k = 0; k < 3; ++k) {
        const auto place = report_.number(statement.items[first + static_cast<std::size_t>(k)],
                                          kLimits.coordinate, settings.unit_mm);
        if (!place) return std::unexpected(place.error());
        point[k] = *place * settings.unit_mm;
    }
    return point;
}

Result<Vec3> Path::read_direction(const Statement& statement, std::size_t first) const {
    Vec3 direction;
    for (int k = 0; k < 3; ++k) {
        const auto component =
            report_.number(statement.items[first + static_cast<std::size_t>(k)], kLimits.direction);
        if (!component) return std::unexpected(component.error());
        direction[k] = *component;
    }
    if (length(direction) < kShortestAxis) {
        return report_.refuse(statement.items[first], "the direction has no length",
                              "give one; a tool axis points from the tip to the shank");
    }
    return normalized(direction);
}

motion::MoveKind Path::take_kind() {
    return std::exchange(next_is_rapid, false) ? motion::MoveKind::rapid : motion::MoveKind::feed;
}

Result<motion::ToolPose> Path::read_pose(const Statement& statement) {
    const std::size_t count = statement.items.size();
    if (count != 3 && count != 6 && count != 9) {
        return report_.refuse(statement.word,
                              quoted(statement.word.text) + " has " + std::to_string(count) + " numbers",
                              "write x,y,z or x,y,z,i,j,k");
    }
    if (!settings.unit_stated && report_.first(Note::unit)) {
        report_.warn(statement.word.line, "no UNITS before the first point: " +
                                              std::string(plural(options_.default_unit)) + " are taken");
    }
    const auto point = read_point(statement, 0);
    if (!point) return std::unexpected(point.error());
    if (count == 9) {
        const auto normal = read_direction(statement, 6);
        if (!normal) return std::unexpected(normal.error());
        if (report_.first(Note::surface_normal))
            report_.warn(statement.word.line, "the normals of the surface after the tool axes are not used");
    }
    if (count >= 6) {
        const auto direction = read_direction(statement, 3);
        if (!direction) return std::unexpected(direction.error());
        axis = *direction;
    }
    frames.settle(count >= 6, report_);
    const Frame& frame = frames.to_program();
    return motion::ToolPose{frame.point(*point), normalized(frame.turn(axis))};
}

void Path::set_place(const std::optional<motion::ToolPose>& pose) {
    place_ = pose;
    any_points_ = any_points_ || pose.has_value();
}

void Path::leave_to_home(const Statement& statement) {
    if (report_.first(Note::home)) {
        report_.warn(statement.word.line, std::string(statement.word.text) +
                                              " leads where only the machine knows: the path ends there and "
                                              "goes on at the next point");
    }
    set_place({});
}

motion::Move Path::new_move(motion::MoveKind kind, const Item& at) const {
    motion::Move move;
    move.kind = kind;
    move.start = move.end = *place_;
    move.spindle_rpm = settings.spindle_rpm;
    move.tool = settings.tool;
    move.line = at.line;
    return move;
}

Result<void> Path::append(motion::Move move) {
    if (program_.moves.size() >= options_.max_moves)
        return refuse_more_moves(options_.source_name, move.line, options_.max_moves);
    program_.moves.push_back(std::move(move));
    return {};
}

Result<double> Path::mm_per_min(const Feed& feed, const Item& at) const {
    if (!feed.per_turn) return feed.value;
    if (settings.spindle_rpm == 0) {
        return report_.refuse(at, "a feed per turn with the spindle speed unknown",
                              "add SPINDL with a speed before it");
    }
    const double value = feed.value * settings.spindle_rpm;
    if (!kLimits.feed.range.contains(value))
        return report_.refuse(at, out_of_range(kLimits.feed, value), range_remedy(kLimits.feed));
    return value;
}

Result<double> Path::feed_in_force(const Item& at) {
    if (settings.feed) return mm_per_min(*settings.feed, at);
    const double given = options_.default_feed_mm_per_min;
    if (!(given > 0)) {
        return report_.refuse(at, "a feed move before any FEDRAT",
                              "add FEDRAT before it, or RAPID where it does not cut");
    }
    if (report_.first(Note::feed)) {
        report_.warn(at.line, "no feed rate so far: " + short_decimal(given) +
                                  " mm/min is taken; write FEDRAT before it, or another feed_mm_per_min");
    }
    return given;
}

Result<void> Path::go(const motion::ToolPose& end, motion::MoveKind kind, const Item& at,
                      const std::optional<motion::Arc>& arc, const std::optional<Feed>& feed) {
    if (auto declared = declare_cutter(); !declared) return declared;
    if (!place_ || (*place_ == end && !arc)) {
        set_place(end);
        return {};
    }
    motion::Move move = new_move(kind, at);
    move.end = end;
    move.arc = arc;
    if (kind == motion::MoveKind::feed) {
        const auto speed = feed ? mm_per_min(*feed, at) : feed_in_force(at);
        if (!speed) return std::unexpected(speed.error());
        move.feed_mm_per_min = *speed;
        if (settings.spindle_stopped && report_.first(Note::spindle_off)) {
            report_.warn(move.line, "feed move with the spindle off: it is taken as running");
        }
        if (settings.spindle_stands && report_.first(Note::spindle_stands)) {
            report_.warn(move.line,
                         "feed move with a spindle speed of 0: the spindle stands still; it is taken as "
                         "turning at the job's speed");
        }
    }
    set_place(end);
    return append(std::move(move));
}

Result<void> Path::dwell(double seconds, const Item& at) {
    if (!place_ || seconds == 0) return {};
    motion::Move move = new_move(motion::MoveKind::dwell, at);
    move.duration_s = seconds;
    return append(std::move(move));
}

// Declares the cutter for the current tool, once.
Result<void> Path::declare_cutter() {
    if (!settings.cutter) return {};
    motion::DeclaredTool cutter = *std::exchange(settings.cutter, std::nullopt);
    cutter.number = settings.tool;
    const auto is_same = [&](const motion::DeclaredTool& tool) {
        return tool.number == cutter.number && tool.diameter_mm == cutter.diameter_mm &&
               tool.corner_mm == cutter.corner_mm;
    };
    if (std::ranges::any_of(program_.tools, is_same)) return {};
    if (program_.tools.size() == kMostCutters) {
        return fail_at(options_.source_name, cutter.line, 1,
                       "more than " + std::to_string(kMostCutters) + " different cutters",
                       "split the program");
    }
    program_.tools.push_back(cutter);
    return {};
}

motion::Program Path::finish() {
    if (program_.moves.empty()) report_.warn(0, "the program moves no tool");
    program_.warnings = std::move(report_.warnings);
    return std::move(program_);
}

}  // namespace tribo::readers::apt

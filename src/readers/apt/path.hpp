// SPDX-License-Identifier: MIT
// The moves of an APT program, and the current position of the tool.
#pragma once

#include <optional>

#include "readers/apt/frames.hpp"
#include "readers/apt/reader.hpp"
#include "readers/apt/report.hpp"
#include "readers/apt/settings.hpp"

namespace tribo::readers::apt {

class Path {
  public:
    Path(const AptOptions& options, Report& report) : options_(options), report_(report) {
        settings.unit_mm = mm_per(options.default_unit);
        program_.source = options.source_name;
    }

    Settings settings;
    Frames frames;
    Vec3 axis{0, 0, 1};          // axis of the next point without an axis, as written
    bool next_is_rapid = false;  // RAPID holds for one move
    motion::MoveKind take_kind();

    // Reads the point of the statement (3, 6 or 9 numbers), in the frame of the program. An axis in the items
    // becomes the axis in force; a point without an axis gets the axis in force. The last three of nine are
    // the normal of the surface, which moves nothing.
    Result<motion::ToolPose> read_pose(const Statement& statement);
    // Reads three numbers from `first` on, in mm, as written.
    Result<Vec3> read_point(const Statement& statement, std::size_t first) const;
    // Reads three numbers from `first` on as a unit direction, as written.
    Result<Vec3> read_direction(const Statement& statement, std::size_t first) const;

    const std::optional<motion::ToolPose>& place() const { return place_; }
    bool any_points() const { return any_points_; }
    // Sets the position of the tool without a move; absent: the position is unknown.
    void set_place(const std::optional<motion::ToolPose>& pose);
    // Sets the position unknown after a statement that leads where only the machine knows, and warns once.
    void leave_to_home(const Statement& statement);

    // Moves the tool from its position to `end`, along the arc if there is one. Adds no move if the position
    // is unknown or equal to `end`. `feed` replaces the feed in force.
    Result<void> go(const motion::ToolPose& end, motion::MoveKind kind, const Item& at,
                    const std::optional<motion::Arc>& arc = {}, const std::optional<Feed>& feed = {});
    Result<void> dwell(double seconds, const Item& at);
    Result<double> mm_per_min(const Feed& feed, const Item& at) const;

    motion::Program finish();

  private:
    motion::Move new_move(motion::MoveKind kind, const Item& at) const;
    Result<void> append(motion::Move move);
    Result<void> declare_cutter();
    Result<double> feed_in_force(const Item& at);

    const AptOptions& options_;
    Report& report_;
    motion::Program program_;
    std::optional<motion::ToolPose> place_;
    bool any_points_ = false;
};

}  // namespace tribo::readers::apt

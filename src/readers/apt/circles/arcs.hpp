// SPDX-License-Identifier: MIT
// The circle in force: from CIRCLE or MOVARC to the last GOTO along it, and the circles of CATIA, which are
// moves of their own.
#pragma once

#include <optional>

#include "readers/apt/circles/circle.hpp"
#include "readers/apt/path.hpp"

namespace tribo::readers::apt {

class Arcs {
  public:
    Arcs(Path& path, Report& report) : path_(path), report_(report) {}

    // CIRCLE, MOVARC
    Result<void> begin(const Statement& statement);
    // True when the next GOTO ends, or may continue, a circle.
    bool on() const { return circle_.has_value(); }
    Result<void> go(const motion::ToolPose& end, const Statement& statement);
    // Called at a statement other than GOTO: ends a finished circle; a circle whose end is its start becomes
    // a full turn.
    Result<void> leave();
    void finish();  // warns of a circle without an end
    // Forgets the circle in force and what leads into the next one.
    void drop() {
        circle_.reset();
        forward_.reset();
        surface_.reset();
        used_ = held_ = false;
    }

    // ARCSLP/h: the rise of the helix that follows, which its points give too.
    Result<void> set_slope(const Statement& statement);

    // What leads into a circle of CATIA: INDIRV/i,j,k or INDIRP/x,y,z, and PSIS/(PLANE/i,j,k,d).
    Result<void> set_direction(const Statement& statement);
    Result<void> set_surface(const Statement& statement);
    // TLON,GOFWD/...
    Result<void> go_forward(const Statement& statement);

  private:
    std::unexpected<Error> refuse_without_start(const Statement& statement) const;

    Path& path_;
    Report& report_;
    std::optional<Circle> circle_;  // ends at the next GOTO; later GOTOs may continue along it
    bool used_ = false;
    bool held_ = false;  // its end is its start: a full turn, unless points along it follow
    Item end_;
    std::optional<Vec3> forward_;  // of INDIRV, in the frame of the program
    std::optional<Vec3> surface_;  // normal of the plane of PSIS, likewise
};

}  // namespace tribo::readers::apt

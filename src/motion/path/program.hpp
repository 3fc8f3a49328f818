// SPDX-License-Identifier: MIT
// The output of every reader of a tool path and the input of all its users: a list of moves of the tool tip
// and axis.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/rare.hpp"
#include "base/result.hpp"
#include "base/vec3.hpp"

namespace tribo::motion {

// The tool tip (lowest point on the tool axis, mm, stock frame) and the unit axis from the tip to the shank.
// `turn_rad`: the turn of the head about this axis, right-handed, from the shortest rotation of +z to it
// (direction.hpp: turned_upright). A table that turns the part turns the head against the part.
struct ToolPose {
    Vec3 tip_mm;
    Vec3 axis{0, 0, 1};
    double turn_rad = 0;

    bool operator==(const ToolPose&) const = default;
};

enum class MoveKind { rapid, feed, dwell };

// A circular or helical tip path from the start: it turns by `turn_rad` about the line through `centre_mm`
// along `normal` (right-handed; more than a full turn is allowed) and rises linearly along `normal` to the
// end. The axis does not change.
struct Arc {
    Vec3 centre_mm;
    Vec3 normal{0, 0, 1};
    double turn_rad = 0;
};

// A curved piece: tip and axis are quadratic Bezier curves with these middle control points; the axis is
// normalised afterwards. Spline motions are cut into such pieces within a stated tolerance.
struct Quadratic {
    Vec3 tip_control_mm;
    Vec3 axis_control;
};

// One move. The tip goes straight from start to end, or along `arc` or `quadratic` (at most one of them). The
// axis turns along the great circle, or along `quadratic`.
struct Move {
    MoveKind kind = MoveKind::feed;
    ToolPose start, end;
    Rare<Arc> arc;
    Rare<Quadratic> quadratic;
    double feed_mm_per_min = 0;  // of the tip; for a feed move > 0
    double duration_s = 0;       // > 0 if the program gives the time itself (inverse time, dwell), else 0
    double spindle_rpm = 0;      // 0: not given by the program
    int tool = 0;                // tool number; 0: not given by the program
    int line = 0;                // of the source, from 1

    // A rapid that goes nowhere: the tool stands here, and nothing is known of how it came.
    bool is_place() const {
        return kind == MoveKind::rapid && !arc && !quadratic && start.tip_mm == end.tip_mm &&
               start.axis == end.axis;
    }
};

// One cylindrical step of a holder.
struct DeclaredStep {
    double diameter_mm = 0, length_mm = 0;
};

// A tool that a program declares itself (CUTTER/, a tool comment) or that a tool table contains. Numbers are
// 0 where they are not given.
struct DeclaredTool {
    int number = 0;
    double diameter_mm = 0;
    double corner_mm = 0;
    int line = 0;
    int flutes = 0;                     // 0: not given
    std::optional<double> length_mm{};  // from the spindle nose to the tip
    std::string table{};                // name of the table; empty: the program's own
    // The shape, if it is not flat, ball or bull by diameter and corner: a `kind` of docs/job.md and its
    // keys.
    std::string kind{};
    double tip_mm = 0, point_deg = 0, taper_deg = 0, side_mm = 0, height_mm = 0, neck_mm = 0;
    double edge_mm = 0;                    // length of the cutting edges, `length_mm` of a job's cutter
    double stickout_mm = 0, shank_mm = 0;  // from the tip to the holder's face; diameter of the shank
    std::vector<DeclaredStep> holder{};    // from its face up; empty: not given
};

// The stock that a program declares itself (BLK FORM).
struct DeclaredStock {
    Box3 box_mm;
    int line = 0;
};

struct Program {
    std::string source;   // name of its file
    std::string dialect;  // of the control that it was read for; empty: none
    std::vector<Move> moves;
    std::vector<DeclaredTool> tools;
    std::optional<DeclaredStock> stock;
    bool has_rotary_words = false;  // axis words A B C: they need a machine
    std::string machine;            // machine used to read its rotary words; empty: none
    int first_rotary_line = 0;
    Warnings warnings;
};

// Return the pose at the fraction t in 0..1 of a move, and the true length of its tip path, mm.
ToolPose pose_at(const Move& move, double t);
double path_length_mm(const Move& move);
// Returns the true box of the tip path, arcs included.
Box3 tip_bounds(const Move& move);

}  // namespace tribo::motion

// SPDX-License-Identifier: MIT
// The position of the tool of a program with frames, and its moves in the stock: Heidenhain and Siemens.
#pragma once

#include <array>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "base/limits.hpp"
#include "motion/curve/bspline_motion.hpp"
#include "motion/machine/work_frame.hpp"
#include "motion/path/program.hpp"
#include "readers/control/machine_run.hpp"
#include "readers/control/rotary_feed.hpp"
#include "readers/gcode/reader.hpp"
#include "readers/tools/tool_notes.hpp"

namespace tribo::readers::control {

enum class Known { unstated, yes, lost };

// Place of a block, for messages.
struct Place {
    int line = 0, column = 0;
};

// A plane that is rolled about a rotary axis of the machine: x or y runs along the axis, the other one around
// it at the radius, and z is the distance from it.
struct Roll {
    int along = 0, around = 1;  // 0 x, 1 y
    int rotary = 0;             // 0 A, 1 B, 2 C
    double radius_mm = 0;
    double way = 1;       // of the rotary word for a growing coordinate around it
    double aside_mm = 0;  // where the machine's axis of that coordinate stays
};

// Radius of a tool that nothing states, mm: half of the end mill that job/completion.cpp assumes.
inline constexpr double kAssumedRadiusMm = 3;
// Radius of the narrowest place of what has none, such as a stud.
inline constexpr double kOpenMm = std::numeric_limits<double>::infinity();

class Path {
  public:
    // Moves go to the sink, or into the program if `sink` is null.
    Path(const GcodeOptions& options, MoveSink* sink);

    const GcodeOptions& options;
    motion::Program program;
    std::size_t moves = 0;
    std::optional<MachineRun> machine;
    ToolNotes notes;  // tools in comments, messages and names

    // Data that each move gets.
    double spindle_rpm = 0;
    bool spindle_stands = false;  // the last S is 0
    int tool = 0;
    std::optional<double> feed_mm_per_min;  // modal F
    bool spindle_on = false;

    // Frame of the coordinates of the block: datum, rotation and tilted plane.
    motion::WorkFrame frame;
    bool tip_control = false;
    // What the feed counts of rotary axes without tool tip control; `feed_on_part`: the feed is that of the
    // tip on the part (M116).
    RotaryFeed rotary_feed;
    bool feed_on_part = false;

    // The tip in the coordinates of the frame; valid only if it is known.
    Vec3 tip() const { return frame.from_stock(place_mm_ - parallel_mm_); }
    bool knows_tip() const;
    Known known(int axis) const { return known_[static_cast<std::size_t>(axis)]; }
    int lost_line() const { return lost_line_; }
    Vec3 rotary_rad() const { return now_rad_; }

    // Sets the coordinates of axes without a move; `known` per axis.
    void put(Vec3 tip_in_frame, std::array<Known, 3> known, int line);
    void lose(int line);

    // The axes U V W of the machine beside X Y Z: the tip stands at the sum, which the next move reaches.
    double parallel_mm(int axis) const { return parallel_mm_[axis]; }
    // Refuses it where the coordinates are not those of the machine's linear axes. Warns at the first move of
    // each axis.
    Result<void> place_parallel(int axis, double mm, Place place);

    // Adds a move to the point on a line or arc, in coordinates of the frame, while the rotary axes turn to
    // `to_rad`. The tip must be known.
    Result<void> move(motion::MoveKind kind, Vec3 to, const std::optional<motion::Arc>& arc, Vec3 to_rad,
                      Place place);
    // Adds the moves of a curve in coordinates of the frame, which begins where the tip is. The tool does not
    // turn. Pieces keep within motion::PieceTolerance.
    Result<void> follow(const motion::BSpline<motion::HomogeneousPoint>& curve, Place place);
    Result<void> dwell(double seconds, Place place);
    // Sets the rotary axes while the tip is not known.
    void set_rotary(Vec3 to_rad) { now_rad_ = to_rad; }
    // Sets the tool axis in the stock at the end of the next move (LN with TX TY TZ). On a machine the rotary
    // axes determine it.
    void aim(Vec3 axis) { aim_ = axis; }
    Vec3 axis() const { return aim_; }
    // The tool axis where the tool stands, in the stock.
    Vec3 axis_in_stock() const { return pose_in_stock().axis; }

    // Adds a tool of TOOL DEF to the program; once for a line, which a loop may run again.
    void declare(const motion::DeclaredTool& tool);
    // Keeps the radius that TOOL DEF gives a tool; also 0.
    void define_radius(int number, double radius_mm) { declared_radii_mm_[number] = radius_mm; }
    // Radius of the tool in the spindle by the options, else by TOOL DEF, else by a comment for compensation
    // (ToolNotes::diameter_mm); none if nothing states it.
    std::optional<double> tool_radius_mm(double unit_of_program_mm) const;
    // Its radius for cycles that clear an area, which have no path without one: as above, else by a comment,
    // else kAssumedRadiusMm, or half of the room where that is narrower, with a warning for each tool.
    double clearing_radius_mm(double unit_of_program_mm, int line, double room_mm = kOpenMm);
    // Number of its teeth by the options, else by TOOL DEF; 0: not known.
    int flutes() const;
    // The tool `number` comes into the spindle. Its length is taken from the options, else from TOOL DEF of
    // the program.
    void change_tool(int number);
    // Adds the tools of comments behind those of TOOL DEF.
    void finish_tools(double unit_of_program_mm);

    // Switches the coordinates to those of the tip in the stock, or back to those of the machine. The tool
    // does not move.
    void switch_tip_control(bool on, int line);
    // Makes the tool normal to a plane and uses the coordinates of the plane. The tip stays if `keep_tip` is
    // true. Else it goes where the rotary axes of the machine lead it; without a machine its position is
    // lost. Returns false if no angle of the machine reaches the plane. `to_rad`: its angles, if they are
    // given.
    bool tilt(const motion::WorkFrame& plane, bool keep_tip, int line,
              const std::optional<Vec3>& to_rad = {});

    // Rolls x and y about the innermost rotary axis of the machine's table. The tool does not move. Without a
    // machine the plane stays flat. Returns false if that axis does not run along x or y.
    bool roll(double radius_mm, int line);
    void unroll();
    const std::optional<Roll>& rolled() const { return roll_; }

    bool first(int note);
    void warn(int line, std::string text);
    std::unexpected<Error> refuse(Place place, std::string cause, std::string remedy) const;
    // Refuses a value out of its range. `value` is in the unit of the limit.
    Result<void> in_range(const Limit& limit, double value, Place place) const;
    // Records the line of the first rotary words. Without a machine also warns.
    void note_machine_needed(int line, const std::string& what);

  private:
    Result<void> append(const motion::Move& move);
    // The tool where it stands; the tip must be known.
    motion::ToolPose pose_in_stock() const;
    // True when coordinates are those of the tip in the stock. Without a machine this is always so.
    bool in_stock() const { return !machine || tip_control || frame.is_tilted(); }
    Result<void> run_block(const motion::MachineBlock& block, const motion::Move& like, Place place);
    Result<void> move_rolled(motion::Move move, Vec3 to_rad, Place place);
    // The linear and rotary values of the machine at a place of the plane that is rolled.
    Vec3 linear_at(Vec3 place_mm) const;
    Vec3 rotary_at(Vec3 place_mm, Vec3 rotary_rad) const;

    MoveSink* sink_;
    std::map<int, double> given_lengths_mm_, declared_lengths_mm_;  // by number of the tool
    std::map<int, double> declared_radii_mm_;
    std::set<int> declaring_lines_;
    std::set<int> assumed_radii_;  // tools whose radius nothing states
    Vec3 place_mm_;  // tip in the frame of the stock; on a machine without tip control its X Y Z
    Vec3 parallel_mm_;
    std::array<bool, 3> has_parallel_{};
    std::array<Known, 3> known_{Known::unstated, Known::unstated, Known::unstated};
    int lost_line_ = 0;
    std::optional<Roll> roll_;
    Vec3 now_rad_;
    Vec3 axis_{0, 0, 1}, aim_{0, 0, 1};
    std::array<bool, 64> noted_{};
};

}  // namespace tribo::readers::control

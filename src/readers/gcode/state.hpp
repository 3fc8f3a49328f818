// SPDX-License-Identifier: MIT
// What a control remembers from one block to the next.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "base/vec3.hpp"
#include "motion/curve/bezier_motion.hpp"
#include "readers/control/machine_run.hpp"
#include "readers/gcode/motion/contour.hpp"
#include "readers/gcode/reader.hpp"

namespace tribo::readers::gcode {

enum class Plane { xy, zx, yz };  // G17 G18 G19
enum class FeedMode { per_minute, inverse_time, per_turn };
enum class MotionMode {
    none,
    rapid,
    line,
    arc_clockwise,
    arc_counter_clockwise,
    cubic_spline,      // G5
    quadratic_spline,  // G5.1
    nurbs,             // G5.2: control points with weights
    nurbs_with_knots,  // G6.2
    cycle,             // G73 to G89
};
enum class Spindle { off, clockwise, counter_clockwise };

// What is known of a coordinate: nothing has stated it yet; it is known; or the machine took the axis to a
// place that only it knows (G28, G53).
enum class Known { unstated, yes, lost };

// Turned about z; the very same where the angle is 0.
Vec3 turned(Vec3 v, double degrees);
motion::Move turned(const motion::Move& move, double degrees);

inline constexpr int kWorkSystems = 9;  // G54 to G59, G59.1 to G59.3

struct WorkSystem {
    Vec3 origin_mm;       // in the stock's frame
    double turn_deg = 0;  // about the stock's z
    bool set = false;
};

// A canned cycle in force, with the words that stay until they are written again.
struct Cycle {
    int tenths = 0;                              // 810 for G81; 0: none
    int line = 0;                                // where its code stood
    std::optional<double> depth_mm, retract_mm;  // Z and R as written: absolute, or increments in G91
    std::optional<double> peck_mm, dwell_s;
    std::optional<double> initial_mm;  // where the cycle axis stood at its start, to which G98 returns
};

// A B-spline whose blocks are being read (G5.2, G6.2).
struct Nurbs {
    bool runs = false;
    bool has_knots = false;    // G6.2
    int line = 0, column = 0;  // where it began
    std::size_t order = 3;
    std::vector<motion::HomogeneousPoint> control;  // weight times point, in the frame of the tip
    std::vector<double> knots;
    Vec3 last_mm;       // the last control point
    motion::Move like;  // with the feed and the words of its moves
};

// Cutter radius compensation (gcode_compensation.hpp); in the plane's coordinates.
struct Compensation {
    bool is_on = false;
    bool has_begun = false;  // a move in the plane has led to the offset contour
    int code = 400;          // in tenths
    int line = 0;            // of that code
    Plane plane = Plane::xy;
    double left_mm = 0;                 // the cutter's radius; below 0 to the right
    Point at;                           // where the tool was at its start
    Point direction;                    // of the contour at the end of its last move
    double curvature_per_mm = 0;        // likewise
    Element last;                       // the last move, offset; its end may still be cut off
    std::vector<motion::Move> waiting;  // that move, and those along the tool that followed it
};

// Rotary axes and tool tip control (gcode_rotary.hpp).
struct RotaryState {
    Vec3 now_rad;                 // A B C of the machine, offsets applied
    Vec3 target_rad;              // where the block leads them
    bool stated = false;          // the block has rotary words
    bool tip_control = false;     // coordinates are the tip's in the stock, not the machine's
    bool by_length_code = false;  // switched on by a G43.4 of some kind, so that G49 ends it
    bool vectors = false;         // I J K of a line are the tool's axis (G43.5)
    std::array<Vec3, kWorkSystems> origin_rad{};

    // The tool's axis where its vectors are read without a machine.
    Vec3 now_axis{0, 0, 1}, target_axis{0, 0, 1};

    bool turns() const { return now_rad != target_rad || now_axis != target_axis; }
    // The block is done: what it asked for is where the axes are.
    void arrive() {
        now_rad = target_rad;
        now_axis = target_axis;
    }
};

struct State {
    int line = 0;  // of the block that runs
    double unit_mm = 1;
    bool unit_stated = false;
    Plane plane = Plane::xy;
    bool incremental = false;
    bool absolute_centres = false;  // G90.1
    MotionMode motion = MotionMode::none;
    Cycle cycle;
    Nurbs nurbs;
    Compensation compensation;
    // Where compensation has left the tool; the next move starts there and not at tip_mm.
    std::optional<Vec3> left_at_mm;
    std::optional<Vec3> spline_end_mm;  // from the end of the last G5 to its second control point
    bool retract_to_r = true;           // G99
    bool return_level_stated = false;

    FeedMode feed_mode = FeedMode::per_minute;
    std::optional<double> feed;  // mm/min, 1/min or mm per turn
    int feed_line = 0;           // where F stood last

    Spindle spindle = Spindle::off;
    double spindle_rpm = 0;
    int selected_tool = 0;
    int loaded_tool = 0;
    bool has_changed_tool = false;

    std::array<WorkSystem, kWorkSystems> work;
    int active_work = 0;
    Vec3 preset_mm;  // G92's and G52's
    bool preset_on = true;

    // In the frame of the program's axes: the stock's, turned about z by the work system's turn (mostly 0).
    // 0 where not known. On a machine without tool tip control: X Y Z of the machine, counted from the
    // stock's zero.
    Vec3 tip_mm;
    std::array<Known, 3> known{Known::unstated, Known::unstated, Known::unstated};
    int lost_line = 0;  // of the last block that lost an axis
    RotaryState rotary;

    const WorkSystem& active() const { return work[static_cast<std::size_t>(active_work)]; }
    // Where the program's zero stands, in the frame of its axes.
    Vec3 origin_mm() const {
        const Vec3 origin = turned(active().origin_mm, -active().turn_deg);
        return preset_on ? origin + preset_mm : origin;
    }
    // Counts the tip in the axes of the work system in force; they were turned by so much before.
    void reframe(double before_deg) {
        const double after_deg = active().turn_deg;
        if (before_deg != after_deg) tip_mm = turned(turned(tip_mm, before_deg), -after_deg);
    }
    bool knows_tip() const {
        return known[0] == Known::yes && known[1] == Known::yes && known[2] == Known::yes;
    }
    // G40, G41, ... in tenths.
    double compensation_code() const { return compensation.code; }
    // The tool that cuts: before the first M6 the one that T names, as nothing else can be in the spindle.
    int tool() const { return has_changed_tool ? loaded_tool : selected_tool; }
};

// An assumption that is worth one warning per program, however often it is made.
enum class Note {
    no_unit,
    unstated_axes,
    rotary_words,
    tool_tip_switch,
    spindle_off,
    spindle_backwards,
    work_system,
    tool_length,
    machine_position,
    tool_without_change,
    unassigned_parameter,
    return_level,
    bore_shift,
    bore_by_hand,
    default_feed,
    preset_as_origin,
    deletable_blocks,
    rotary_home,
    count
};

// Where blocks put what they give: moves, warnings and errors.
class Output {
  public:
    // Moves go to the sink, or into the program where there is none.
    Output(const GcodeOptions& options, MoveSink* sink) : options(options), sink_(sink) {
        program.source = options.source_name;
        program.dialect = name_of(options.dialect);
        if (options.machine != nullptr) {
            machine.emplace(*options.machine);
            program.machine = options.machine->name;
        }
    }

    const GcodeOptions& options;
    motion::Program program;
    std::size_t moves = 0;              // so far
    std::optional<MachineRun> machine;  // that the program runs on; none: a machine of three axes

    // A move in the stock's frame.
    Result<void> append(const motion::Move& move);
    // Where the options and the program name it.
    std::optional<double> tool_diameter_mm(int number) const;
    std::optional<double> tool_length_mm(int number) const;
    void declare_tool(const GcodeTool& tool) { declared_.push_back(tool); }

    // True the first time it is asked of a note.
    bool first(Note note);
    void warn(int line, std::string text);
    std::unexpected<Error> refuse(int line, int column, std::string cause, std::string remedy) const;

  private:
    MoveSink* sink_;
    std::vector<GcodeTool> declared_;
    std::array<bool, static_cast<std::size_t>(Note::count)> noted_{};
};

}  // namespace tribo::readers::gcode

// SPDX-License-Identifier: MIT
// The state that a control keeps from one block to the next.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/result.hpp"
#include "base/vec3.hpp"
#include "motion/curve/bezier_motion.hpp"
#include "motion/machine/work_frame.hpp"
#include "readers/control/area_milling.hpp"
#include "readers/control/machine_run.hpp"
#include "readers/gcode/frames/program_frame.hpp"
#include "readers/gcode/motion/contour.hpp"
#include "readers/gcode/reader.hpp"
#include "readers/tools/tool_notes.hpp"

namespace tribo::readers::gcode {

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

// Knowledge of a coordinate: not stated so far; known; or lost, because the machine moved the axis to a
// position that the program does not give (G28, G53).
enum class Known { unstated, yes, lost };

// Turns about z. An angle of 0 returns the same bits.
Vec3 turned(Vec3 v, double degrees);
motion::Move turned(const motion::Move& move, double degrees);

inline constexpr int kWorkSystems = 9;  // G54 to G59, G59.1 to G59.3
// G54.1 P1 to P300 behind them; G154 P1 to P99 and G110 to G129 are the first of these (Haas).
inline constexpr int kMoreWorkSystems = 300;
inline constexpr int kAllWorkSystems = kWorkSystems + kMoreWorkSystems;

struct WorkSystem {
    Vec3 origin_mm;       // as stated; State::stock_at_mm says from where
    double turn_deg = 0;  // about the z axis of the stock
    bool set = false;
};

// The canned cycle in force, with the words that stay until they are written again.
struct Cycle {
    int tenths = 0;                                                 // 810 for G81; 0: none
    int line = 0;                                                   // line of its code
    std::optional<double> depth_mm, retract_mm;                     // Z and R as written
    bool depth_is_increment = false, retract_is_increment = false;  // they were written in G91
    std::optional<double> peck_mm, dwell_s;
    // I J K of Haas controls: the first peck, what each later one is shorter by, and the shortest.
    std::optional<double> first_peck_mm, peck_step_mm, least_peck_mm;
    std::optional<double> initial_mm;  // position on the cycle axis at its start; G98 returns to it
};

// A B-spline whose blocks are being read (G5.2, G6.2).
struct Nurbs {
    bool runs = false;
    bool has_knots = false;    // G6.2
    int line = 0, column = 0;  // of its start
    std::size_t order = 3;
    std::vector<motion::HomogeneousPoint> control;  // weight * point, in the frame of the tip
    std::vector<double> knots;
    Vec3 last_mm;       // the last control point
    motion::Move like;  // template of its moves: feed and words
};

// Cutter radius compensation (motion/compensation.hpp); in the coordinates of the plane.
struct Compensation {
    bool is_on = false;
    bool has_begun = false;  // a move in the plane has reached the offset contour
    bool is_entry = false;   // the last move is a straight entry
    int code = 400;          // in tenths
    int line = 0;            // of that code
    double number = 0;       // its D, else the tool
    Plane plane = Plane::xy;
    double left_mm = 0;                 // radius of the cutter; negative: to the right of the contour
    Point at;                           // position of the tool at its start
    Point direction;                    // of the contour, at the end of the last move
    double curvature_per_mm = 0;        // the same
    Element last;                       // the last move, offset; its end may still be shortened
    std::vector<motion::Move> waiting;  // the last move, and the moves along the tool axis after it

    // A comment states the radius, and D may hold the wear alone. Then both paths are kept, as programmed and
    // as compensated, until it is known which one is meant.
    bool is_of_text = false;
    std::vector<motion::Move> programmed, compensated;
};

// Rotary axes and tool tip control (motion/rotary.hpp).
struct RotaryState {
    Vec3 now_rad;                 // A B C of the machine, with offsets
    Vec3 target_rad;              // at the end of the block
    bool stated = false;          // the block has rotary words
    bool tip_control = false;     // coordinates are those of the tip in the stock, not those of the machine
    bool by_length_code = false;  // switched on by G43.4 or its like; G49 ends it
    bool vectors = false;         // I J K of a line are the tool axis (G43.5)
    bool vectors_to_tip = false;  // from the shank
    std::array<Vec3, kAllWorkSystems> origin_rad{};

    // Tool axis when vectors are read without a machine.
    Vec3 now_axis{0, 0, 1}, target_axis{0, 0, 1};

    bool turns() const { return now_rad != target_rad || now_axis != target_axis; }
    // At the end of the block: the axes have reached their targets.
    void arrive() {
        now_rad = target_rad;
        now_axis = target_axis;
    }
};

// Axes U V W beside X Y Z (motion/parallel_axes.hpp).
struct ParallelAxes {
    Vec3 at_mm;    // how far they have moved the tip
    Vec3 zero_mm;  // at_mm where their words are 0 (G92)
};

// A corner that a block asks for at its end, and the move that waits for the next one (motion/corners.hpp).
struct CornerSize {
    double mm = 0;  // radius, or what a chamfer takes from each line
    bool is_chamfer = false;
};
struct WaitingCorner {
    motion::Move move;
    CornerSize size;
    Plane plane = Plane::xy;
};

// Cylindrical interpolation (frames/cylinder.hpp).
struct Cylinder {
    int rotary = 0;  // the axis A B C that turns
    int linear = 0;  // the axis X Y Z about which it turns
    double radius_mm = 0;
};

// Blocks of G68.2 P2 or P3 that describe a plane together: points, and directions, by their Q.
struct PlaneBlocks {
    int kind = 0;  // 2: three points; 3: two vectors
    std::array<std::optional<Vec3>, 4> points, directions;
};

// A plane turned in space whose coordinates the program writes (frames/tilted_plane.hpp).
struct TiltedPlane {
    motion::WorkFrame frame;  // in the stock
    Vec3 preset_before_mm;    // of G92 and G52, until the plane ends
    bool about_axis = false;  // of G68
};

// The modes that M70 saves and M72 restores (LinuxCNC).
struct SavedModes {
    double unit_mm = 1;
    Plane plane = Plane::xy;
    bool incremental = false, absolute_centres = false, retract_to_r = true;
    FeedMode feed_mode = FeedMode::per_minute;
    std::optional<double> feed;
    Spindle spindle = Spindle::off;
    double spindle_rpm = 0;
    int active_work = 0;
};

// G150: what its block says, and the contour so far, which begins at `start_mm`.
struct OpenPocket {
    int line = 0, column = 0;
    std::size_t depth = 0;  // of calls before it
    Vec3 start_mm;
    motion::Move like;  // feed, tool and line of its moves
    control::AreaMilling milling;
    control::Ring contour;
};

// As written, in the unit of the program.
struct Billet {
    Vec3 size, corner;
    int line = 0;  // 0: none
};

struct State {
    int line = 0;  // of the running block
    double unit_mm = 1;
    bool unit_stated = false;
    bool unit_is_of_texts = false;  // inches, as the texts about tools say
    Plane plane = Plane::xy;
    bool incremental = false;
    bool absolute_centres = false;  // G90.1
    bool centres_stated = false;    // by G90.1, G91.1, or by an arc that fits only one of them
    int ambiguous_arc_line = 0;     // of the first arc that fits both ways; 0: none so far
    bool single_quadrant = false;   // G74 beside a motion: arc centres may lack their signs
    MotionMode motion = MotionMode::none;
    MotionMode plain_motion = MotionMode::none;  // the last of G0 to G3; it goes on after G80
    ProgramFrame frame;
    Cycle cycle;
    double clearing_depth_mm = 0;  // of kClearingDepth (text/fanuc_variables.hpp)
    Nurbs nurbs;
    Compensation compensation;
    // Position of the tool at the end of compensation; the next move starts here and not at tip_mm.
    std::optional<Vec3> left_at_mm;
    std::optional<Vec3> heading;        // direction of the last move at its end, without compensation
    std::optional<Vec3> spline_end_mm;  // from the end of the last G5 to its second control point
    bool retract_to_r = true;           // G99
    bool return_level_stated = false;

    FeedMode feed_mode = FeedMode::per_minute;
    std::optional<double> feed;  // mm/min, 1/min or mm per turn
    int feed_line = 0;           // line of the last F

    Spindle spindle = Spindle::off;
    double spindle_rpm = 0;
    bool spindle_stands = false;  // the last S is 0
    int selected_tool = 0;
    int loaded_tool = 0;
    bool has_changed_tool = false;
    std::optional<double> offset_number;  // the last D that stood without G41 or G42
    bool has_y = false;                   // the program has a Y word
    double largest_mm = 0;                // of its coordinates

    std::array<WorkSystem, kAllWorkSystems> work;
    int active_work = 0;
    // The stock's origin, from where the origins of the work systems are stated. It is fixed by the first
    // move to coordinates: on Fanuc controls work systems are stated from the zero of the machine, and the
    // stock is taken to stand at the one in which the program begins.
    std::optional<Vec3> stock_at_mm;
    Billet billet;   // of Denford's mills
    Vec3 preset_mm;  // of G92 and G52
    bool preset_on = true;
    std::optional<TiltedPlane> tilt;
    PlaneBlocks plane_blocks;  // so far
    bool enters_data = false;  // between G10 L50 or L52 and G11: blocks are values of the control
    std::optional<SavedModes> saved;
    std::optional<WaitingCorner> corner;
    std::optional<OpenPocket> pocket;  // its contour is being read
    std::optional<Cylinder> cylinder;

    // In a tilted plane: in its frame. Else in the frame of the axes of the program: the frame of the stock,
    // turned about z by the work system (mostly by 0). 0 where not known. On a machine without tool tip
    // control: X Y Z of the machine, relative to the zero of the stock.
    Vec3 tip_mm;
    std::array<Known, 3> known{Known::unstated, Known::unstated, Known::unstated};
    int lost_line = 0;  // of the last block that lost an axis
    RotaryState rotary;
    ParallelAxes parallel;

    const WorkSystem& active() const { return work[static_cast<std::size_t>(active_work)]; }
    // Zero of a work system, in the frame of the stock.
    Vec3 zero_mm(const WorkSystem& system) const {
        return system.set && stock_at_mm ? system.origin_mm - *stock_at_mm : system.origin_mm;
    }
    // Zero of the program, in the frame of its axes.
    Vec3 origin_mm() const {
        const Vec3 origin = tilt ? Vec3{} : turned(zero_mm(active()) + parallel.at_mm, -active().turn_deg);
        return preset_on ? origin + preset_mm : origin;
    }
    // Converts the tip to the axes of the work system in force; the axes before were turned by `before_deg`.
    void reframe(double before_deg) {
        const double after_deg = active().turn_deg;
        if (before_deg != after_deg && !tilt) tip_mm = turned(turned(tip_mm, before_deg), -after_deg);
    }
    bool knows_tip() const {
        return known[0] == Known::yes && known[1] == Known::yes && known[2] == Known::yes;
    }
    // Only the machine knows where the tip is.
    bool has_lost_tip() const {
        return known[0] == Known::lost || known[1] == Known::lost || known[2] == Known::lost;
    }
    // G40, G41, ... in tenths.
    double compensation_code() const { return compensation.code; }
    // The cutting tool. Before the first M6 it is the tool of the T word: no other tool can be in the
    // spindle.
    int tool() const { return has_changed_tool ? loaded_tool : selected_tool; }
};

// Assumptions with one warning per program (some: per letter or code), however often they are made.
enum class Note {
    no_unit,
    unstated_axes,
    rotary_words,
    tool_tip_switch,
    spindle_off,
    spindle_stands,
    spindle_backwards,
    work_system,
    tool_length,
    machine_position,
    tool_without_change,
    unused_word,
    unknown_m,
    idle_code,
    nested_comment,
    open_comment,
    deleted_rest,
    setting,
    print,
    motion_after_cycle,
    motion_assumed,
    tool_offset,
    tool_register,
    spindle_number,
    wrong_spindle,
    compensation_unknown,
    compensation_of_text,
    no_depth,
    compensation_of_wear,
    compensation_in_space,
    centres,
    pitch,
    probing,
    whole_peck,
    no_retract,
    lost_preset,
    tap_return,
    entered_data,
    empty_code,
    scale,
    coarse_arc,
    unassigned_parameter,
    return_level,
    bore_shift,
    bore_by_hand,
    default_feed,
    preset_as_origin,
    stock_place,
    moved_origin,
    deletable_blocks,
    rotary_home,
    rotary_feed,
    roll_pitch_yaw,
    projection_angles,
    round_pocket,
    general_pocket,
    pocket_radius,
    pocket_within_tool,
    drawing_data,
    second_tool,
    program_of_machine,
    plane_centre,
    parallel_axis,
    overruled_code,
    tool_timer,
    dwell_increments,
};

// Receives the moves, warnings and errors of the blocks.
class Output {
  public:
    // Moves go to the sink, or into the program if `sink` is null.
    Output(const GcodeOptions& options, MoveSink* sink) : options(options), sink_(sink) {
        program.source = options.source_name;
        program.dialect = name_of(options.dialect);
        for (const GcodeTool& tool : options.tools) {
            GcodeTool& known = given_[tool.number];
            known = {tool.number, tool.diameter_mm, tool.length_mm ? tool.length_mm : known.length_mm};
        }
        if (options.machine != nullptr) {
            machine.emplace(*options.machine);
            program.machine = options.machine->name;
        }
    }

    const GcodeOptions& options;
    motion::Program program;
    std::size_t moves = 0;              // so far
    bool feeds = false;                 // one of them is at feed
    std::string_view text;              // of the program
    std::optional<MachineRun> machine;  // absent: a machine of three axes
    ToolNotes notes;                    // tools in comments
    std::set<int> wear_tools;  // whose D holds the wear alone, though a comment states their diameter

    // Adds a move in the frame of the stock.
    Result<void> append(const motion::Move& move);
    // From the options or the program; absent: neither gives it.
    std::optional<double> tool_diameter_mm(int number, double unit_of_program_mm) const;
    // True if only a comment states it.
    bool is_diameter_of_text(int number, double unit_of_program_mm) const;
    std::optional<double> tool_length_mm(int number) const;
    void declare_tool(const GcodeTool& tool) { declared_[tool.number] = tool; }

    // Returns true at the first call for a note, and for a letter or code that it is about.
    bool first(Note note, int about = 0) { return noted_.emplace(note, about).second; }
    // True if the program has a word of the axis 0 to 2 (X Y Z).
    bool writes_axis(std::size_t axis);
    // A move is left out, because it starts where only the machine knows.
    void leave_out(int line, int lost_line);
    // Adds the warnings about all that was left out.
    void finish();
    void warn(int line, std::string text);
    std::unexpected<Error> refuse(int line, int column, std::string cause, std::string remedy) const;
    std::unexpected<Error> refuse_more_moves(int line) const;

  private:
    MoveSink* sink_;
    std::map<int, GcodeTool> given_, declared_;  // by number: of the options, of the program
    std::set<std::pair<Note, int>> noted_;
    std::array<std::optional<bool>, 3> writes_axis_;  // once it was asked
    std::size_t left_out_ = 0;
    int left_out_line_ = 0, left_out_since_ = 0;  // the first of them
};

}  // namespace tribo::readers::gcode

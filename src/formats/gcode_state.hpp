// SPDX-License-Identifier: MIT
// What a control remembers from one block to the next.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "base/result.hpp"
#include "base/vec3.hpp"
#include "formats/gcode_reader.hpp"

namespace tribo::formats::gcode {

enum class Plane { xy, zx, yz };  // G17 G18 G19
enum class FeedMode { per_minute, inverse_time, per_turn };
enum class MotionMode { none, rapid, line, arc_clockwise, arc_counter_clockwise };
enum class Spindle { off, clockwise, counter_clockwise };

// What is known of a coordinate: nothing has stated it yet; it is known; or the machine took the axis to a
// place that only it knows (G28, G53).
enum class Known { unstated, yes, lost };

inline constexpr int kWorkSystems = 9;  // G54 to G59, G59.1 to G59.3

struct WorkSystem {
    Vec3 origin_mm;  // in the stock's frame
    bool set = false;
};

struct State {
    double unit_mm = 1;
    bool unit_stated = false;
    Plane plane = Plane::xy;
    bool incremental = false;
    bool absolute_centres = false;  // G90.1
    MotionMode motion = MotionMode::none;

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
    Vec3 preset_mm;  // G92's
    bool preset_on = true;

    Vec3 tip_mm;  // in the stock's frame; 0 where not known
    std::array<Known, 3> known{Known::unstated, Known::unstated, Known::unstated};
    int lost_line = 0;  // of the last block that lost an axis

    // Where the program's zero stands in the stock's frame.
    Vec3 origin_mm() const {
        const Vec3& origin = work[static_cast<std::size_t>(active_work)].origin_mm;
        return preset_on ? origin + preset_mm : origin;
    }
    bool knows_tip() const {
        return known[0] == Known::yes && known[1] == Known::yes && known[2] == Known::yes;
    }
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
    default_feed,
    preset_as_origin,
    deletable_blocks,
    count
};

// Where blocks put what they give: moves, warnings and errors.
class Output {
  public:
    explicit Output(const GcodeOptions& options) : options(options) { program.source = options.source_name; }

    const GcodeOptions& options;
    motion::Program program;

    // True the first time it is asked of a note.
    bool first(Note note);
    void warn(int line, std::string text);
    std::unexpected<Error> refuse(int line, int column, std::string cause, std::string remedy) const;

  private:
    std::array<bool, static_cast<std::size_t>(Note::count)> noted_{};
};

}  // namespace tribo::formats::gcode

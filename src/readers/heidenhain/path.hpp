// SPDX-License-Identifier: MIT
// Where the tool of a conversational program is, and its moves in the stock.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "motion/machine/work_frame.hpp"
#include "motion/path/program.hpp"
#include "readers/control/machine_run.hpp"
#include "readers/gcode/reader.hpp"

namespace tribo::readers::heidenhain {

enum class Known { unstated, yes, lost };

// Where a block stands, for its messages.
struct Place {
    int line = 0, column = 0;
};

class Path {
  public:
    // Moves go to the sink, or into the program where there is none.
    Path(const GcodeOptions& options, MoveSink* sink);

    const GcodeOptions& options;
    motion::Program program;
    std::size_t moves = 0;
    std::optional<MachineRun> machine;

    // What a move carries.
    double spindle_rpm = 0;
    int tool = 0;
    std::optional<double> feed_mm_per_min;  // modal F
    bool spindle_on = false;

    // Coordinates of the block in force: where the datum, a rotation and a tilted plane put them.
    motion::WorkFrame frame;
    bool tip_control = false;

    // The tip in the coordinates of the frame; only where they are known.
    Vec3 tip() const { return frame.from_stock(place_mm_); }
    bool knows_tip() const;
    Known known(int axis) const { return known_[static_cast<std::size_t>(axis)]; }
    int lost_line() const { return lost_line_; }
    Vec3 rotary_rad() const { return now_rad_; }

    // States the coordinates of axes without a move that could be shown; `known` per axis.
    void put(Vec3 tip_in_frame, std::array<Known, 3> known, int line);
    void lose(int line);

    // A move to the point, in coordinates of the frame, on a line or arc (of the same coordinates) while the
    // rotary axes turn to `to_rad`. Needs a known tip.
    Result<void> move(motion::MoveKind kind, Vec3 to, const std::optional<motion::Arc>& arc, Vec3 to_rad,
                      Place place);
    Result<void> dwell(double seconds, Place place);
    // Turns the rotary axes without the tip being known.
    void set_rotary(Vec3 to_rad) { now_rad_ = to_rad; }
    // The tool's axis, in the stock, at the end of the next move (LN with TX TY TZ). On a machine its rotary
    // axes say it.
    void aim(Vec3 axis) { aim_ = axis; }
    Vec3 axis() const { return aim_; }

    // Takes the length of the tool in the spindle from the options, else from the program's TOOL DEF.
    void measure_tool();

    // Coordinates become the tip's in the stock, or the machine's again; the tool stays where it is.
    void switch_tip_control(bool on, int line);
    // Puts the tool upright in a plane and counts coordinates there. The tip stays where `keep_tip` says so;
    // else it goes where the turning axes of a machine lead it, and without one its place is lost. False
    // where no angle of the machine reaches the plane.
    bool tilt(const motion::WorkFrame& plane, bool keep_tip, int line);

    bool first(int note);
    void warn(int line, std::string text);
    std::unexpected<Error> refuse(Place place, std::string cause, std::string remedy) const;
    // Refuses or notes that something needs a machine.
    void note_machine_needed(int line, const std::string& what);

  private:
    Result<void> append(const motion::Move& move);
    // Whether coordinates are the tip's in the stock: without a machine they always are.
    bool in_stock() const { return !machine || tip_control || frame.is_tilted(); }

    MoveSink* sink_;
    Vec3 place_mm_;  // of the tip in the stock's frame; on a machine without tip control X Y Z of the machine
    std::array<Known, 3> known_{Known::unstated, Known::unstated, Known::unstated};
    int lost_line_ = 0;
    Vec3 now_rad_;
    Vec3 axis_{0, 0, 1}, aim_{0, 0, 1};
    std::array<bool, 32> noted_{};
};

}  // namespace tribo::readers::heidenhain

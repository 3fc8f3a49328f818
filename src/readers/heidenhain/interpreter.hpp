// SPDX-License-Identifier: MIT
// Runs the blocks of a conversational program one by one.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "readers/control/run_limit.hpp"
#include "readers/heidenhain/line.hpp"
#include "readers/heidenhain/path.hpp"

namespace tribo::readers::heidenhain {

// Notes with one warning per program.
enum Note {
    kNoUnit,
    kUnstatedAxes,
    kMachinePosition,
    kSpindleOff,
    kSpindleStands,
    kDefaultFeed,
    kToolLength,
    kIgnoredCycle,
    kDatum,
    kDisengage,
    kCylinder,
    kDeltas,
};

// The drilling cycle in force: its number, and its parameters by Q number.
struct DrillingCycle {
    int number = 0;  // 0: none
    Place place;
    std::map<int, double> q;  // lengths in mm, feeds in mm/min

    double at(int parameter, double otherwise = 0) const {
        const auto found = q.find(parameter);
        return found == q.end() ? otherwise : found->second;
    }
};

class Interpreter {
  public:
    Interpreter(std::string_view bytes, const GcodeOptions& options, MoveSink* sink);
    Result<motion::Program> run();

  private:
    // Flow and data (interpreter.cpp)
    Result<void> take_line();
    Result<bool> goes_on();
    Result<void> execute(LineReader& in);
    Result<void> begin(LineReader& in);
    Result<void> blank_form(LineReader& in);
    Result<void> define_tool(LineReader& in);
    Result<void> call_tool(LineReader& in);
    Result<void> assign(LineReader& in);
    Result<void> function(LineReader& in);
    Result<void> jump_if(LineReader& in, int operation);
    Result<void> call_label(LineReader& in);
    Result<void> end_label();
    Result<void> go_to(const std::string& label, int column);
    Result<motion::Program> finish();

    // Moves (motion.cpp)
    struct Words;  // the sorted words of a path function
    Result<Words> read_words(LineReader& in, std::string_view own);
    Result<void> apply_feed(const Words& words);
    Result<Vec3> target(const Words& words);
    Result<Vec3> polar_target(const Words& words);
    Result<Vec3> rotary_target(const Words& words);
    Result<void> line(LineReader& in, bool polar);
    Result<void> line_with_vectors(LineReader& in);
    Result<void> pole(LineReader& in);
    Result<void> circle(LineReader& in);
    Result<void> circle_of_radius(LineReader& in);
    Result<void> tangent_circle(LineReader& in);
    Result<void> polar_circle(LineReader& in);
    Result<void> travel(const Words& words, Vec3 to, const std::optional<motion::Arc>& arc, Vec3 to_rad);
    Result<void> miscellaneous(const Words& words);
    Result<void> go(bool rapid, Vec3 to, const std::optional<motion::Arc>& arc, Vec3 to_rad);
    Result<void> require_start();

    // Cycles and planes (cycles.cpp)
    Result<void> define_cycle(LineReader& in);
    Result<void> define_drilling(LineReader& in, int number);
    Result<void> read_parameters(LineReader& in, DrillingCycle& cycle);
    Result<void> read_parameters_of_line(LineReader& in, DrillingCycle& cycle);
    Result<void> set_datum(LineReader& in);
    Result<void> shift_datum(LineReader& in);
    Result<void> call_cycle(Place place);
    Result<void> drill();
    Result<void> bore();
    Result<void> go_to_height(double z, double feed_mm_per_min);
    Result<void> plane(LineReader& in);
    Result<void> tip_control(LineReader& in);
    void set_frame();

    Place place(int column) const { return {line_.number, column}; }

    std::string source_name_;
    Path path_;
    std::vector<std::string_view> lines_;
    std::map<std::string, std::size_t> labels_;  // line after the LBL
    std::map<std::size_t, long> repeats_;        // runs left, by the line of CALL LBL REP
    std::vector<std::size_t> calls_;             // lines to return to
    std::size_t at_ = 0;                         // index of the running line
    Line line_;
    bool ended_ = false, begun_ = false, moved_ = false;
    RunLimit limit_;

    Parameters parameters_;
    double unit_mm_ = 1;
    std::optional<Vec3> blank_min_;
    double tool_feed_ = 0;       // of TOOL CALL, for F AUTO
    bool shortest_way_ = false;  // M126
    std::optional<Vec3> pole_;   // in the frame
    Vec3 tangent_;               // of the last move, in the frame; 0: none
    motion::WorkFrame plane_;    // of PLANE; its origin is the datum in force at the PLANE
    Vec3 shift_mm_;              // datum shift in the plane
    Vec3 untilted_shift_mm_;     // datum shift restored by PLANE RESET
    double rotation_deg_ = 0;    // CYCL DEF 10
    DrillingCycle cycle_;
    bool cycle_at_every_position_ = false;  // M89
};

// The words of a path function.
struct Interpreter::Words {
    std::vector<Item> items;
    std::optional<double> axis[3], increment[3];  // X Y Z, mm
    std::optional<double> rotary[3], turn[3];     // A B C, deg: absolute, incremental
    std::optional<double> vector[3];              // TX TY TZ
    std::optional<double> polar_radius, polar_angle, polar_turn;
    bool polar_radius_increment = false;
    std::optional<double> radius;  // R of CR, mm
    int direction = 0;             // DR: +1 or -1
    bool fast = false;
    bool machine_position = false;  // M91, M92
    std::vector<int> m;
    int first_column = 1;
};

}  // namespace tribo::readers::heidenhain

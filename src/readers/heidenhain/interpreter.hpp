// SPDX-License-Identifier: MIT
// Runs the blocks of a conversational program one by one.
#pragma once

#include <array>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "readers/control/area_milling.hpp"
#include "readers/control/contour.hpp"
#include "readers/control/face.hpp"
#include "readers/control/helix.hpp"
#include "readers/control/path.hpp"
#include "readers/control/pocket.hpp"
#include "readers/control/refusals.hpp"
#include "readers/control/run_limit.hpp"
#include "readers/gcode/state.hpp"
#include "readers/heidenhain/free_contour.hpp"
#include "readers/heidenhain/line.hpp"

namespace tribo::readers::heidenhain {

using control::Contour;
using control::ContourEnd;
using control::ContourEndShape;
using control::ContourWords;
using control::Known;
using control::Path;
using control::Place;

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
    kBackBoring,
    kCylinder,
    kDeltas,
    kSkipped,
    kDatumTable,
    kTimedFeed,
    kProbing,
    kNoRadius,
    kSpotAngle,
    kCirclePlane,
    kPoleOfBefore,
    kPocketWay,
    kThreadWay,
    kFaceWay,
    kProjection,
    kFreeChoice,
    kFreeCircle,
    kOneAxisCompensation,
    kOtherTurn,
};

// A feed for FMAX, and the least value of one that old programs write for it.
inline constexpr double kRapid = std::numeric_limits<double>::infinity(), kFastFeed = 99'999;

// Keys of Cycle::q beside the Q numbers: the feed of a line .n of the cycles 4 and 5, and their direction.
inline constexpr int kFeedOfPart = 10'000, kTurn = 20'000, kAlongY = 20'001;

// The cycle in force: its number, and its parameters by Q number. The old cycles 1, 2 and 17 keep their
// words .1 to .5 under 1 to 5.
struct Cycle {
    int number = 0;  // 0: none
    Place place;
    std::map<int, double> q;  // lengths in mm, feeds in mm/min

    double at(int parameter, double otherwise = 0) const {
        const auto found = q.find(parameter);
        return found == q.end() ? otherwise : found->second;
    }
};

// Cycles of one value a line. They begin at their clearance, where the tool is.
constexpr bool is_old_cycle(int cycle) {
    return (cycle >= 1 && cycle <= 5) || cycle == 17;
}

class Interpreter {
  public:
    Interpreter(std::string_view bytes, const GcodeOptions& options, MoveSink* sink);
    Result<motion::Program> run();

  private:
    // Blocks (interpreter.cpp)
    Result<void> run_line();
    bool goes_on_after(const Error& error);
    Result<void> take_line();
    Result<bool> goes_on();
    Result<void> all_items(LineReader& in, std::vector<Item>& items);
    Result<void> execute(LineReader& in);
    Result<void> execute_path(LineReader& in);
    Result<void> pass_over(const std::string& what);
    Result<void> skip_continuation();
    Result<void> skip_text();
    Result<void> begin();
    Result<motion::Program> finish();

    // Labels, parameters and FN (flow.cpp)
    Result<void> assign(LineReader& in);
    Result<void> assign_text(LineReader& in);
    Result<void> function(LineReader& in);
    Result<void> jump_if(LineReader& in, int operation);
    Result<void> read_system(LineReader& in);
    Result<void> call(LineReader& in);
    Result<void> call_program(std::string name);
    Result<void> leave_out_program(std::string name);
    Result<void> end_label();
    std::unexpected<Error> refuse_behind_label(const LineReader& in, int column) const;
    void end_program();
    std::string label_key(const std::string& label, std::size_t line) const;
    Result<void> go_to(const std::string& label, int column);

    // Stock and tools (tools.cpp)
    Result<void> blank_form(LineReader& in);
    Result<void> define_tool(LineReader& in);
    Result<void> call_tool(LineReader& in);
    void put_tool(int number);
    void number_tools();
    int number_of_tool(const std::string& name);
    void read_notes(std::string_view line);

    // Words of a block (words.cpp)
    struct Words;      // the sorted words of a path function
    struct FreeWords;  // those that only the blocks of free contours have
    Result<Words> read_words(LineReader& in, std::string_view own, FreeWords* free = nullptr);
    Result<void> sort_word(LineReader& in, const Item& item, std::string_view own, Words& words);
    Result<void> apply_feed(const Words& words);
    Result<double> feed_of(const Item& item);
    Result<void> miscellaneous(const Words& words);
    Result<void> retract(const Words& words);

    // Moves (motion.cpp, circles.cpp, corners.cpp)
    Result<Vec3> target(const Words& words);
    Result<Vec3> polar_target(const Words& words);
    Result<Vec3> rotary_target(const Words& words);
    Result<void> line(LineReader& in, bool polar);
    Result<void> move_parallel_axes(const Words& words);
    Result<void> line_with_vectors(LineReader& in);
    Result<void> pole(LineReader& in);
    Result<void> circle(LineReader& in);
    Result<void> circle_of_radius(LineReader& in);
    Result<void> tangent_circle(LineReader& in, bool polar);
    Result<void> polar_circle(LineReader& in);
    Result<void> corner(LineReader& in, bool is_chamfer);
    Result<void> add_corner(const Words& words, bool is_chamfer);
    Result<void> approach(LineReader& in);
    Result<void> depart(LineReader& in);
    Result<void> contour_end(LineReader& in, ContourEnd& shape, bool& polar);
    Result<void> contour_end_sizes(const Words& words, int column, ContourEndShape& shape);
    Result<double> compensation_radius(Place where);
    bool corner_follows() const;
    double plane_scale() const;
    Result<void> refuse_uneven_scale(int column) const;
    int turning(int direction, gcode::Plane plane) const;
    Result<void> find_plane(Vec3 to, int column);
    bool lies_flat(Vec3 to) const;
    Result<void> travel(const Words& words, Vec3 to, const std::optional<motion::Arc>& arc, Vec3 to_rad);
    Result<bool> add_to_contour(const Words& words, Vec3 to, const std::optional<motion::Arc>& arc,
                                bool turns);
    Result<void> close_contour();
    Result<void> choose_side(const Words& words);
    Result<void> check_start(bool rapid);
    Result<void> go(bool rapid, Vec3 to, const std::optional<motion::Arc>& arc, Vec3 to_rad);
    bool is_lost() const;
    void leave_out();
    void assume_start();
    Result<bool> has_start(const Words& words, bool polar);
    // The programmed position in the frame: with radius compensation that of the contour.
    Vec3 here() const {
        if (captured_ && !captured_->steps.empty()) return captured_->steps.back().to;
        return contour_.programmed().value_or(path_.tip());
    }
    ContourWords contour_words(bool rapid) const;

    // Free contours (free_blocks.cpp)
    struct FreeBlock;
    bool keeps_free_contour() const;
    Result<void> free_pole(LineReader& in);
    Result<void> free_block(LineReader& in, const std::string& name);
    Result<bool> free_word(LineReader& in, const std::vector<Item>& items, std::size_t i, FreeWords& free);
    Result<std::size_t> free_reference(const LineReader& in, const Item& item) const;
    Result<void> free_point(const LineReader& in, const FreeWords& free, bool of_centre,
                            FreeElement& element) const;
    Result<void> free_direction(const LineReader& in, const FreeWords& free, FreeElement& element) const;
    Result<FreeElement> free_element(const LineReader& in, const Words& words, const FreeWords& free,
                                     bool is_arc, bool is_tangent) const;
    Result<void> select_free_contour(LineReader& in);
    Result<void> close_free_contour();
    Result<void> run_free_blocks(const std::vector<FreeBlock>& blocks, const std::vector<FreePiece>& pieces);

    // Frames (frames.cpp, planes.cpp)
    Result<void> set_datum(LineReader& in, int part);
    Result<void> mirror(LineReader& in);
    Result<void> set_scale(LineReader& in, int number);
    Result<void> transform(LineReader& in);
    Result<void> plane(LineReader& in);
    Result<void> working_plane(LineReader& in);
    Result<void> tilt(motion::WorkFrame turned, bool resets, bool keeps_tip, int column,
                      const std::optional<Vec3>& to_rad = {});
    Result<void> tilt_by_axes(const std::vector<Item>& items, bool keeps_tip, int column);
    void note_projection();
    Result<void> machine_function(LineReader& in);
    motion::WorkFrame frame_in_plane() const;
    void set_frame();

    // Cycles (cycles.cpp, drilling.cpp, patterns.cpp, pockets.cpp, thread_milling.cpp, faces.cpp)
    Result<void> define_cycle(LineReader& in);
    // A block was refused: what lacks it now is no fault of its own.
    bool follows_refusal() const { return first_refusal(path_.options.refusals) != nullptr; }
    void change_cycle(int parameter, double value);
    double unit_of_parameter(int q) const;
    Result<void> leave_out_cycle(int number);
    Result<void> take_preset(const std::string& block);
    Result<void> define_q_cycle(LineReader& in, int number);
    Result<void> define_old_cycle(LineReader& in, int number, int part);
    Result<void> check_cycle(const Cycle& cycle) const;
    Result<void> read_parameters(LineReader& in, Cycle& cycle);
    Result<void> call_cycle(LineReader& in);
    void come_from_above();
    Result<void> run_cycle(Place place);
    Result<void> go_to_height(double z, double feed_mm_per_min);
    Result<void> go_to_place(double x, double y, double feed_mm_per_min);
    Result<void> drill();
    Result<void> peck_deep();
    Result<void> bore();
    Result<void> check_back_boring(const Cycle& cycle) const;
    Result<void> bore_back();
    Result<void> tap();
    Result<void> mill_bore();
    Result<void> drill_as_of_old();
    static bool is_pocket(int number);
    Result<void> define_old_pocket(LineReader& in, int part);
    Result<control::Pocket> pocket_of_cycle();
    Vec3 middle_of(const control::Pocket& pocket) const;
    Result<void> mill_pocket_cycle();
    Result<void> read_polygon(control::Pocket& stud) const;
    Result<void> mill_curved_slots(const control::Pocket& pocket);
    control::PocketMove mover();
    static bool is_thread(int number);
    std::optional<double> cycle_feed(int parameter) const;
    Result<control::Helix> thread_of_cycle();
    Result<void> mill_thread();
    Result<void> mill_turns(control::Helix helix);
    Result<void> sink_to_depth(double z);
    Result<void> drill_before_thread();
    Result<void> sink_front(control::Helix circle);
    static bool is_face(int number);
    Vec3 corner_of_face(double length, double width) const;
    Result<control::Face> face_of_cycle(double radius);
    control::Face old_face_of_cycle(double radius) const;
    Result<void> mill_face();
    Result<void> mill_ruled_face(double diameter);
    // Contours in subprograms that cycles mill (contour_cycles.cpp)
    struct Captured {
        std::vector<control::ContourStep> steps;
        int side = 0;  // of RL and RR
    };
    static bool is_contour_cycle(int number);
    Result<void> choose_contours(LineReader& in);
    Result<void> define_contour_cycle(LineReader& in, int number);
    Result<Captured> capture(const std::string& label);
    void keep_step(const Words& words, Vec3 to, const std::optional<motion::Arc>& arc);
    Result<control::Ring> elements_of(const Captured& contour);
    double contour_word(int parameter) const;
    Result<double> contour_feed(int parameter);
    control::PocketDepths contour_depths() const;
    Result<void> mill_contour_cycle();
    Result<void> mill_contour_pocket(double radius);
    Result<void> follow_contour();
    Result<void> follow_contour_at(const control::Ring& elements, int side, double radius, double z);
    Result<void> return_from(double surface, double feed_mm_per_min);
    double cutter_radius(double room = control::kOpenMm);
    Result<void> define_pattern(LineReader& in);
    Result<void> add_pattern(const std::string& kind, const std::map<std::string, double>& words, int column);
    Result<void> run_point_pattern(const Cycle& pattern);
    Vec3 in_frame(double x, double y, double z) const;
    Result<void> run_at(const std::vector<Vec3>& points, Place place);

    Line line_at(std::size_t i) const { return line_of(lines_[i], numbers_[i]); }
    Place place(int column) const { return {line_.number, column}; }

    std::string source_name_;
    Path path_;
    Contour contour_;
    std::vector<std::string_view> lines_;  // blocks: a line of the text may hold several
    std::vector<int> numbers_;             // of their lines in the text
    // A program of the text, with the line of its BEGIN PGM.
    struct Unit {
        std::string name;
        std::size_t begin = 0;
    };
    // A call without its return so far.
    struct Return {
        std::size_t line = 0;
        bool of_program = false;
        double unit_mm = 1;  // of the caller
    };
    std::vector<Unit> programs_;
    std::map<std::string, std::size_t> labels_;  // line after the LBL, by label_key()
    std::map<std::size_t, long> repeats_;        // runs left, by the line of CALL LBL REP
    std::vector<Return> calls_;
    std::size_t at_ = 0;  // index of the running line
    Line line_;
    bool ended_ = false, begun_ = false;
    bool is_over_ = false;                        // its loops do not end
    std::size_t left_out_ = 0;                    // moves that begin where only the machine knows
    int left_out_line_ = 0, left_out_since_ = 0;  // of the first
    RunLimit limit_;
    std::set<std::string> passed_over_;       // words without effect that were warned of
    std::map<std::string, int> named_tools_;  // their numbers
    std::set<int> numbered_tools_;            // numbers that the text uses itself

    Parameters parameters_;
    std::map<int, double> general_;  // GLOBAL DEF: values for Q...=PREDEF
    double unit_mm_ = 1;
    // Feeds count tenths of inches in programs in inches (iTNC 530, User's Manual: F, TOOL CALL, cycles).
    double feed_unit_mm() const { return unit_mm_ == 1 ? 1 : unit_mm_ / 10; }
    std::optional<Vec3> blank_min_;
    double tool_feed_ = 0;         // of TOOL CALL, for F AUTO
    double tool_oversize_mm_ = 0;  // DR of TOOL CALL
    bool feed_per_turn_ = false;   // M136
    bool shortest_way_ = false;    // M126
    bool last_was_rapid_ = false;  // for APPR
    int side_ = 0;                 // RL +1, RR -1, R0 0
    std::optional<Vec3> pole_;     // in the frame
    gcode::Plane pole_plane_ = gcode::Plane::xy;
    bool pole_has_plane_ = true;    // false: CC names all three axes
    Vec3 tangent_;                  // of the last move, in the frame; 0: none
    motion::WorkFrame plane_;       // of PLANE; its origin is the datum in force at the PLANE
    Vec3 shift_mm_;                 // datum shift in the plane
    Vec3 untilted_shift_mm_;        // datum shift restored by PLANE RESET
    double rotation_deg_ = 0;       // CYCL DEF 10
    std::optional<int> datum_row_;  // of the datum table
    Vec3 mirror_{1, 1, 1};          // CYCL DEF 8: -1 for a mirrored axis
    Vec3 scale_{1, 1, 1};           // CYCL DEF 11 and 26
    Vec3 scale_centre_mm_;
    Cycle cycle_;
    std::string called_program_;               // CYCL DEF 12
    std::vector<Vec3> pattern_;                // PATTERN DEF, in the frame; z adds to the surface
    bool cycle_at_every_position_ = false;     // M89
    std::vector<std::string> contour_labels_;  // CYCL DEF 14
    Cycle contour_data_;                       // CYCL DEF 20
    // The contour that is being read; its blocks do not move the tool.
    std::optional<Captured> captured_;

    // The free contour whose blocks wait until it is known.
    struct FreeRun {
        FreeContour contour;
        Vec3 start;
        bool has_direction = false;              // the tool came along one
        std::optional<std::size_t> closed_from;  // the element with CLSD+
        std::vector<FreeBlock> blocks;
    };
    std::optional<FreeRun> free_;
    std::map<long, std::size_t> free_numbers_;  // its elements, by the numbers of their blocks
    std::optional<Vec3> free_pole_;             // FPOL
    std::optional<bool> corner_next_;           // a corner follows the block of a free contour that runs
};

// The words of a path function.
struct Interpreter::Words {
    std::vector<Item> items;
    std::optional<double> axis[3], increment[3];  // X Y Z in the frame, mm
    std::optional<double> parallel[3];            // U V W, mm
    std::optional<double> rotary[3], turn[3];     // A B C, deg: absolute, incremental
    std::optional<double> vector[3];              // TX TY TZ
    std::optional<double> polar_radius, polar_angle, polar_turn;
    bool polar_radius_increment = false;
    std::optional<double> radius;  // R of CR, RND, APPR, DEP, mm
    std::optional<double> length;  // LEN, mm, and the side of CHF
    std::optional<double> angle;   // CCA, deg
    std::optional<int> side;       // RL +1, RR -1, R0 0
    int direction = 0;             // DR: +1 or -1
    bool fast = false;
    bool machine_position = false;  // M91, M92
    std::optional<double> retract;  // MB, mm; infinite for MB MAX
    std::vector<int> m;
    int first_column = 1;
};

struct FreeWord {
    double value = 0;  // mm or rad
    bool is_increment = false;
    int column = 1;
};

struct Interpreter::FreeWords {
    std::map<std::string, FreeWord> values;         // by name without I
    std::map<std::string, std::size_t> references;  // RX, RAN ..: by name without R; PAR
    std::array<Vec3, 4> points;                     // PD, P1, P2, P3
    std::array<bool, 4> has_point{};
    int closing = 0;  // CLSD+ or CLSD-
};

// An element or a corner of a free contour.
struct Interpreter::FreeBlock {
    enum class Kind { element, rounding, chamfer };
    Line line;
    Words words;
    Kind kind = Kind::element;
};

}  // namespace tribo::readers::heidenhain

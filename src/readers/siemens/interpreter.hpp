// SPDX-License-Identifier: MIT
// Runs the blocks of a program one by one.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/math.hpp"
#include "readers/control/area_milling.hpp"
#include "readers/control/contour.hpp"
#include "readers/control/helix.hpp"
#include "readers/control/path.hpp"
#include "readers/control/pocket.hpp"
#include "readers/control/run_limit.hpp"
#include "readers/gcode/cursor.hpp"
#include "readers/gcode/motion/arc.hpp"
#include "readers/siemens/formula.hpp"
#include "readers/siemens/text.hpp"
#include "readers/siemens/words.hpp"

namespace tribo::readers::siemens {

using control::Known;
using control::Path;
using control::Place;
using gcode::Cursor;

// Notes with one warning per program.
enum Note {
    kNoUnit,
    kUnitOfIso,
    kUnstatedAxes,
    kMachinePlace,
    kSpindleOff,
    kSpindleStands,
    kSkipped,
    kToolLength,
    kNoRadius,
    kWorkOffset,
    kOtherPrograms,
    kEulerAngles,
    kComment,
    kReferencePlane,
    kSpatial,
    kSurfaceSpeed,
    kDwellInContour,
    kRadiusWord,
    kShank,
    kPocket,
    kSmoothing,
    kTipControl,
    kPolar,
    kOtherStock,
    kCurveThroughPoints,
    kFeedOfInches,
};

inline constexpr int kDeepestCall = 24;          // of calls and repeats within each other
inline constexpr std::size_t kNoParameter = 99;  // a cycle has none of it

// A spline: its control points so far, or the points that it leads through.
struct Spline {
    Motion kind = Motion::bspline;
    std::vector<motion::HomogeneousPoint> control;
    std::size_t degree = 3;
    std::optional<double> knot_step;  // PL
    Place place;
};

// `inner`, given in the coordinates of `outer`.
motion::WorkFrame joined(const motion::WorkFrame& outer, const motion::WorkFrame& inner);
// The angles of ROT turn about z, then about the new y, then about the new x.
motion::WorkFrame turned_by(motion::WorkFrame frame, const Vec3& rad);

class Interpreter : private SystemValues {
  public:
    Interpreter(std::string_view bytes, const GcodeOptions& options, MoveSink* sink);
    Result<motion::Program> run();

  private:
    // Blocks (interpreter.cpp)
    Result<void> run_lines(std::size_t begin, std::size_t end);
    Result<void> run_line();
    bool goes_on_after(const Error& error);
    Result<void> execute(Cursor& in);
    Result<void> run_words(Words& words);
    Result<motion::Program> finish();

    // Structures and jumps (flow.cpp)
    Result<bool> run_structure(const std::string& word, Cursor& in);
    Result<void> run_if(Cursor& in);
    Result<void> begin_loop(const std::string& word, Cursor& in);
    Result<void> end_loop(const std::string& word, Cursor& in);
    Result<bool> condition(Cursor& in);
    Result<bool> step_for(Cursor& in, bool begins);
    Result<void> choose_case(Cursor& in);
    Result<void> jump(const std::string& word, Cursor& in);
    Result<void> repeat(Cursor& in, bool one_block);
    Result<std::string> label(Cursor& in);
    void go_to(std::size_t line);

    // Variables and programs (programs.cpp)
    Result<void> define(Cursor& in);
    Result<void> read_sizes(Variable& variable, std::size_t at, Cursor& in);
    Result<void> define_macro(Cursor& in);
    Result<Call> call_at(Cursor& in, const std::string& name, std::size_t at);
    Result<void> run_call(const Call& call);
    Result<void> run_unit(const Unit& unit, const Call& call);
    struct Returned {  // a VAR parameter, what the caller gave for it, and its values at the end
        std::string name, given;
        std::vector<Value> values;
    };
    Result<void> take_parameters(const Unit& unit, const Call& call, std::vector<Returned>& returned);
    Result<void> leave_out_program(const Call& call);
    static std::string program_name(const std::string& text);
    Result<void> call_by_text(const std::string& word, Cursor& in);
    Result<void> assign(const std::string& name, std::size_t at, Cursor& in);
    Result<void> assign_system(Cursor& in);
    Result<void> set_element(Variable& variable, std::size_t place, const Value& value, std::size_t at,
                             Cursor& in) const;

    // Words (words.cpp, addresses.cpp)
    Result<void> read_words(Cursor& in, Words& words, int depth = 0);
    Result<void> read_word(Cursor& in, Words& words, int depth);
    Result<void> read_name(Cursor& in, Words& words, int depth);
    Result<void> read_named_value(Cursor& in, const std::string& name, std::size_t at, Words& words);
    Result<void> read_indexed(Cursor& in, const std::string& name, std::size_t at, Words& words);
    Result<bool> read_keyword(Cursor& in, const std::string& name, Words& words);
    Result<void> skip_parentheses(Cursor& in);
    Result<Amount> amount(Cursor& in);
    Result<void> refer_feed(Cursor& in, const std::string& axis);
    Result<void> group_feed(Cursor& in);
    void count_turns();
    Result<void> take_address(Cursor& in, const std::string& name, Amount amount, Words& words);
    Result<void> choose_tool(Cursor& in, std::size_t at, Words& words);

    // Codes and modes (codes.cpp)
    Result<void> apply_codes(Words& words);
    Result<void> apply_g(Words& words, const Code& code);
    void apply_m_before(const Words& words);
    Result<void> apply_m_after(const Words& words);
    Result<void> apply_feed(const Words& words);
    Result<void> apply_spindle(const Words& words);
    Result<void> dwell(const Words& words);

    // Tools and variables of the control (tools.cpp)
    void number_tools();
    int number_of_tool(const std::string& name);
    void load_tool(int number);
    void read_notes(std::string_view text, std::string_view code);
    std::optional<Value> system_value(const std::string& name,
                                      const std::vector<Value>& index) const override;

    // Moves (motion.cpp, circles.cpp, orientation.cpp)
    Result<void> move(const Words& words);
    Result<bool> find_target(const Words& words, Vec3& to);
    Result<void> polar_target(const Words& words, Vec3& to);
    Result<void> angled_target(const Words& words, Vec3& to);
    void assume_start();
    Result<void> leave_for_machine(const Words& words);
    Result<void> move_parallel_axes(const Words& words);
    Result<void> travel(const Words& words, Vec3 to, const std::optional<motion::Arc>& arc);
    Result<void> go(bool rapid, Vec3 to, const std::optional<motion::Arc>& arc, Vec3 to_rad);
    void check_start(bool rapid);
    Result<void> set_block_feed(const Words& words, Vec3 to, const std::optional<motion::Arc>& arc);
    Result<motion::Arc> circle(const Words& words, Vec3& to);
    Result<motion::Arc> circle_about(const Words& words, Vec3& to, bool clockwise);
    Result<motion::Arc> circle_through(const Words& words, Vec3 to);
    Result<motion::Arc> tangent_circle(const Words& words, Vec3 to);
    Result<void> set_pole(const Words& words, int code);
    Result<void> orient(const Words& words);
    Result<Vec3> rotary_target(const Words& words);
    Result<void> switch_tip_control(bool on);
    Result<void> transform_kinematics(const Words& words);
    bool is_rapid(const Words& words) const { return motion_ == Motion::rapid || words.positions; }

    // Splines (splines.cpp)
    Result<void> add_to_spline(const Words& words, Vec3 to);
    Result<void> close_spline();
    Result<void> run_polynomial(const Words& words, Vec3 to);

    // Corners and radius compensation (corners.cpp)
    Result<bool> add_to_contour(const Words& words, Vec3 to, const std::optional<motion::Arc>& arc);
    Result<void> close_contour();
    Result<double> cutter_radius(Place where, const char* what);
    control::ContourWords contour_words(bool rapid) const;

    // Frames (frames.cpp)
    Result<void> transform(const Words& words);
    Result<void> turn_frame(const Words& words);
    void shift_axes(const Words& words);
    Result<void> frame_along_tool(const Words& words);
    Result<void> take_scale(double& scale, double factor, Place where) const;
    Result<motion::WorkFrame> turned_within(const motion::WorkFrame& frame, const Vec3& scale, Vec3 rad,
                                            Place where) const;
    Result<void> swivel(const Call& call);
    Result<void> declare_stock(const Call& call);
    Result<void> set_frame(int line);
    void set_work_offset(int code);
    motion::WorkFrame settable_frame() const;
    motion::WorkFrame outer_frame() const;
    Vec3 in_frame(Vec3 programmed) const {
        return {scale_.x * programmed.x, scale_.y * programmed.y, scale_.z * programmed.z};
    }
    Vec3 from_frame(Vec3 p) const { return {p.x / scale_.x, p.y / scale_.y, p.z / scale_.z}; }

    // Frames as values (frame_variables.cpp)
    bool is_frame(const std::string& name) const;
    motion::WorkFrame* frame_named(const std::string& name, const std::vector<Value>& index,
                                   std::size_t& parts);
    Result<void> assign_frame(const std::string& name, const std::vector<Value>& index, std::size_t at,
                              Cursor& in);
    Result<void> set_frame_part(motion::WorkFrame& frame, const std::vector<Value>& index, std::size_t first,
                                std::size_t at, Cursor& in);
    Result<motion::WorkFrame> frame_formula(Cursor& in, Vec3& scale);
    Result<motion::WorkFrame> frame_value(const std::string& name, std::size_t at, Cursor& in);
    Result<motion::WorkFrame> frame_by_call(const motion::WorkFrame& frame, Vec3& scale, const Call& call,
                                            std::size_t at, Cursor& in);

    // Cycles (cycles.cpp, drilling.cpp, pockets.cpp)
    Result<bool> run_cycle(const Call& call);
    Result<void> set_modal(Cursor& in);
    Result<void> run_modal();
    Result<bool> prepare_cycle(const Call& call);
    Result<void> run_at(const std::vector<Vec3>& points, const Call& call);
    Result<void> run_pattern(const Call& call);
    Result<void> drill(const Call& call);
    using Depths = control::PocketDepths;  // RTP, RFP, RFP + SDIS, DP
    using Pocket = control::Pocket;        // MID, MIDA, FAL; FFP1, FFD
    static bool is_milling_cycle(const std::string& name);
    Result<Depths> depths_of(const Call& call, std::size_t increment, std::size_t mode) const;
    double ring_step(const Call& call, std::size_t at, std::size_t mode, double radius) const;
    Result<double> cycle_feed(const Call& call, std::size_t at) const;
    Result<void> run_milling_cycle(const Call& call);
    Result<void> mill_pocket(const Pocket& pocket, Place where);
    Result<void> mill_face(const Call& call);
    Result<void> mill_polygon(const Call& call);
    void note_own_way(const std::string& cycle);
    Result<void> mill_curved_slots(const Call& call, const Pocket& pocket, Vec3 centre, double count);
    Result<void> mill_to(Vec3 to, std::optional<double> feed, const std::optional<motion::Arc>& arc);
    control::PocketMove mover();

    // Threads (threads.cpp)
    using Helix = control::Helix;
    Vec3 centre_of(const Call& call, std::size_t at_u, std::size_t at_v) const;
    Result<void> mill_thread(const Call& call);
    Result<void> mill_thread_of_plate(const Call& call);
    Result<void> mill_helix(const Helix& helix);

    // Contours that cycles follow (contours.cpp)
    struct ContourName {  // a program, or two labels of it or of the running program
        std::string program, begin, end;
    };
    using ContourStep = control::ContourStep;
    struct ContourPass {
        std::vector<ContourStep> steps;
        int side = 0, begin_kind = 1, end_kind = 1;
        double radius = 0, begin_size = 0, end_size = 0, z = 0, feed = 0, plunge = 0;
        std::optional<double> between;  // feed above the work; none: rapids
    };
    Result<void> choose_contour(const Call& call);
    ContourName contour_named(const std::string& text) const;
    Result<bool> capture_contour(const ContourName& name, const Call& call);
    Result<void> run_between(const std::string& first, const std::string& last, const Unit& unit,
                             Place where);
    Result<void> mill_contour(const Call& named);
    Result<std::optional<control::Ring>> closed_contour(const ContourName& name, const Call& call);
    Result<void> mill_contour_pocket(const Call& named);
    Result<void> run_contour_pass(const ContourPass& pass, const Depths& depths);

    Place place(int column) const { return {static_cast<int>(at_) + 1, column}; }
    int line_number() const { return static_cast<int>(at_) + 1; }
    // The programmed position in the frame: with radius compensation that of the contour, within a spline its
    // last point.
    Vec3 here() const {
        if (spline_) return spline_->control.back().xyz;
        if (captured_ && !captured_->empty()) return from_plane(captured_->back().to);
        return contour_.programmed() ? from_plane(*contour_.programmed()) : path_.tip();
    }
    std::array<int, 3> axes() const { return gcode::axes_of(plane_); }
    // Contours lie in x y: the coordinates of the plane in force, in their order.
    Vec3 to_plane(Vec3 p) const { return {p[axes()[0]], p[axes()[1]], p[axes()[2]]}; }
    Vec3 from_plane(Vec3 p) const {
        Vec3 turned;
        for (int k = 0; k < 3; ++k) turned[axes()[static_cast<std::size_t>(k)]] = p[k];
        return turned;
    }

    std::string source_name_;
    Text text_;
    Path path_;
    control::Contour contour_;
    RunLimit limit_;
    std::size_t at_ = 0;  // index of the running line
    bool ended_ = false, returned_ = false, is_over_ = false, jumped_ = false, began_ = false;
    int depth_ = 0;  // of calls and repeats
    const Unit* unit_ = nullptr;
    std::set<std::string> passed_over_;  // words without effect that were warned of
    Variables variables_;
    std::map<std::string, std::string> macros_;
    std::map<std::string, int> named_tools_;
    std::set<int> numbered_tools_;
    struct ToolData {  // $TC_DP3, 6 and 7
        double length_mm = 0, radius_mm = 0, corner_mm = 0;
    };
    std::map<int, ToolData> tool_data_;
    int selected_tool_ = 0;
    bool changes_with_m6_ = false;

    double unit_mm_ = 1;
    // FGROUP and FGREF: the rotary axes that the feed counts, and the radii at which it does. The control
    // begins with the radius at which a degree is a millimetre.
    std::array<bool, 3> in_feed_{};
    Vec3 feed_radius_mm_{math::kDegPerRad, math::kDegPerRad, math::kDegPerRad};
    bool has_unit_ = false;
    bool incremental_ = false;
    Motion motion_ = Motion::rapid;
    gcode::Plane plane_ = gcode::Plane::xy;
    int feed_mode_ = 94;
    double feed_ = 0;  // as written, for G93 and G95; 0: none
    int side_ = 0;     // G41 +1, G42 -1, G40 0
    double modal_rounding_mm_ = 0;
    double contour_offset_mm_ = 0;  // OFFN: what G41 and G42 keep from the contour beside the radius
    std::optional<Vec3> pole_;      // in the frame
    Vec3 tangent_;                  // at the end of the last move, in the frame; 0: none
    std::size_t left_out_ = 0;      // moves that begin where only the machine knows
    int left_out_line_ = 0;

    std::map<int, motion::WorkFrame> offsets_;  // that the program sets itself, by their G code
    int work_offset_ = 500;
    motion::WorkFrame base_frame_;                              // $P_BFRAME: without the work offset
    std::map<std::string, motion::WorkFrame> frame_variables_;  // DEF FRAME
    motion::WorkFrame swivelled_;                               // of CYCLE800, within the work offset
    motion::WorkFrame along_tool_;                              // TOROT and TOFRAME, within it
    motion::WorkFrame turned_;                                  // TRANS and ROT, within it
    Vec3 absolute_shift_;  // TRANS and G58: the share of turned_'s origin that ATRANS and G59 add to
    Vec3 scale_{1, 1, 1};  // SCALE, and MIRROR: negative; along the axes of turned_
    Vec3 target_rad_;      // of the rotary axes at the end of the block
    bool turns_ = false;   // the tool or a rotary axis turns in the block
    bool euler_ = true, euler_stated_ = false;  // A2 B2 C2 are Euler angles, not roll, pitch and yaw
    bool is_spatial_ = false;                   // CUT3DC and the like: compensation in space

    std::vector<ContourName> chosen_contours_;  // CYCLE62
    bool contours_are_used_ = false;            // the next CYCLE62 begins anew
    // The contour that is being read; its blocks do not move the tool.
    std::optional<std::vector<ContourStep>> captured_;
    std::optional<Call> modal_;  // MCALL
    int old_cycle_ = 0;          // G81 or G82
    bool runs_modal_ = false;

    std::optional<Spline> spline_;
};

}  // namespace tribo::readers::siemens

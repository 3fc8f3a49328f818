// SPDX-License-Identifier: MIT
#include "readers/control/path.hpp"

#include <algorithm>
#include <utility>

#include "base/text/limit_text.hpp"
#include "motion/path/moves.hpp"
#include "motion/path/path.hpp"
#include "readers/text/decimal_text.hpp"

namespace tribo::readers::control {

Path::Path(const GcodeOptions& given, MoveSink* sink) : options(given), sink_(sink) {
    program.source = options.source_name;
    for (const GcodeTool& known : options.tools) {
        if (known.length_mm) given_lengths_mm_[known.number] = *known.length_mm;
    }
    if (options.machine != nullptr) {
        machine.emplace(*options.machine);
        program.machine = options.machine->name;
    }
}

bool Path::knows_tip() const {
    return known_[0] == Known::yes && known_[1] == Known::yes && known_[2] == Known::yes;
}

void Path::put(Vec3 tip_in_frame, std::array<Known, 3> known, int line) {
    place_mm_ = parallel_mm_ + frame.in_stock(tip_in_frame);
    known_ = known;
    for (const Known k : known) {
        if (k == Known::lost) lost_line_ = line;
    }
}

void Path::lose(int line) {
    known_ = {Known::lost, Known::lost, Known::lost};
    lost_line_ = line;
}

Result<void> Path::place_parallel(int axis, double mm, Place place) {
    const std::string letter(1, "UVW"[axis]);
    if (mm == parallel_mm_[axis]) return {};
    const bool is_straight = frame.x == Vec3{1, 0, 0} && frame.z == Vec3{0, 0, 1};
    if (!is_straight || tip_control || roll_) {
        return refuse(place, letter + " moves beside turned, tilted or rolled coordinates: that is not read",
                      "let the CAM system write the path with X, Y and Z");
    }
    if (auto good = in_range(kLimits.coordinate, mm, place); !good) return good;
    if (!std::exchange(has_parallel_[static_cast<std::size_t>(axis)], true)) {
        warn(place.line, letter + " is taken as an axis parallel to " + "XYZ"[axis] +
                             ": the tip stands at the sum of both, and " + letter + " starts at 0");
    }
    const double way_mm = mm - std::exchange(parallel_mm_[axis], mm);
    if (!knows_tip()) place_mm_[axis] += way_mm;
    return {};
}

bool Path::first(int note) {
    return !std::exchange(noted_[static_cast<std::size_t>(note)], true);
}

void Path::warn(int line, std::string text) {
    program.warnings.push_back({options.source_name, line, std::move(text)});
}

std::unexpected<Error> Path::refuse(Place place, std::string cause, std::string remedy) const {
    return fail_at(options.source_name, place.line, place.column, std::move(cause), std::move(remedy));
}

Result<void> Path::in_range(const Limit& limit, double value, Place place) const {
    if (limit.range.contains(value)) return {};
    return refuse(place, out_of_range(limit, value), range_remedy(limit));
}

void Path::note_machine_needed(int line, const std::string& what) {
    if (!program.has_rotary_words) program.first_rotary_line = line;
    if (!program.has_rotary_words && !machine)
        warn(line, what + " without a machine: its motion is left out");
    program.has_rotary_words = true;
}

Result<void> Path::append(const motion::Move& move) {
    if (moves >= options.max_moves)
        return refuse_more_moves(options.source_name, move.line, options.max_moves);
    ++moves;
    if (move.kind == motion::MoveKind::feed) notes.cut(move);
    if (sink_ != nullptr) {
        sink_->take(move);
    } else {
        program.moves.push_back(move);
    }
    return {};
}

Result<void> Path::move(motion::MoveKind kind, Vec3 to, const std::optional<motion::Arc>& arc, Vec3 to_rad,
                        Place place) {
    motion::Move move;
    move.kind = kind;
    move.start.tip_mm = place_mm_;
    move.end.tip_mm = parallel_mm_ + frame.in_stock(to);
    if (arc) {
        move.arc = arc;
        move.arc->centre_mm = parallel_mm_ + frame.in_stock(arc->centre_mm);
        move.arc->normal = frame.direction_in_stock(arc->normal);
    }
    move.start.axis = axis_;
    move.end.axis = aim_;
    move.spindle_rpm = spindle_rpm;
    move.tool = tool;
    move.line = place.line;
    const bool turns = to_rad != now_rad_;
    if (!arc && !turns && move.start == move.end) return {};
    // Datum shifts, planes and cycles add to the words of a block.
    for (int k = 0; k < 3; ++k) {
        if (auto good = in_range(kLimits.coordinate, move.end.tip_mm[k], place); !good) return good;
    }
    axis_ = aim_;
    if (kind == motion::MoveKind::feed) {
        if (!feed_mm_per_min) {
            return refuse(place, "a feed move before any F", "write F, or make it a rapid");
        }
        if (auto good = in_range(kLimits.feed, *feed_mm_per_min, place); !good) return good;
        move.feed_mm_per_min = *feed_mm_per_min;
        const double length = motion::path_length_mm(move);
        if (turns && !feed_on_part && (!in_stock() || length == 0))
            move.duration_s = turning_time_s(length, to_rad - now_rad_, move.feed_mm_per_min, rotary_feed);
    }
    if (roll_ && machine) return move_rolled(move, to_rad, place);
    const Vec3 from_rad = std::exchange(now_rad_, to_rad);
    place_mm_ = move.end.tip_mm;
    if (!machine) return append(move);
    if (!in_stock() && (machine->needs_tool_length(from_rad) || machine->needs_tool_length(to_rad))) {
        return refuse(place,
                      "where the tilted head of the machine " + machine->machine().name +
                          " brings the tip depends on the tool's length",
                      "add tool_length_mm, from the spindle nose to the tip, to the machine");
    }
    motion::MachineBlock block;
    block.tip_control = in_stock();
    block.start_mm = move.start.tip_mm;
    block.end_mm = move.end.tip_mm;
    block.arc = move.arc;
    block.start_rad = from_rad;
    block.end_rad = to_rad;
    return run_block(block, move, place);
}

Result<void> Path::run_block(const motion::MachineBlock& block, const motion::Move& like, Place place) {
    const auto* pieces = machine->run(block, like, options.max_moves - moves + 1);
    if (pieces == nullptr) return refuse(place, MachineRun::kTooManyPieces, MachineRun::kFewerPieces);
    for (const motion::Move& piece : *pieces) {
        if (auto done = append(piece); !done) return done;
    }
    return {};
}

motion::ToolPose Path::pose_in_stock() const {
    if (!machine) return {place_mm_, axis_};
    motion::MachineBlock block;
    block.tip_control = in_stock();
    block.start_mm = block.end_mm = linear_at(place_mm_);
    block.start_rad = block.end_rad = rotary_at(place_mm_, now_rad_);
    return motion::pose_at(machine->kinematics(), block, 0);
}

Result<void> Path::follow(const motion::BSpline<motion::HomogeneousPoint>& curve, Place place) {
    if (!feed_mm_per_min) return refuse(place, "a feed move before any F", "write F before it");
    if (roll_) return refuse(place, "a spline on a cylinder is not read", "write lines and circles");
    if (auto good = in_range(kLimits.feed, *feed_mm_per_min, place); !good) return good;
    const motion::ToolPose from = pose_in_stock();
    motion::BSplineMotion motion;
    motion.spline.degree = curve.degree;
    motion.spline.knots = curve.knots;
    for (const motion::HomogeneousPoint& p : curve.control) {
        place_mm_ = parallel_mm_ + frame.in_stock(p.point());
        for (int k = 0; k < 3; ++k) {
            if (auto good = in_range(kLimits.coordinate, place_mm_[k], place); !good) return good;
        }
        motion.spline.control.push_back(
            p.w * motion::displacement(motion::ToolPose{pose_in_stock().tip_mm, from.axis}));
    }
    motion::Move like;
    like.start = like.end = from;
    like.feed_mm_per_min = *feed_mm_per_min;
    like.spindle_rpm = spindle_rpm;
    like.tool = tool;
    like.line = place.line;
    std::vector<motion::Move> pieces;
    if (!motion::append_moves(motion, motion.start(), motion.end(), like, {}, options.max_moves - moves,
                              pieces))
        return refuse_more_moves(options.source_name, place.line, options.max_moves);
    if (pieces.empty()) return {};
    pieces.front().start = from;
    pieces.back().end = pose_in_stock();
    for (motion::Move& piece : pieces) {
        piece.start.turn_rad = piece.end.turn_rad = from.turn_rad;
        if (auto done = append(piece); !done) return done;
    }
    return {};
}

Result<void> Path::dwell(double seconds, Place place) {
    if (!knows_tip() || !(seconds > 0)) return {};
    if (auto good = in_range(kLimits.dwell, seconds, place); !good) return good;
    motion::Move move;
    move.kind = motion::MoveKind::dwell;
    const motion::ToolPose pose = pose_in_stock();
    move.start = move.end = pose;
    move.duration_s = seconds;
    move.spindle_rpm = spindle_rpm;
    move.tool = tool;
    move.line = place.line;
    return append(move);
}

void Path::declare(const motion::DeclaredTool& declared) {
    if (declared.length_mm) declared_lengths_mm_[declared.number] = *declared.length_mm;
    if (declaring_lines_.insert(declared.line).second) program.tools.push_back(declared);
}

std::optional<double> Path::tool_radius_mm(double unit_of_program_mm) const {
    const auto known = [&](int number) -> std::optional<double> {
        for (auto given = options.tools.rbegin(); given != options.tools.rend(); ++given) {
            if (given->number == number && given->diameter_mm > 0) return given->diameter_mm / 2;
        }
        return std::nullopt;
    };
    if (const auto given = known(tool)) return given;
    const auto declared = declared_radii_mm_.find(tool);
    if (declared != declared_radii_mm_.end()) return declared->second;
    if (const auto any = known(0)) return any;  // an unnumbered tool of the job stands for every one
    if (const auto diameter = notes.diameter_mm(tool, unit_of_program_mm)) return *diameter / 2;
    return std::nullopt;
}

double Path::clearing_radius_mm(double unit_of_program_mm, int line, double room_mm) {
    if (const auto radius = tool_radius_mm(unit_of_program_mm); radius && *radius > 0) return *radius;
    if (const auto diameter = notes.stated_diameter_mm(tool, unit_of_program_mm)) return *diameter / 2;
    const double assumed_mm = room_mm > 0 ? std::min(kAssumedRadiusMm, room_mm / 2) : kAssumedRadiusMm;
    if (assumed_radii_.insert(tool).second) {
        warn(line, "nothing states the radius of tool " + std::to_string(tool) + ": " +
                       short_decimal(assumed_mm) +
                       " mm are taken; give the tool to the job, or write a comment like (T1 D=10.)");
    }
    return assumed_mm;
}

int Path::flutes() const {
    const auto known = [](const auto& tools, int number) {
        for (auto entry = tools.rbegin(); entry != tools.rend(); ++entry) {
            if (entry->number == number && entry->flutes > 0) return entry->flutes;
        }
        return 0;
    };
    if (const int given = known(options.tools, tool); given > 0) return given;
    if (const int declared = known(program.tools, tool); declared > 0) return declared;
    return known(options.tools, 0);  // an unnumbered tool of the job stands for every one
}

void Path::change_tool(int number) {
    tool = number;
    notes.change(number);
    if (!machine) return;
    std::optional<double> length_mm;
    for (const auto* lengths : {&declared_lengths_mm_, &given_lengths_mm_}) {
        if (const auto known = lengths->find(tool); known != lengths->end()) length_mm = known->second;
    }
    machine->set_tool_length(length_mm);
}

void Path::finish_tools(double unit_of_program_mm) {
    for (motion::DeclaredTool& noted : notes.tools(unit_of_program_mm, program.source, program.warnings)) {
        program.tools.push_back(std::move(noted));
    }
}

void Path::switch_tip_control(bool on, int line) {
    if (on == tip_control) return;
    const bool was_in_stock = in_stock();
    tip_control = on;
    if (!machine || in_stock() == was_in_stock) return;
    if (!knows_tip() || machine->needs_tool_length(now_rad_)) {
        if (now_rad_ != Vec3{}) lose(line);
        return;
    }
    const Vec3 zero = machine->kinematics().stock_mm();
    place_mm_ = on ? machine->kinematics().pose({place_mm_ + zero, now_rad_}).tip_mm
                   : machine->kinematics().with_tip(place_mm_, now_rad_).linear_mm - zero;
}

bool Path::tilt(const motion::WorkFrame& plane, bool keep_tip, int line, const std::optional<Vec3>& to_rad) {
    if (plane.is_tilted() && parallel_mm_ != Vec3{}) warn(line, MachineRun::kParallelInTiltedPlane);
    if (!machine) {
        const bool turns = distance(axis_, plane.z) > 1e-12;
        frame = plane;
        axis_ = aim_ = plane.z;
        if (turns && !keep_tip) lose(line);
        return true;
    }
    const motion::Kinematics& kinematics = machine->kinematics();
    Vec3 turned_rad;
    if (to_rad) {
        turned_rad = *to_rad;
    } else {
        const auto reached = kinematics.joints({{}, plane.z}, {{}, now_rad_});
        if (!reached) return false;
        turned_rad = reached->joints.rotary_rad;
    }
    const bool known =
        knows_tip() && !machine->needs_tool_length(now_rad_) && !machine->needs_tool_length(turned_rad);
    motion::Joints joints{place_mm_ + kinematics.stock_mm(), now_rad_};
    if (in_stock()) joints = kinematics.with_tip(place_mm_, now_rad_);
    const Vec3 tip = kinematics.pose(joints).tip_mm;
    if (!keep_tip) joints.rotary_rad = turned_rad;
    const Vec3 swung = kinematics.pose(joints).tip_mm;
    now_rad_ = turned_rad;
    frame = plane;
    if (!known && !(keep_tip && in_stock() && knows_tip())) {
        lose(line);
        return true;
    }
    place_mm_ = keep_tip ? tip : swung;
    if (!in_stock()) {
        place_mm_ = kinematics.with_tip(place_mm_, now_rad_).linear_mm - kinematics.stock_mm();
    }
    return true;
}

}  // namespace tribo::readers::control

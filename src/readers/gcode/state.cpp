// SPDX-License-Identifier: MIT
#include "readers/gcode/state.hpp"

#include <utility>

#include "base/math.hpp"
#include "readers/gcode/text/lexer.hpp"

namespace tribo::readers::gcode {

Vec3 turned(Vec3 v, double degrees) {
    if (degrees == 0) return v;
    double sine = 0, cosine = 0;
    math::sincos(degrees * math::kRadPerDeg, sine, cosine);
    return {cosine * v.x - sine * v.y, sine * v.x + cosine * v.y, v.z};
}

motion::Move turned(const motion::Move& move, double degrees) {
    motion::Move result = move;
    for (motion::ToolPose* pose : {&result.start, &result.end}) {
        pose->tip_mm = turned(pose->tip_mm, degrees);
        pose->axis = turned(pose->axis, degrees);
    }
    if (result.arc) {
        result.arc->centre_mm = turned(result.arc->centre_mm, degrees);
        result.arc->normal = turned(result.arc->normal, degrees);
    }
    if (result.quadratic) {
        result.quadratic->tip_control_mm = turned(result.quadratic->tip_control_mm, degrees);
        result.quadratic->axis_control = turned(result.quadratic->axis_control, degrees);
    }
    return result;
}

Result<void> Output::append(const motion::Move& move) {
    if (moves >= options.max_moves) return refuse_more_moves(move.line);
    ++moves;
    if (move.kind == motion::MoveKind::feed) {
        notes.cut(move);
        feeds = true;
    }
    if (sink_ != nullptr) {
        sink_->take(move);
    } else {
        program.moves.push_back(move);
    }
    return {};
}

std::optional<double> Output::tool_diameter_mm(int number, double unit_of_program_mm) const {
    for (const auto& [tools, wanted] :
         {std::pair{&given_, number}, std::pair{&given_, 0}, std::pair{&declared_, number}}) {
        if (const auto tool = tools->find(wanted); tool != tools->end()) return tool->second.diameter_mm;
    }
    return notes.diameter_mm(number, unit_of_program_mm);
}

bool Output::is_diameter_of_text(int number, double unit_of_program_mm) const {
    return !given_.contains(number) && !given_.contains(0) && !declared_.contains(number) &&
           notes.diameter_mm(number, unit_of_program_mm);
}

std::optional<double> Output::tool_length_mm(int number) const {
    const auto tool = given_.find(number);
    return tool == given_.end() ? std::nullopt : tool->second.length_mm;
}

bool Output::writes_axis(std::size_t axis) {
    auto& known = writes_axis_[axis];
    if (!known) known = has_word(text, "XYZ"[axis]);
    return *known;
}

void Output::leave_out(int line, int lost_line) {
    if (left_out_++ != 0) return;
    left_out_line_ = line;
    left_out_since_ = lost_line;
}

void Output::finish() {
    if (left_out_ == 0) return;
    std::string text = "this move starts at a place that only the machine knows since line " +
                       std::to_string(left_out_since_) + ": it is left out, the path goes on from its end";
    if (left_out_ > 1) text += " (" + std::to_string(left_out_) + " such moves in all)";
    warn(left_out_line_, std::move(text));
}

void Output::warn(int line, std::string text) {
    // Loops may find ever new things to say.
    constexpr std::size_t most = 1000;
    if (program.warnings.size() > most) return;
    if (program.warnings.size() == most)
        text = "there are more than " + std::to_string(most) + " warnings: the others are not shown";
    program.warnings.push_back({options.source_name, line, std::move(text)});
}

std::unexpected<Error> Output::refuse(int line, int column, std::string cause, std::string remedy) const {
    return fail_at(options.source_name, line, column, std::move(cause), std::move(remedy));
}

std::unexpected<Error> Output::refuse_more_moves(int line) const {
    return readers::refuse_more_moves(options.source_name, line, options.max_moves);
}

}  // namespace tribo::readers::gcode

// SPDX-License-Identifier: MIT
#include "readers/tools/tool_notes.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "base/limits.hpp"
#include "readers/text/decimal_text.hpp"
#include "readers/text/text_lines.hpp"
#include "readers/tools/folded_text.hpp"
#include "readers/tools/tool_list.hpp"

namespace tribo::readers {
namespace {

// Diameters of two texts that differ by less are one, as 0.5 inch and 12.7 mm in few digits.
constexpr double kSameDiameter = 0.01;
// A program has no more warnings than this about its tools.
constexpr std::size_t kMostWarnings = 1000;
// An angle of a chamfer mill up to this is that of its side; a larger one is the full angle of its point.
constexpr double kLargestSideAngle = 45;

// What the second text adds to the first.
void add(ToolText& to, const ToolText& from) {
    if (!to.number) to.number = from.number;
    if (to.shape == ToolShape::unstated) to.shape = from.shape;
    to.names_tool = to.names_tool || from.names_tool;
    if (!to.diameter) to.diameter = from.diameter;
    if (!to.corner) to.corner = from.corner;
    if (!to.angle_deg) {
        to.angle_deg = from.angle_deg;
        to.is_taper_key = from.is_taper_key;
    }
    if (to.flutes == 0) to.flutes = from.flutes;
}

// Without its own unit a diameter is in that of the program: the ratio may be an inch.
bool are_same(const StatedLength& a, const StatedLength& b) {
    const double ratio = a.mm(1) / b.mm(1);
    const auto is_near = [&](double x) { return std::abs(ratio - x) <= kSameDiameter * x; };
    return is_near(1) || (a.unit_mm != b.unit_mm && (is_near(25.4) || is_near(1 / 25.4)));
}

std::string size_text(const StatedLength& length) {
    return short_decimal(length.value) + (length.unit_mm == 1 ? " mm" : length.unit_mm > 1 ? " in" : "");
}

}  // namespace

ToolSizes sizes_of(const ToolText& text, double unit_mm) {
    ToolSizes sizes;
    sizes.shape = text.shape;
    if (text.diameter) sizes.diameter_mm = text.diameter->mm(unit_mm);
    if (text.corner) sizes.corner_mm = text.corner->mm(unit_mm);
    sizes.edge_mm = text.height * unit_mm;
    sizes.flutes = text.flutes;
    const double angle = text.angle_deg.value_or(0);
    switch (text.shape) {
        case ToolShape::taper:
        case ToolShape::dovetail:
            sizes.taper_deg = angle;
            break;
        case ToolShape::chamfer:
            sizes.point_deg = text.is_taper_key || angle <= kLargestSideAngle ? 2 * angle : angle;
            break;
        default:
            sizes.point_deg = angle;
    }
    return sizes;
}

void ToolNotes::read(std::string_view text, int line, bool is_beside_change, std::optional<int> called_tool) {
    const auto at = static_cast<std::size_t>(std::max(line, 0));
    if (at >= lines_.size()) lines_.resize(at + 1);
    if (std::exchange(line_, line) != line) {
        is_read_ = lines_[at];
        is_taken_ = false;
        lines_[at] = true;
    }
    if (is_read_) return;
    for (const std::string_view part : texts_of_tools(text))
        is_taken_ = take(part, line, is_beside_change, called_tool) || is_taken_;
}

// Returns true if the text is about a tool.
bool ToolNotes::take(std::string_view text, int line, bool is_name, std::optional<int> called_tool) {
    Note note{read_tool_text(text, is_name), line};
    ToolText& tool = note.text;
    if (largest_number_ && tool.number > largest_number_) {
        tool.number.reset();
        tool.names_tool = true;
    }
    if (!tool.number && tool.names_tool && tool.diameter) tool.number = called_tool;
    // A line may hold several comments: the first one about a tool counts, and those with numbers.
    if (is_taken_ && !(tool.number && tool.diameter)) return false;
    if (tool.is_bare_size) {
        if (!std::exchange(expects_size_, false)) return false;
        tool.names_tool = true;
    }
    expects_size_ = tool.asks_for_size;
    if (keep_names(text, note)) return true;
    if (tool.number && tool.diameter && tool.is_number_of_library) return take_of_library(note);
    if (tool.number && tool.diameter) {
        attach(*tool.number, note);
        if (window_tool_ == *tool.number) window_has_note_ = true;
        return true;
    }
    // A shape or a diameter alone is part of a header of several lines: TOOL TYPE : .., TOOL DIA. : ..
    if (tool.number || (!tool.diameter && !tool.names_tool)) return false;
    if (tool.diameter && !tool.names_tool) return false;
    if (window_tool_ && !window_has_note_) {
        if (pending_) add(tool, pending_->text);
        pending_.reset();
        if (tool.describes_tool()) {
            attach(*window_tool_, note);
            window_has_note_ = true;
        } else {
            pending_ = note;
        }
        return true;
    }
    // Lines right behind each other that describe several tools are a list: none of them is the next tool's.
    const bool is_next = pending_ && note.line == pending_->line + 1 && pending_->text.describes_tool();
    const bool begins_list =
        is_next && tool.describes_tool() &&
        (tool.shape != pending_->text.shape || !are_same(*tool.diameter, *pending_->text.diameter));
    if (begins_list || (tool.describes_tool() && note.line == list_line_ + 1)) {
        list_line_ = note.line;
        pending_.reset();
        return true;
    }
    // Two shapes are two tools.
    const bool is_other = pending_ && tool.shape != ToolShape::unstated &&
                          pending_->text.shape != ToolShape::unstated && tool.shape != pending_->text.shape;
    if (pending_ && !is_other && !(tool.diameter && pending_->text.diameter)) add(tool, pending_->text);
    pending_ = note;
    return true;
}

// CAM systems may number their tools otherwise than the program: a text right behind a change is about that
// tool, and one alone before a change, too. Several at once are a list.
bool ToolNotes::take_of_library(const Note& note) {
    const Note* known = window_tool_ ? find(*window_tool_) : nullptr;
    const bool is_same = known != nullptr && are_same(*known->text.diameter, *note.text.diameter);
    if (window_tool_ && (!window_has_note_ || is_same || note.text.number == window_tool_)) {
        put_library_texts();
        attach(*window_tool_, note);
        window_has_note_ = true;
        return true;
    }
    if (of_library_.size() < kMostTools) of_library_.push_back(note);
    return true;
}

void ToolNotes::put_library_texts() {
    for (const Note& note : std::exchange(of_library_, {})) attach(*note.text.number, note);
}

// Keeps what the text says for the names in it. True if it is about a name in quotes and no number: no other
// tool is meant then.
bool ToolNotes::keep_names(std::string_view text, const Note& note) {
    if (!note.text.diameter) return false;
    const std::string all = folded(text);
    if (note.text.number && texts_of_numbers_.size() < kMostTools)
        texts_of_numbers_.emplace_back(*note.text.number, all);
    bool has_name = false;
    for (std::size_t open = all.find('"'); open != std::string::npos; open = all.find('"', open + 1)) {
        const std::size_t close = all.find('"', open + 1);
        const bool begins = open == 0 || is_blank(all[open - 1]) || all[open - 1] == '=';
        if (close == std::string::npos || !begins || !is_letter(all[open + 1])) continue;
        has_name = true;
        if (named_.size() < kMostTools) named_.emplace(all.substr(open + 1, close - open - 1), note);
        open = close;
    }
    return has_name && !note.text.number;
}

std::optional<int> ToolNotes::number_of(std::string_view name) const {
    const std::string wanted = folded(name);
    if (wanted.empty()) return std::nullopt;
    const auto is_part = [](char c) { return is_letter(c) || is_digit(c) || c == '_' || c == '.'; };
    for (const auto& [number, text] : texts_of_numbers_) {
        for (std::size_t at = text.find(wanted); at != std::string::npos; at = text.find(wanted, at + 1)) {
            const std::size_t end = at + wanted.size();
            if ((at == 0 || !is_part(text[at - 1])) && (end == text.size() || !is_part(text[end])))
                return number;
        }
    }
    return std::nullopt;
}

void ToolNotes::name(int number, std::string_view name, int line) {
    if (const auto known = named_.find(folded(name)); known != named_.end()) {
        attach(number, known->second);
        return;
    }
    Note note{read_tool_text(name, true), line};
    if (note.text.diameter && !index_.contains(number)) attach(number, note);
}

void ToolNotes::change(int tool) {
    is_empty_ = tool == 0;
    empties_ = is_empty_ && has_changed_;
    window_has_note_ = false;
    if (is_empty_) {
        window_tool_.reset();
        return;
    }
    if (of_library_.size() == 1 && !index_.contains(tool)) of_library_[0].text.number = tool;
    put_library_texts();
    window_tool_ = tool;
    window_has_note_ = index_.contains(tool) && notes_[index_.at(tool)].second.text.is_number_of_library;
    has_changed_ = true;
    if (!pending_) return;
    if (pending_->text.describes_tool()) {
        attach(tool, *pending_);
        window_has_note_ = true;
    }
    pending_.reset();
}

void ToolNotes::cut(const motion::Move& move) {
    constexpr double aside = 1e-6;  // mm
    Use& use = uses_[move.tool];
    if (!use.mills) {
        const Vec3 way = move.end.tip_mm - move.start.tip_mm;
        const bool is_straight = !move.arc && !move.quadratic && move.start.axis == move.end.axis;
        const bool is_along = is_straight && length(cross(way, move.start.axis)) < aside;
        (is_along ? use.drills : use.mills) = true;
    }
    if (empties_ && cuts_empty_line_ == 0) cuts_empty_line_ = move.line;
    window_tool_.reset();
    if (std::exchange(is_empty_, false) && pending_ && pending_->text.describes_tool()) {
        attach(0, *pending_);
        pending_.reset();
    }
    if (has_changed_) pending_.reset();
}

void ToolNotes::attach(int tool, const Note& note) {
    const auto known = index_.find(tool);
    if (known == index_.end()) {
        if (notes_.size() == kMostTools) return;
        index_.emplace(tool, notes_.size());
        notes_.emplace_back(tool, note);
        return;
    }
    Note& first = notes_[known->second].second;
    if (are_same(*first.text.diameter, *note.text.diameter)) {
        add(first.text, note.text);
    } else if ((note.text.number || !first.text.number) && conflicts_.size() < kMostConflicts) {
        conflicts_.push_back({tool, first, note});
    }
}

const ToolNotes::Note* ToolNotes::find(int tool) const {
    const auto known = index_.find(tool);
    return known == index_.end() ? nullptr : &notes_[known->second].second;
}

std::optional<double> ToolNotes::diameter_mm(int tool, double unit_of_program_mm) const {
    const Note* note = find(tool);
    if (note == nullptr || !note->text.is_for_compensation) return std::nullopt;
    return note->text.diameter->mm(unit_of_program_mm);
}

int ToolNotes::line_of(int tool) const {
    const Note* note = find(tool);
    return note == nullptr ? 0 : note->line;
}

std::string ToolNotes::no_diameter_text(int tool, const char* size) const {
    const std::string number = std::to_string(tool);
    const Note* note = find(tool);
    if (note == nullptr) return "nothing states the " + std::string(size) + " of tool " + number;
    return "line " + std::to_string(note->line) + " gives tool " + number + " a diameter of " +
           size_text(*note->text.diameter) +
           ", but not whether the control compensates all of it or the wear alone";
}

std::string ToolNotes::diameter_comment(int tool) const {
    const Note* note = find(tool);
    return "(T" + std::to_string(tool) + " D=" + (note == nullptr ? "10." : size_text(*note->text.diameter)) +
           ")";
}

std::optional<double> ToolNotes::stated_diameter_mm(int tool, double unit_of_program_mm) const {
    const Note* note = find(tool);
    if (note == nullptr) return std::nullopt;
    return note->text.diameter->mm(unit_of_program_mm);
}

std::vector<motion::DeclaredTool> ToolNotes::tools(double unit_of_program_mm, const std::string& source,
                                                   Warnings& warnings) const {
    std::vector<motion::DeclaredTool> tools;
    const auto declare = [&](int number, Note note) {
        motion::DeclaredTool tool;
        std::string remark;
        tool.number = number;
        tool.line = note.line;
        const auto use = uses_.find(number);
        const bool drills = use != uses_.end() && use->second.drills && !use->second.mills;
        if (drills && note.text.shape == ToolShape::unstated &&
            !(note.text.corner && note.text.corner->value > 0)) {
            note.text.shape = ToolShape::drill;
            remark = "the tool only moves along its axis, and no shape is stated: it is taken as a drill";
        }
        ToolSizes sizes = sizes_of(note.text, unit_of_program_mm);
        const bool has_unit = note.text.diameter->unit_mm > 0;
        if (!has_unit && sizes.diameter_mm > kLimits.cutter_diameter.range.max) {
            // Names of tools count millimetres in programs in inches too.
            sizes = sizes_of(note.text, 1);
            remark += remark.empty() ? "" : "; ";
            remark += "the diameter is taken in mm: in the unit of the program no tool is so large";
        }
        if (set_shape(tool, sizes, remark)) {
            if (!remark.empty() && warnings.size() < kMostWarnings)
                warnings.push_back({source, note.line, "T" + std::to_string(number) + ": " + remark});
            tools.push_back(std::move(tool));
        } else {
            warnings.push_back({source, note.line,
                                "T" + std::to_string(number) + " is not taken from this text: " + remark});
        }
    };
    std::set<int> numbers;
    for (const auto& [number, note] : notes_) {
        declare(number, note);
        numbers.insert(number);
    }
    for (const Note& note : of_library_) {
        if (numbers.insert(*note.text.number).second) declare(*note.text.number, note);
    }
    if (!has_changed_ && pending_ && pending_->text.describes_tool() && !index_.contains(0))
        declare(0, *pending_);
    if (cuts_empty_line_ != 0 && !index_.contains(0)) {
        warnings.push_back({source, cuts_empty_line_,
                            "T0 has put the tool away, and a feed move follows: it is milled all the same, "
                            "as if a tool were in the spindle"});
    }
    std::set<int> said;
    for (const Conflict& conflict : conflicts_) {
        if (!said.insert(conflict.tool).second) continue;
        const std::string name = "T" + std::to_string(conflict.tool);
        warnings.push_back(
            {source, conflict.second.line,
             name + " has a diameter of " + size_text(*conflict.second.text.diameter) + " here, and of " +
                 size_text(*conflict.first.text.diameter) + " on line " +
                 std::to_string(conflict.first.line) +
                 ": the first counts for the whole program; give each tool a number of its own"});
    }
    return tools;
}

}  // namespace tribo::readers

// SPDX-License-Identifier: MIT
// Tools, and the variables of the control.
#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "readers/siemens/interpreter.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers::siemens {
namespace {

// Variables that say how the control runs the program: as it usually does.
constexpr std::string_view kZero[] = {"P_SEARCH", "P_SEARCHL", "P_SIM",  "P_ISTEST", "P_DRYRUN",
                                      "P_ISVAR",  "AC_ASUP",   "P_TEST", "P_SMTEST"};

int whole_at(const std::vector<Value>& index, std::size_t i) {
    const double* number = i < index.size() ? std::get_if<double>(&index[i]) : nullptr;
    if (number == nullptr || !std::isfinite(*number)) return -1;
    return static_cast<int>(std::clamp(*number, -1.0, 1e9));
}

// Behind the value that the cursor is at: to the next `$...=` of the block, or to its end.
void skip_to_next_setting(Cursor& in) {
    char last = '=';  // the last character but blanks
    for (; in.at < in.line.size(); ++in.at) {
        const char c = in.line[in.at];
        if (c == '$' && (is_letter(last) || is_digit(last) || last == ')' || last == ']' || last == '"'))
            return;
        if (!is_blank(c)) last = c;
    }
}

}  // namespace

// Finds the numbers that tools have in the text, so that named tools get others; and whether M6 changes them.
void Interpreter::number_tools() {
    for (std::size_t i = 0; i < text_.size(); ++i) {
        const std::string_view code = code_of(text_.line(i));
        bool is_quoted = false;
        for (std::size_t k = 0; k < code.size(); ++k) {
            if (code[k] == '"') is_quoted = !is_quoted;
            const char letter = to_upper(code[k]);
            if (is_quoted || (letter != 'T' && letter != 'M')) continue;
            if (k > 0 && is_name_character(code[k - 1]) && !is_digit(code[k - 1])) continue;
            std::size_t at = k + 1;
            while (at < code.size() && (is_blank(code[at]) || code[at] == '=')) ++at;
            std::size_t end = at;
            while (end < code.size() && is_digit(code[end])) ++end;
            const auto number = number_of(code.substr(at, end - at));
            if (!number || (end < code.size() && is_name_character(code[end]) && !is_letter(code[end])))
                continue;
            if (letter == 'T' && *number >= 1 && *number < 1e9) {
                numbered_tools_.insert(static_cast<int>(*number));
            }
            changes_with_m6_ = changes_with_m6_ || (letter == 'M' && *number == 6);
        }
    }
}

// T="NAME" and T=R1; the cursor is behind the '='.
Result<void> Interpreter::choose_tool(Cursor& in, std::size_t at, Words& words) {
    const auto value = Formula(in, variables_, *this).value();
    if (!value) return std::unexpected(value.error());
    if (const double* number = std::get_if<double>(&*value)) {
        return take_address(in, "T", {*number, Measure::modal, static_cast<int>(at) + 1}, words);
    }
    const std::string& name = std::get<std::string>(*value);
    const auto number = number_of(trimmed(name));
    const bool is_number = number && *number >= 1 && *number < 1e9 && *number == std::floor(*number);
    words.tool = is_number ? *number : trimmed(name).empty() ? 0 : number_of_tool(name);
    return {};
}

// Returns the number that stands for a tool's name.
int Interpreter::number_of_tool(const std::string& name) {
    const auto known = named_tools_.find(name);
    if (known != named_tools_.end()) return known->second;
    // That of the text with its name, else one that nothing has.
    const auto stated = path_.notes.number_of(name);
    int number = stated.value_or(1);
    while (!stated && (numbered_tools_.contains(number) || path_.notes.has(number))) ++number;
    numbered_tools_.insert(number);
    named_tools_[name] = number;
    std::string shown;
    for (const char c : name.substr(0, 40)) shown += c < ' ' || c > '~' ? '?' : c;
    path_.notes.name(number, name, line_number());
    path_.warn(line_number(), "the tool \"" + shown + "\" counts as tool " + std::to_string(number) +
                                  ": give it this number in the job");
    return number;
}

void Interpreter::load_tool(int number) {
    path_.change_tool(number);
}

// Comments, MSG("...") and (texts of other dialects) may describe tools.
void Interpreter::read_notes(std::string_view text, std::string_view code) {
    if (code.size() < text.size()) path_.notes.read(text.substr(code.size() + 1), line_number());
    const std::size_t message = code.find("MSG");
    const std::size_t open = message == std::string_view::npos ? message : code.find('"', message);
    if (open != std::string_view::npos) {
        const std::string_view inside = code.substr(open + 1);
        path_.notes.read(inside.substr(0, inside.find('"')), line_number());
    }
}

// $TC_DP6[1,1]=5; the cursor is at the '$'.
Result<void> Interpreter::assign_system(Cursor& in) {
    const std::size_t at = in.at;
    while (in.peek() == '$') ++in.at;
    const std::string name = name_at(in);
    in.at += name.size();
    std::vector<Value> index;
    if (in.peek_after_blanks() == '[') {
        ++in.at;
        auto found = Formula(in, variables_, *this).indices();
        if (!found) return std::unexpected(found.error());
        index = *std::move(found);
    }
    if (in.peek_after_blanks() != '=') return in.refuse(at, "$" + name + " without '='", "write its value");
    ++in.at;
    if (is_frame(name) || name.ends_with("FRAME")) return assign_frame(name, index, at, in);
    const bool is_tool = name == "TC_DP3" || name == "TC_DP6" || name == "TC_DP7";
    if (!is_tool || index.size() != 2 || whole_at(index, 1) != 1) {
        skip_to_next_setting(in);
        if (passed_over_.insert(name).second) {
            path_.warn(line_number(), "$" + name.substr(0, 31) +
                                          " is a setting of the machine: it is taken not to move the tool");
        }
        return {};
    }
    const auto value = Formula(in, variables_, *this).number();
    if (!value) return std::unexpected(value.error());
    const int number = whole_at(index, 0);
    ToolData& data = tool_data_[number];
    (name == "TC_DP3" ? data.length_mm : name == "TC_DP6" ? data.radius_mm : data.corner_mm) = *value;
    if (number < 1 || !kLimits.cutter_diameter.range.contains(2 * data.radius_mm)) return {};
    motion::DeclaredTool tool;
    tool.line = line_number();
    tool.number = number;
    tool.diameter_mm = 2 * data.radius_mm;
    if (data.corner_mm > 0 && data.corner_mm <= data.radius_mm) tool.corner_mm = data.corner_mm;
    if (data.length_mm > 0 && kLimits.tool_length.range.contains(data.length_mm))
        tool.length_mm = data.length_mm;
    path_.define_radius(number, data.radius_mm);
    const auto declared = std::ranges::find(path_.program.tools, number, &motion::DeclaredTool::number);
    if (declared == path_.program.tools.end()) {
        path_.declare(tool);
    } else {
        tool.line = declared->line;
        *declared = tool;
    }
    return {};
}

// WORKPIECE(, "", , "BOX", 112, Z0, Z1, ZB, X0, Y0, X1, Y1): 112 says that Z1, X1 and Y1 are absolute. Other
// blanks and increments are left to the job. Without values it ends the display of a blank.
Result<void> Interpreter::declare_stock(const Call& call) {
    constexpr double kAbsolute = 112;
    constexpr std::size_t kZ0 = 5, kZ1 = 6, kX0 = 8;
    if (call.given.empty()) return {};
    // 0: the far corner counts from the near one.
    const bool is_absolute = call.at(4) == kAbsolute;
    const bool is_box = call.text(3) == "BOX" && (is_absolute || call.at(4) == 0) && call.has(kZ1);
    Box3 box;
    if (is_box) {
        for (const std::size_t corner : {std::size_t{0}, std::size_t{1}}) {
            Vec3 point{call.at(kX0 + 2 * corner), call.at(kX0 + 1 + 2 * corner),
                       call.at(corner == 0 ? kZ0 : kZ1)};
            if (corner == 1 && !is_absolute) point += Vec3{call.at(kX0), call.at(kX0 + 1), call.at(kZ0)};
            box.include(unit_mm_ * point);
        }
    }
    if (!is_box || !(box.volume() > 0)) {
        if (path_.first(kOtherStock))
            path_.warn(call.line,
                       "this WORKPIECE is no box whose corners are read: the stock is taken from the job");
        return {};
    }
    path_.program.stock = motion::DeclaredStock{box, call.line};
    return {};
}

std::optional<Value> Interpreter::system_value(const std::string& name,
                                               const std::vector<Value>& index) const {
    if (name == "PI") return Value{math::kPi};
    if (name == "P_TOOLNO") return Value{static_cast<double>(path_.tool)};
    if (name == "P_TOOL") return Value{1.0};
    if (name == "P_TOOLR") {
        const auto radius = path_.tool_radius_mm(unit_mm_);
        if (!radius) return std::nullopt;
        return Value{*radius / unit_mm_};
    }
    if (name == "TC_DP6" || name == "TC_DP3" || name == "TC_DP7") {
        const auto data = tool_data_.find(whole_at(index, 0));
        if (data == tool_data_.end()) return std::nullopt;
        return Value{name == "TC_DP3"   ? data->second.length_mm
                     : name == "TC_DP6" ? data->second.radius_mm
                                        : data->second.corner_mm};
    }
    if (name == "P_F" && path_.feed_mm_per_min) return Value{*path_.feed_mm_per_min / unit_mm_};
    if (name == "P_S") return Value{path_.spindle_rpm};
    if (name == "AA_IW" || name == "P_EP" || name == "P_EPM") {
        const std::string axis = index.empty() ? "" : text_of(index[0]);
        const std::size_t k =
            axis.size() == 1 ? std::string_view("XYZ").find(axis[0]) : std::string_view::npos;
        if (k > 2 || path_.known(static_cast<int>(k)) != Known::yes) return std::nullopt;
        return Value{from_frame(here())[static_cast<int>(k)] / unit_mm_};
    }
    if (name == "MN_SCALING_SYSTEM_IS_METRIC") return Value{1.0};
    if (std::find(std::begin(kZero), std::end(kZero), name) != std::end(kZero)) return Value{0.0};
    return std::nullopt;
}

}  // namespace tribo::readers::siemens

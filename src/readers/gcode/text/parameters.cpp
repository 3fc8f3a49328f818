// SPDX-License-Identifier: MIT
#include "readers/gcode/text/parameters.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/math.hpp"
#include "readers/gcode/state.hpp"
#include "readers/gcode/text/fanuc_variables.hpp"

namespace tribo::readers::gcode {
namespace {

// Numbers of the parameters with the state of the control in LinuxCNC.
constexpr int kFirstProbe = 5061, kLastProbe = 5070;
constexpr int kPresetOn = 5210, kFirstPreset = 5211;
constexpr int kActiveWork = 5220, kFirstOrigin = 5221, kLastWork = 5390, kOriginStep = 20;
constexpr int kWorkTurn = 9;  // after the nine axes of a work system
constexpr int kInput = 5399;
constexpr int kFirstState = 5400, kLastState = 5428;
constexpr int kTool = 5400, kToolDiameter = 5410, kFirstPosition = 5420;
constexpr int kAxes = 9;  // x y z a b c u v w

std::string shown(int number) {
    return "#" + std::to_string(number);
}

int motion_parameter(const State& state) {
    switch (state.motion) {
        case MotionMode::rapid:
            return 0;
        case MotionMode::line:
            return 10;
        case MotionMode::arc_clockwise:
            return 20;
        case MotionMode::arc_counter_clockwise:
            return 30;
        default:
            return state.motion == MotionMode::cycle ? state.cycle.tenths : 800;
    }
}

int work_code(const State& state) {
    if (state.active_work >= kWorkSystems) return 541;
    return state.active_work < 6 ? 540 + 10 * state.active_work : 586 + state.active_work - 1;
}

struct Shown {
    std::string_view name;
    double (*value)(const State&);
};
// Sorted by name.
constexpr Shown kShown[] = {
    {"_absolute", [](const State& s) { return s.incremental ? 0.0 : 1.0; }},
    {"_ccomp", [](const State& s) { return s.compensation_code(); }},
    {"_coord_system", [](const State& s) { return static_cast<double>(work_code(s)); }},
    {"_current_tool", [](const State& s) { return static_cast<double>(s.tool()); }},
    {"_feed",
     [](const State& s) {
         const bool is_length = s.feed_mode != FeedMode::inverse_time;
         return s.feed.value_or(0) / (is_length ? s.unit_mm : 1);
     }},
    {"_imperial", [](const State& s) { return s.unit_mm == 1 ? 0.0 : 1.0; }},
    {"_incremental", [](const State& s) { return s.incremental ? 1.0 : 0.0; }},
    {"_inverse_time", [](const State& s) { return s.feed_mode == FeedMode::inverse_time ? 1.0 : 0.0; }},
    {"_line", [](const State& s) { return static_cast<double>(s.line); }},
    {"_metric", [](const State& s) { return s.unit_mm == 1 ? 1.0 : 0.0; }},
    {"_motion_mode", [](const State& s) { return static_cast<double>(motion_parameter(s)); }},
    {"_plane",
     [](const State& s) { return s.plane == Plane::xy   ? 170.0
                                 : s.plane == Plane::zx ? 180.0
                                                        : 190.0; }},
    {"_rpm", [](const State& s) { return s.spindle_rpm; }},
    {"_selected_tool", [](const State& s) { return static_cast<double>(s.selected_tool); }},
    {"_spindle_cw", [](const State& s) { return s.spindle == Spindle::clockwise ? 1.0 : 0.0; }},
    {"_spindle_on", [](const State& s) { return s.spindle == Spindle::off ? 0.0 : 1.0; }},
    {"_task", [](const State&) { return 0.0; }},
    {"_units_per_minute", [](const State& s) { return s.feed_mode == FeedMode::per_minute ? 1.0 : 0.0; }},
    {"_units_per_rev", [](const State& s) { return s.feed_mode == FeedMode::per_turn ? 1.0 : 0.0; }},
    // The release of LinuxCNC whose documentation this reader follows.
    {"_vmajor", [](const State&) { return 2.9; }},
    {"_vminor", [](const State&) { return 0.0; }},
};

}  // namespace

Parameters::Parameters(State& state, Output& output) : state_(state), output_(output), frames_(1) {}

Result<double> Parameters::position(int axis) const {
    if (axis >= 3) return 0.0;
    if (state_.known[static_cast<std::size_t>(axis)] != Known::yes) {
        return fail(std::string("the parameter asks for ") + "XYZ"[axis] + ", which is not known here",
                    "move every axis to a stated place (G0) before it is read");
    }
    return state_.frame.written(state_.tip_mm - state_.origin_mm())[axis] / state_.unit_mm;
}

bool Parameters::is_fanuc() const {
    return output_.options.dialect == GcodeDialect::fanuc;
}
double Parameters::round_to(char letter) const {
    constexpr std::string_view kCoordinates = "ABCIJKQRUVWXYZ";
    if (!is_fanuc() || !kCoordinates.contains(letter)) return 1;
    const bool is_angle = letter >= 'A' && letter <= 'C';
    return state_.unit_mm == 1 || is_angle ? 1e-3 : 1e-4;
}
int Parameters::first() const {
    return is_fanuc() ? 0 : 1;
}
int Parameters::last() const {
    return is_fanuc() ? kLastFanucParameter : kLastParameter;
}

// Returns the variable of the call, if it is one of those.
const double* Parameters::local(int number) const {
    const Frame& frame = frames_.back();
    if (frames_.size() == 1 || number > frame.locals) return nullptr;
    return &frame.numbers[static_cast<std::size_t>(number - 1)];
}
double* Parameters::local(int number) {
    return const_cast<double*>(std::as_const(*this).local(number));
}

Result<double> Parameters::get(int number) const {
    if (number == 0 && is_fanuc()) return std::numeric_limits<double>::quiet_NaN();
    if (number < 1 || number > last()) {
        return fail(shown(number) + " is no parameter: they run from #1 to #" + std::to_string(last()),
                    "correct the number");
    }
    if (const double* value = local(number)) return *value;
    const auto index = static_cast<std::size_t>(number);
    const bool is_assigned = !numbers_.empty() && numbers_[index];
    if (is_fanuc()) return is_assigned ? *numbers_[index] : get_fanuc(number);
    if (number >= kFirstPosition && number < kFirstPosition + kAxes) {
        return position(number - kFirstPosition);
    }
    if (number == kTool) return state_.tool();
    if (number == kToolDiameter) {
        const auto diameter = output_.tool_diameter_mm(state_.tool(), state_.unit_mm);
        return diameter.value_or(0) / state_.unit_mm;
    }
    if (number >= kFirstState && number <= kLastState) return 0.0;
    if (number == kPresetOn) return state_.preset_on ? 1.0 : 0.0;
    if (number == kActiveWork) return state_.active_work + 1;
    if (number >= kFirstPreset && number < kFirstPreset + kAxes) {
        const int axis = number - kFirstPreset;
        return axis < 3 ? state_.preset_mm[axis] / state_.unit_mm : 0;
    }
    if (number >= kFirstOrigin && number <= kLastWork && (number - kFirstOrigin) % kOriginStep <= kWorkTurn) {
        const WorkSystem& work = state_.work[static_cast<std::size_t>((number - kFirstOrigin) / kOriginStep)];
        const int axis = (number - kFirstOrigin) % kOriginStep;
        if (axis == kWorkTurn) return work.turn_deg;
        return axis < 3 ? work.origin_mm[axis] / state_.unit_mm : 0;
    }
    const bool is_measured = (number >= kFirstProbe && number <= kLastProbe) || number == kInput;
    if (is_measured && !is_assigned) {
        return fail(shown(number) + " holds what a probe or an input has measured, which nobody knows here",
                    "assign it before it is read");
    }
    if (is_assigned) return *numbers_[index];
    if (output_.first(Note::unassigned_parameter)) {
        output_.warn(state_.line, shown(number) + " has no value so far: 0 is taken");
    }
    return 0.0;
}

// An unassigned variable of a Fanuc control.
Result<double> Parameters::get_fanuc(int number) const {
    if (!is_common(number)) {
        for (const int first : {kFirstBlockEnd, kFirstPlace}) {
            if (number >= first && number < first + 3) return position(number - first);
        }
        if (const auto value = fanuc_system_variable(number, state_)) return *value;
        if (is_timer(number)) {
            if (output_.first(Note::tool_timer)) {
                output_.warn(state_.line,
                             shown(number) + " is a timer or a clock of the control: 0 is taken");
            }
            return 0.0;
        }
        return fail(shown(number) + " shows a state of the control that nobody knows here",
                    "assign it before it is read, or let the control expand the macro");
    }
    if (output_.first(Note::unassigned_parameter)) {
        output_.warn(state_.line,
                     shown(number) + " has no value so far: a word with it is left out, in formulas it is 0");
    }
    return std::numeric_limits<double>::quiet_NaN();
}

std::optional<double> Parameters::shown_by_control(std::string_view name) const {
    const auto* const found =
        std::lower_bound(std::begin(kShown), std::end(kShown), name,
                         [](const Shown& shown, std::string_view wanted) { return shown.name < wanted; });
    if (found != std::end(kShown) && found->name == name) return found->value(state_);
    if (name == "_value") return returned_.value_or(0);
    if (name == "_value_returned") return returned_ ? 1 : 0;
    if (name == "_call_level") return static_cast<double>(frames_.size() - 1);
    return std::nullopt;
}

std::optional<double> Parameters::assigned(std::string_view name) const {
    const Names& names = name.starts_with('_') ? global_names_ : frames_.back().names;
    const auto found = names.find(name);
    if (found == names.end()) return std::nullopt;
    return found->second;
}

bool Parameters::exists(std::string_view name) const {
    return assigned(name) || shown_by_control(name) || name == "_x" || name == "_y" || name == "_z";
}

Result<double> Parameters::get(std::string_view name) const {
    if (const auto value = assigned(name)) return *value;
    if (const auto value = shown_by_control(name)) return *value;
    if (name.size() == 2 && name[0] == '_' && name[1] >= 'x' && name[1] <= 'z')
        return position(name[1] - 'x');
    const std::string text = "#<" + std::string(name) + ">";
    if (name.starts_with("_ini[") || name.starts_with("_hal[")) {
        return fail(text + " is a setting of one machine, which a program does not tell",
                    "assign a number to a parameter of your own");
    }
    return fail(text + " has no value",
                name.starts_with('_')
                    ? "assign it before it is read"
                    : "assign it before it is read; names without '_' are known only in the "
                      "subroutine that assigned them");
}

Result<void> Parameters::set(int number, double value) {
    if (number < 1 || number > last()) {
        return fail(
            shown(number) + " cannot be assigned: parameters run from #1 to #" + std::to_string(last()),
            "correct the number");
    }
    if (double* place = local(number)) {
        *place = value;
        return {};
    }
    if (is_fanuc() && !is_common(number)) {
        const auto is_set = set_fanuc_system_variable(number, std::isnan(value) ? 0 : value, state_);
        if (!is_set) return std::unexpected(is_set.error());
        if (*is_set) return {};
    }
    if (output_.options.dialect == GcodeDialect::linuxcnc) {
        const bool is_offset = number >= kPresetOn && number <= kLastWork;
        if (is_offset) {
            return fail(shown(number) + " holds an offset, which is not read as an assignment",
                        "use G10 L2 for work systems and G92 or G52 for the rest");
        }
        if (number >= kFirstState && number <= kLastState) {
            return fail(shown(number) + " shows the state of the control and cannot be assigned",
                        "use another number");
        }
    }
    if (numbers_.empty()) numbers_.resize(static_cast<std::size_t>(last()) + 1);
    auto& place = numbers_[static_cast<std::size_t>(number)];
    place.reset();
    if (!std::isnan(value)) place = value;
    return {};
}

Result<void> Parameters::set(std::string_view name, double value) {
    if (shown_by_control(name)) {
        return fail("#<" + std::string(name) + "> shows the state of the control and cannot be assigned",
                    "use another name");
    }
    Names& names = name.starts_with('_') ? global_names_ : frames_.back().names;
    if (const auto found = names.find(name); found != names.end()) {
        found->second = value;
    } else {
        names.emplace(name, value);
    }
    return {};
}

void Parameters::enter(std::span<const double> arguments) {
    Frame& frame = frames_.emplace_back();
    const std::size_t count = std::min<std::size_t>(arguments.size(), kLocalParameters);
    std::copy_n(arguments.begin(), count, frame.numbers.begin());
}

void Parameters::enter_macro(const std::array<double, kMacroParameters>& arguments) {
    frames_.push_back({arguments, kMacroParameters, {}});
}

void Parameters::leave() {
    if (frames_.size() > 1) frames_.pop_back();
}

}  // namespace tribo::readers::gcode

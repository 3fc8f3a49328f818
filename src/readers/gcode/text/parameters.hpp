// SPDX-License-Identifier: MIT
// The variables of a program: #1 to #5602 and #<names>, the local variables of a subroutine call, and
// variables that show the state of the control (#5420, #<_x>, ...). Numbers and names are those of LinuxCNC;
// in the Fanuc dialect those of a Fanuc control (fanuc_variables.hpp), where an unassigned variable is
// vacant: not a number. Lengths are in the unit in force.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"

namespace tribo::readers::gcode {

struct State;
class Output;

inline constexpr int kLastParameter = 5602;
inline constexpr int kLastFanucParameter = 99'999;
inline constexpr int kLocalParameters = 30;  // #1 to #30: the arguments of a call
inline constexpr int kMacroParameters = 33;  // #1 to #33: those of G65

class Parameters {
  public:
    // Reads and changes `state` and warns in `output`; both must outlive the object.
    Parameters(State& state, Output& output);

    // The range of numbers; 0 only of a Fanuc control, for what is always vacant.
    int first() const;
    int last() const;
    bool is_fanuc() const;
    // What ROUND in the value of a word rounds to: on Fanuc controls the least increment of a coordinate,
    // else 1.
    double round_to(char letter) const;
    // Errors have cause and remedy, but no place. An unassigned number reads as 0 (Fanuc: vacant), with a
    // warning; an unassigned name is refused.
    Result<double> get(int number) const;
    Result<double> get(std::string_view name) const;
    bool exists(std::string_view name) const;
    Result<void> set(int number, double value);
    Result<void> set(std::string_view name, double value);

    // Begins the variables of a subroutine: `arguments` in #1 and on, 0 in the others, no names.
    void enter(std::span<const double> arguments);
    // The same for G65: #1 to #33, vacant where not a number.
    void enter_macro(const std::array<double, kMacroParameters>& arguments);
    void leave();
    // Sets the values of #<_value> and #<_value_returned> after a call.
    void set_returned(std::optional<double> value) { returned_ = value; }

  private:
    using Names = std::map<std::string, double, std::less<>>;
    struct Frame {
        std::array<double, kMacroParameters> numbers{};
        int locals = kLocalParameters;
        Names names;
    };
    std::optional<double> assigned(std::string_view name) const;
    std::optional<double> shown_by_control(std::string_view name) const;
    Result<double> position(int axis) const;
    Result<double> get_fanuc(int number) const;
    double* local(int number);
    const double* local(int number) const;

    State& state_;
    Output& output_;
    std::vector<Frame> frames_;
    std::vector<std::optional<double>> numbers_;  // of the outermost level; empty until the first assignment
    Names global_names_;                          // names with a leading '_'
    std::optional<double> returned_;
};

}  // namespace tribo::readers::gcode

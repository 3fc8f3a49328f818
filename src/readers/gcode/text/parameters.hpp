// SPDX-License-Identifier: MIT
// The variables of a program: #1 to #5602 and #<names>, those local to a subroutine call, and those by which
// the control shows its own state (#5420, #<_x>, ...). Numbers and names are LinuxCNC's; lengths are in the
// unit in force.
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
inline constexpr int kLocalParameters = 30;  // #1 to #30: the arguments of a call

class Parameters {
  public:
    // Shows and changes `state` and warns in `output`; both must outlive it.
    Parameters(State& state, Output& output);

    // Errors have cause and remedy, but no place. A number that nothing has assigned reads as 0, with a
    // warning; a name that nothing has assigned is refused.
    Result<double> get(int number) const;
    Result<double> get(std::string_view name) const;
    bool exists(std::string_view name) const;
    Result<void> set(int number, double value);
    Result<void> set(std::string_view name, double value);

    // The variables of a subroutine: `arguments` in #1 and on, 0 in the rest, no names.
    void enter(std::span<const double> arguments);
    void leave();
    // What #<_value> and #<_value_returned> show after a call.
    void set_returned(std::optional<double> value) { returned_ = value; }

  private:
    using Names = std::map<std::string, double, std::less<>>;
    struct Frame {
        std::array<double, kLocalParameters> numbers{};
        Names names;
    };
    std::optional<double> assigned(std::string_view name) const;
    std::optional<double> shown_by_control(std::string_view name) const;
    Result<double> position(int axis) const;

    State& state_;
    Output& output_;
    std::vector<Frame> frames_;
    std::vector<std::optional<double>> numbers_;  // of the outermost level; empty until one is set
    Names global_names_;                          // those that start with '_'
    std::optional<double> returned_;
};

}  // namespace tribo::readers::gcode

// SPDX-License-Identifier: MIT
// The formulas of a program: (R1+2)*SIN(30), NAME[1,2], "T"<<R5, NOT (A==3). Operators bind as in the
// programming manual: NOT, * / DIV MOD, + -, B_AND, B_XOR, B_OR, AND, XOR, OR, <<, comparisons last.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "readers/gcode/cursor.hpp"
#include "readers/siemens/variables.hpp"

namespace tribo::readers::siemens {

// Answers for variables of the control ($P_TOOLR, $TC_DP6[1,1]).
class SystemValues {
  public:
    virtual ~SystemValues() = default;
    // None: only the machine knows it. Such a value is NaN until somebody needs it.
    virtual std::optional<Value> system_value(const std::string& name,
                                              const std::vector<Value>& index) const = 0;
};

class Formula {
  public:
    // The references must outlive the object. Reads on from the cursor.
    Formula(gcode::Cursor& in, Variables& variables, const SystemValues& system)
        : in_(in), variables_(variables), system_(system) {}

    Result<Value> value() { return comparison(0); }
    // The same, where an unknown name is that of an axis.
    Result<Value> value_or_name() {
        takes_names_ = true;
        return comparison(0);
    }
    // A finite number. A value that only the machine knows is refused.
    Result<double> number();
    Result<std::string> text();
    // Reads "[1,X]" after its bracket.
    Result<std::vector<Value>> indices(int depth = 0);
    // The element of a variable; refuses an index outside of it.
    Result<std::size_t> element(const Variable& variable, const std::vector<Value>& index,
                                std::size_t at) const;

  private:
    Result<Value> comparison(int depth);
    Result<Value> joined(int depth);
    Result<Value> binary(int level, int depth);
    Result<Value> unary(int depth);
    Result<Value> primary(int depth);
    Result<Value> quoted_number();
    Result<Value> named(int depth);
    Result<Value> function(const std::string& name, std::size_t at, int depth);
    Result<double> number_of(const Result<Value>& value, std::size_t at) const;
    std::optional<std::size_t> operator_at(int level);
    std::unexpected<Error> refuse(std::size_t at, std::string cause, std::string remedy) const {
        return in_.refuse(at, std::move(cause), std::move(remedy));
    }

    gcode::Cursor& in_;
    Variables& variables_;
    const SystemValues& system_;
    bool takes_names_ = false;  // an unknown name is that of an axis
    std::string unknown_;       // the last variable that only the machine knows
};

// The name at the cursor, in upper case: letters, digits and '_'. Empty if there is none.
std::string name_at(const gcode::Cursor& in);
// A character of a name.
bool is_name_character(char c);
// The text of a string in quotes at the cursor, which goes behind it.
Result<std::string> quoted(gcode::Cursor& in);
// A number as text: "12", "0.5".
std::string text_of(const Value& value);

}  // namespace tribo::readers::siemens

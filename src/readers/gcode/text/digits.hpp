// SPDX-License-Identifier: MIT
// Plain numbers and names in <> of a line of G-code.
#pragma once

#include <optional>
#include <string>

#include "base/result.hpp"
#include "readers/gcode/cursor.hpp"

namespace tribo::readers::gcode {

// Reads digits with at most one decimal point, without sign; blanks among them are allowed. Returns none if
// no digit or point is at the cursor. Errors have the column of `start`.
Result<std::optional<double>> read_digits(Cursor& cursor, std::size_t start);

// Reads the text between < and >, in lower case without blanks. The cursor must be on '<'.
Result<void> read_angled_name(Cursor& cursor, std::string& name);

}  // namespace tribo::readers::gcode

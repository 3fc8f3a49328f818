// SPDX-License-Identifier: MIT
// The doors by which a number comes in: each writes a value as a user would and hands the text to the reader
// that users' files go through.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/limits.hpp"

namespace tribo::test {

struct Door {
    const Limit* limit;
    std::string name;
    // The text of the error; empty: accepted.
    std::function<std::string(double value)> error_of;
    // What another rule says about an end of the range; empty: both ends are accepted.
    std::string other_rule{};
};
using Doors = std::vector<Door>;

// As people write it, without an exponent: G-code has none.
std::string written(double value);

Doors job_doors();
Doors program_doors();
Doors table_doors();
Doors material_doors();
Doors live_doors();
// Of the program's flags. Each call runs it.
Doors flag_doors();

}  // namespace tribo::test

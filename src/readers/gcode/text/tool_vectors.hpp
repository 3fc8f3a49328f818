// SPDX-License-Identifier: MIT
// Programs that write the tool's axis as I J K beside G0 and G1 without a code that says so. Any thread.
#pragma once

#include <string_view>

namespace tribo::readers::gcode {

// True if each block with I, J or K has all three of them beside X, Y or Z, of length 1, in three blocks or
// more, and no block has an arc, a cycle or another code that uses these words.
bool writes_tool_vectors(std::string_view bytes);

}  // namespace tribo::readers::gcode

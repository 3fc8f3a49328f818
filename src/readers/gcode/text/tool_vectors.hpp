// SPDX-License-Identifier: MIT
// Programs that write the tool's axis as I J K beside G0 and G1 without a code that says so. Any thread.
#pragma once

#include <string_view>

namespace tribo::readers::gcode {

enum class ToolVectors { none, to_shank, to_tip };

// Not none if each block with I, J or K has all three of them beside X, Y or Z, of length 1, in three blocks
// or more, and no block has an arc, a cycle or another code that uses these words. To the tip if K is never
// above 0: else the tool would stand under the table.
ToolVectors tool_vectors_of(std::string_view bytes);

}  // namespace tribo::readers::gcode

// SPDX-License-Identifier: MIT
// Texts that list several tools. Any thread; allocates.
#pragma once

#include <string_view>
#include <vector>

namespace tribo::readers {

// Returns the parts of a text that lists several tools, each with its number: "T1 D10 MILL, T2 = 6.6 DRILL"
// and "D10 MILL T1, 6.6 DRILL T2". Else the text alone.
std::vector<std::string_view> texts_of_tools(std::string_view text);

}  // namespace tribo::readers

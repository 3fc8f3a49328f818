// SPDX-License-Identifier: MIT
// The unit of a program that does not state one, by its texts about tools. Any thread; allocates.
#pragma once

#include <string_view>

namespace tribo::readers::gcode {

// True if no block has G20, G21, G70 or G71, and texts about tools give diameters in inches (1/2 END MILL,
// .25" DRILL) and none in millimetres.
bool is_in_inches_by_texts(std::string_view bytes);

}  // namespace tribo::readers::gcode

// SPDX-License-Identifier: MIT
// Programs of Okuma OSP, Fagor 8055, NUM and Fadal controls in the words of a Fanuc control, line by line.
// What has no such word is left as it is, or made a word that the reader of G-code refuses by name.
#pragma once

#include <string>
#include <string_view>

#include "readers/control/other_control.hpp"

namespace tribo::readers {

// Has as many lines as the program.
std::string in_fanuc_words(std::string_view bytes, OtherControl control);

}  // namespace tribo::readers

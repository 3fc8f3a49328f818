// SPDX-License-Identifier: MIT
// Programs of Okuma OSP, Fagor 8055 and NUM controls in the words of a Fanuc control, line by line. What has
// no such word is left as it is, or made a word that the reader of G-code refuses by name.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace tribo::readers {

enum class OtherControl { okuma, fagor, num };

// "Okuma OSP", "Fagor 8055", "NUM".
std::string_view name_of(OtherControl control);

// Detects these controls from clear signs. Okuma: VC1=, CALL O, G15 H, NCYL, $NAME.MIN%. Fagor: %NAME,MX, and
// statements in brackets: (P1=..), (IF ..), (RPT ..), (SUB ..). NUM: G79 N, G77 H, cycles with ER.
std::optional<OtherControl> detect_other_control(std::string_view bytes);

// Has as many lines as the program.
std::string in_fanuc_words(std::string_view bytes, OtherControl control);

}  // namespace tribo::readers

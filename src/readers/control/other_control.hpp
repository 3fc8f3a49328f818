// SPDX-License-Identifier: MIT
// Controls whose programs are read in the words of another one (fanuc_words.hpp), and the signs of them.
#pragma once

#include <optional>
#include <string_view>

namespace tribo::readers {

enum class OtherControl { okuma, fagor, num, fadal };
inline constexpr int kOtherControls = 4;

// "Okuma OSP", "Fagor 8055", "NUM", "Fadal".
std::string_view name_of(OtherControl control);

// Detects these controls from clear signs. Okuma: VC1=, CALL O, G15 H, NCYL, $NAME.MIN%. Fagor: %NAME,MX, and
// statements in brackets: (P1=..), (IF ..), (RPT ..), (SUB ..). NUM: G79 N, G77 H, cycles with ER.
// Fadal: E1 beside X Y, and H1 beside Z without G43.
std::optional<OtherControl> detect_other_control(std::string_view bytes);

}  // namespace tribo::readers

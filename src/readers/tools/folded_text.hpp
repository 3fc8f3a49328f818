// SPDX-License-Identifier: MIT
// Texts of people in plain upper-case letters, so that words of several languages and encodings compare. Any
// thread; allocates.
#pragma once

#include <string>
#include <string_view>

namespace tribo::readers {

// Returns the text in ASCII capitals. UTF-8 and Latin-1 letters lose their accents (Fräser: FRASER). A
// diameter sign becomes DIA, a degree sign DEG, typographic inches and dashes the ASCII ones. Other
// characters become
// '?'.
std::string folded(std::string_view text);

}  // namespace tribo::readers

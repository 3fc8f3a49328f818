// SPDX-License-Identifier: MIT
// Programs of Fadal controls in their Format 1, in the words of a Fanuc control, line by line. What has no
// such word becomes a word that the reader of G-code refuses by name: GFADALL for an L.
//
// The meaning of the words is from memory and from programs of a shop: H with Z goes to a level with the
// length of the tool, H0 Z0 to the zero of the machine; E1 to E48 are work systems, E0 is the machine's;
// L203 runs subroutine 2 three times; L200 to M17 is that subroutine, and M30 stands between the subroutines
// and the main program; L beside a circle repeats it.
#pragma once

#include <string>
#include <string_view>

namespace tribo::readers {

// True for a program that names its work systems by E, alone or beside X, Y or H, and its lengths by H and Z
// without G43.
bool looks_like_fadal(std::string_view bytes);

// A whole program; has as many lines as it.
std::string fadal_in_fanuc_words(std::string_view bytes);

}  // namespace tribo::readers

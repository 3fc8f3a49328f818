// SPDX-License-Identifier: MIT
// A cutter in words: `flat 6`, `ball 8 flutes 3`, `T2 bull 10 corner 1`, `1/4in flat 2 flutes`.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "base/result.hpp"
#include "milling/tool/cutter_shape.hpp"

namespace tribo::job {

using milling::kCutterKindWords;

// Reads: a kind, the diameter (the first number without a word, or `D 6`), and any of `T number`, `flutes`,
// `corner`, `helix`, `length`, `core`, each with its number behind it; `3 flutes` too. Lengths are in mm, or
// carry a unit (1/4in, 0.25"). Comments of CAM systems are read alike (`T1 D=6 CR=0 - flat end mill`). Absent
// values are those of milling::Cutter. Refuses unknown words with the nearest known one, numbers out of range
// (base/limits.hpp), and impossible cutters.
Result<milling::Cutter> parse_tool_words(std::string_view text);

// Writes what parse_tool_words() reads back to the same kind, number and sizes. Values that a cutter has by
// default are left out, except its flutes. Holder, run-out and pitch are not written.
std::string tool_words(const milling::Cutter& cutter);
// Its part between diameter and flutes: " corner 1", " point 60"; with a leading blank, empty if none.
std::string shape_words(const milling::Cutter& cutter);

}  // namespace tribo::job

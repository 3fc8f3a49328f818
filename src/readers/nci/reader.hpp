// SPDX-License-Identifier: MIT
// NCI files of Mastercam, in the form of text, to moves: rapids, feeds, arcs, five-axis points, drilling,
// tools. What a record means was taken from the open converter of NCL (ncilod.f, ncimot.f of
// NCL/PostWorks) and the heading of the vendor's chapter on NCI (MP Post Reference Guide 9.1, volume 3,
// chapter 6). Records that may move the tool and are not known are refused. Any thread; allocates; time and
// memory linear in the bytes and the moves.
#pragma once

#include "readers/apt/reader.hpp"

namespace tribo::readers {

// True if the text begins with pairs of lines whose first is a number of a record: 1050, 1000 to 1099, 10000
// and on.
bool looks_like_nci(std::string_view bytes);

// Returns the moves in the system of the points. Rules:
// - The file states no unit: that of the options is taken, with a warning.
// - The first point is a start, not a move.
// - The first matrix of a tool plane or work system is that of the program; another one after it is refused.
// Line numbers are those of the number of a record.
Result<motion::Program> read_nci(std::string_view bytes, const AptOptions& options = {});

}  // namespace tribo::readers

// SPDX-License-Identifier: MIT
// Where a path begins inside the stock, or goes on there with another tool, nobody knows how the tool came
// there.
#pragma once

#include "session/cut/mill_setup.hpp"

namespace tribo::session {

// Puts a place (motion::Move::is_place) before each feed move that begins in the box of the blank, but not
// where the move before it has brought the same tool. What the tool stands in there is taken away by the
// place, without a force, and is not booked to the feed move.
void add_places_in_stock(MillSetup& setup, const Box3& blank_mm);

}  // namespace tribo::session

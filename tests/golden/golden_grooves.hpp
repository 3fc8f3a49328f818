// SPDX-License-Identifier: MIT
// Five passes of a ball, 1.5 mm apart, over a block of 20 x 16 x 6 mm: what haptics and surface look at.
#pragma once

#include "session/cut/mill_session.hpp"

namespace tribo::golden {

session::MillSetup grooves();

}  // namespace tribo::golden

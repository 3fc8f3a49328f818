// SPDX-License-Identifier: MIT
// Warnings of speeds that no cutter stands, before the run: a digit that is missing or one too many in S or
// F.
#pragma once

#include <string>

#include "base/result.hpp"
#include "session/cut/mill_session.hpp"

namespace tribo::session {

// The setup must have moves, cutters and speeds. `program`: file name for the messages.
Warnings speed_warnings(const MillSetup& setup, const std::string& program);

}  // namespace tribo::session

// SPDX-License-Identifier: MIT
// Warnings of a finished run: nothing cut, nothing left, a force that does not balance the removed material,
// chips that rub or overload.
#pragma once

#include <string>

#include "base/result.hpp"
#include "session/cut/mill_session.hpp"

namespace tribo::session {

// `job` and `program`: file names for the messages.
Warnings warnings_of(const MillTotals& totals, const std::string& job, const std::string& program);

}  // namespace tribo::session

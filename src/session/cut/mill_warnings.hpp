// SPDX-License-Identifier: MIT
// What a finished run has to be warned of: nothing cut, a force that does not balance the metal, chips that
// rub or overload.
#pragma once

#include <string>

#include "base/result.hpp"
#include "session/cut/mill_session.hpp"

namespace tribo::session {

// `job` and `program` are the names of the files that the messages name.
Warnings warnings_of(const MillTotals& totals, const std::string& job, const std::string& program);

}  // namespace tribo::session

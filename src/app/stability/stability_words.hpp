// SPDX-License-Identifier: MIT
// What a chart of stability says, in words.
#pragma once

#include <string>

#include "session/chatter/advice.hpp"

namespace tribo::app {

// A sentence. `chart`: that of advise().
std::string in_words(const session::SteadyCut& cut, const dynamics::StabilityChart& chart,
                     const session::Advice& advice);
// "7 of 10 cases" of a share; "all cases", "no case".
std::string cases_in_words(double probability);
bool is_estimated(const session::SteadyCut& cut);
// The title of the chart: cutter and engagement, and whether its modes are estimated.
std::string chart_title(const session::SteadyCut& cut);

}  // namespace tribo::app

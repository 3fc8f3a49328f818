// SPDX-License-Identifier: MIT
// What a chart of stability says, in words.
#pragma once

#include <string>

#include "session/chatter/advice.hpp"

namespace tribo::app {

// A sentence. `chart`: that of advise().
std::string in_words(const session::SteadyCut& cut, const dynamics::StabilityChart& chart,
                     const session::Advice& advice);
// The title of the chart: cutter and engagement.
std::string chart_title(const session::SteadyCut& cut);

}  // namespace tribo::app

// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace tribo::app {

// Shows the address in the user's browser, without waiting for it; where there is none, or no screen for it,
// says so on stderr.
void open_browser(const std::string& url);

}  // namespace tribo::app

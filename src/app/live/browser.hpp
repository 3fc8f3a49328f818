// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace tribo::app {

// Opens the address in the browser of the user, without waiting. Without a browser or a screen it prints a
// message to stderr.
void open_browser(const std::string& url);

}  // namespace tribo::app

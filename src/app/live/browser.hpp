// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace tribo::app {

// Opens the address in the browser of the user, without waiting. Without a browser or a screen it prints a
// message to stderr. `secret`: the address holds a token, so that the browser gets a page on the disk that
// leads there (opening_page.hpp).
void open_browser(const std::string& url, bool secret);

}  // namespace tribo::app

// SPDX-License-Identifier: MIT
// A page on the disk that leads a browser to an address with a token. Every user sees the arguments of a
// browser in the list of processes; this page only its owner can read.
#pragma once

#include <optional>
#include <string>

namespace tribo::app {

// Writes the page, with a random name, into the folder of the session ($XDG_RUNTIME_DIR), else into that for
// temporary files. It is removed 30 s later, and when the process ends. Nothing where no such file can be
// written.
std::optional<std::string> write_opening_page(const std::string& url);

}  // namespace tribo::app

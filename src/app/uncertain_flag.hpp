// SPDX-License-Identifier: MIT
// The flag --uncertain N: bands from N cases of what a job knows with a spread only.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "base/result.hpp"

namespace tribo::app {

void add_uncertain(CLI::App& verb, std::optional<int>& cases);

// Refuses the flag for a job in which nothing has a spread.
Result<void> check_uncertain(const std::string& file, std::optional<int> cases, bool has_spread);

}  // namespace tribo::app

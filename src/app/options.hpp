// SPDX-License-Identifier: MIT
// Checks of what stands behind a flag, with messages in the program's own manner.
#pragma once

#include <CLI/CLI.hpp>
#include <string_view>
#include <vector>

namespace tribo::app {

// A finite number above `above` and at most `most`.
CLI::Validator finite_number(double above, double most);
// One of the words, or a comma-separated list of them.
CLI::Validator one_of(std::vector<std::string_view> words);

// What a failed parse should have said: the known flag or verb nearest to an unknown one. `program` has the
// state of that parse.
std::string explain_usage(const CLI::App& program, const CLI::ParseError& error);

}  // namespace tribo::app

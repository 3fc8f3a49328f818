// SPDX-License-Identifier: MIT
// Checks of the values of flags, with the error messages of the program.
#pragma once

#include <CLI/App.hpp>  // without CLI11's formatter, which every file would compile again
#include <CLI/Validators.hpp>
#include <string_view>
#include <vector>

#include "base/limits.hpp"

namespace tribo::app {

// A number within the range of the table.
CLI::Validator within(const Limit& limit);
// One of the words, or a comma-separated list of them.
CLI::Validator one_of(std::vector<std::string_view> words);

// The message for a failed parse, with the nearest known flag or verb. `program` has the state
// of this parse.
std::string explain_usage(const CLI::App& program, const CLI::ParseError& error);

}  // namespace tribo::app

// SPDX-License-Identifier: MIT
// Exit codes of the program, and its error messages.
#pragma once

#include "files/files.hpp"

namespace tribo::app {

inline constexpr int kDone = 0;
inline constexpr int kOurFault = 1;    // a defect of Tribo, or out of memory in spite of the budget
inline constexpr int kWrongInput = 2;  // the input or the call is wrong
inline constexpr int kRefused = 3;     // a device, port or file system refused
inline constexpr int kOverLimit = 4;   // `audit --fail-over` found a load over its limit

// Prints `file:line:column: error: cause; remedy` to stderr and returns the exit code.
int report(const Error& error);
int report(const FileFailure& failure);

// Prints the first `most` warnings to stderr, and the number of the others.
void report(const Warnings& warnings, std::size_t most = 20);

}  // namespace tribo::app

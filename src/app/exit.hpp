// SPDX-License-Identifier: MIT
// How the program ends, and what it says then.
#pragma once

#include "files/files.hpp"

namespace tribo::app {

inline constexpr int kDone = 0;
inline constexpr int kOurFault = 1;    // a defect of Tribo, or memory that ran out in spite of the budget
inline constexpr int kWrongInput = 2;  // the input or the call is wrong
inline constexpr int kRefused = 3;     // a device, port or file system refused

// Prints `file:line:column: error: what; remedy` to stderr and gives the code to exit with.
int report(const Error& error);
int report(const FileFailure& failure);

// Prints warnings to stderr, the first `most` of them and how many more there are.
void report(const Warnings& warnings, std::size_t most = 20);

}  // namespace tribo::app

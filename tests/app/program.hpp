// SPDX-License-Identifier: MIT
// Runs the built program as a user would and keeps what it said.
#pragma once

#include <string>
#include <vector>

#include "io/scratch.hpp"

namespace tribo::test {

struct Outcome {
    int code = -1;  // as a shell counts: 128 + n after signal n
    std::string out, err;
};

// Starts the program in `folder` with these arguments; stdin is empty. Where `interrupt_after_ms` is above 0
// it gets `signal` after that time.
Outcome run_tribo(const std::vector<std::string>& arguments, const std::string& folder = ".",
                  int interrupt_after_ms = 0, int signal = 2);

}  // namespace tribo::test

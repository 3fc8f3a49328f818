// SPDX-License-Identifier: MIT
// Runs the built program as a user would and keeps what it said.
#pragma once

#include <string>
#include <vector>

#include "files/scratch.hpp"

namespace tribo::test {

struct Outcome {
    int code = -1;  // as a shell counts: 128 + n after signal n
    std::string out, err;
    double cpu_s = 0, peak_mb = 0;  // of the process
};

// Starts the program in `folder` with these arguments; stdin is empty. Where `interrupt_after_ms` is above 0
// it gets `signal` after that time.
Outcome run_tribo(const std::vector<std::string>& arguments, const std::string& folder = ".",
                  int interrupt_after_ms = 0, int signal = 2);

// The program while it runs; what it was not told to end it ends at the end of its own.
class RunningTribo {
  public:
    RunningTribo(std::vector<std::string> arguments, const std::string& folder);
    ~RunningTribo();
    RunningTribo(const RunningTribo&) = delete;
    RunningTribo& operator=(const RunningTribo&) = delete;

    // What stands on stdout once it holds `mark`, or after half a minute whatever there is.
    std::string out_with(const std::string& mark) const;
    std::string err() const { return scratch_.get("err"); }
    int pid() const { return pid_; }
    // Sends the signal and waits.
    Outcome stop(int signal = 2);

  private:
    Scratch scratch_;  // output goes to files: no pipe can fill up
    int pid_ = -1;
};

}  // namespace tribo::test

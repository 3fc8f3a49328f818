// SPDX-License-Identifier: MIT
// A process that computes cases of a sweep, one after the other.
#pragma once

#include <cstdint>
#include <string>

namespace tribo::app {

// The verb, not shown in the help, by which the program starts itself as a worker.
inline constexpr const char* kSweepWorkerVerb = "sweep-worker";

struct SweepWorkerCall {
    std::string sweep;   // the file of the sweep
    std::string digest;  // SweepCases::digest(); empty: not checked
    // The file that takes the results is this name with "-RESTART.cases". What the files of earlier starts
    // hold is not computed again.
    std::string cases;
    int restart = 0;
    double memory_bytes = 0;
    // A file of case numbers (64 bits, little-endian); empty: they come over stdin, a line of numbers at a
    // time. Of the file this worker takes every `of`-th, beginning with `first`.
    std::string numbers;
    std::uint64_t first = 0, of = 1;
};

// Over stdin: says "run N" before each case and "done" after each line, on stdout, and ends with the end of
// stdin. Refuses a sweep that has changed (exit code 2).
int sweep_worker(const SweepWorkerCall& call);

}  // namespace tribo::app

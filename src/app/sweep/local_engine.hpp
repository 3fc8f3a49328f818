// SPDX-License-Identifier: MIT
// Runs cases of a sweep on the cores of this machine, in processes of their own: a case that ends its process
// ends no other.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "app/sweep/sweep_cases.hpp"

namespace tribo::app {

struct LocalEngineOptions {
    int workers = 1;
    std::string folder;       // takes the files of results
    std::string sweep;        // the file of the sweep
    double memory_bytes = 0;  // of one worker; 0: no limit
    // Called with the number of finished cases. May be null.
    std::function<void(std::uint64_t done)> progress{};
};

// Returns once all cases have a result or the run is interrupted. A case whose process dies gets this as its
// error. Refuses what the workers refuse: a full disk, a sweep that has changed.
FileResult<void> run_locally(SweepCases& cases, std::span<const std::uint64_t> numbers,
                             const LocalEngineOptions& options);

}  // namespace tribo::app

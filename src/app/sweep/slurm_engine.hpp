// SPDX-License-Identifier: MIT
// Runs cases of a sweep as an array of jobs of Slurm, whose client programs must be in PATH.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "app/sweep/sweep_cases.hpp"

namespace tribo::app {

struct SlurmEngineOptions {
    int workers = 0;       // tasks at the same time; 0: as many as Slurm lets run
    std::string folder;    // of the sweep, on a file system that all nodes share
    std::string sweep;     // its file
    double memory_mb = 0;  // that each task asks for; 0: Slurm's default
    // Called with the number of tasks that have ended, and of all. May be null.
    std::function<void(std::uint64_t ended, std::uint64_t tasks)> progress{};
};

// Submits one array of at most so many tasks as Slurm allows, each with an even share of the cases, and
// returns when the array has left the queue, or when the run is interrupted; the jobs then go on. If an array
// of this sweep is in the queue already, waits for it and submits nothing. What is missing afterwards, the
// caller sees in the results: a task may have failed, or its node may be gone for good.
FileResult<void> run_on_slurm(SweepCases& cases, std::span<const std::uint64_t> numbers,
                              const SlurmEngineOptions& options);

// Tasks of this sweep that wait or run; 0 where there are none, or no Slurm.
std::uint64_t slurm_tasks(const std::string& folder, const std::string& digest);

}  // namespace tribo::app

// SPDX-License-Identifier: MIT
// `tribo sweep`: many cases of one job, or of a folder of programs (docs/sweep.md).
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace tribo::app {

enum class SweepEngine : std::uint8_t { local, slurm };

struct SweepCall {
    std::string file, out;
    SweepEngine engine = SweepEngine::local;
    int workers = 0;  // 0: one per core
    bool dry_run = false, status = false;
    std::optional<std::uint64_t> only_case;
};

int sweep(const SweepCall& call);

}  // namespace tribo::app

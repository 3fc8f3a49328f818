// SPDX-License-Identifier: MIT
// Which job left the stock that the folder of a render shows, and what decided it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace tribo::job {

struct StockRecord {
    std::string version;            // of the program that rendered
    std::string job;                // file, counted from the folder
    std::optional<double> until_s;  // where the render ended before its program
    // Hashes, so that a change since is seen: of the stock it began with (earlier jobs and [setup] included),
    // of the sizes of its cutters, of the paths of its moves up to until_s.
    std::uint64_t stock = 0, cutters = 0, moves = 0;
};

}  // namespace tribo::job

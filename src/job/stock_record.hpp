// SPDX-License-Identifier: MIT
// Record in a render folder: the job that left this stock, and hashes of its input.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace tribo::job {

struct StockRecord {
    std::string version;            // of the program that rendered
    std::string job;                // file, relative to the folder
    std::optional<double> until_s;  // if the render ended before its program
    // Hashes to detect later changes: of its initial stock (with earlier jobs and [setup]), of the sizes of
    // its cutters, of the paths of its moves up to until_s.
    std::uint64_t stock = 0, cutters = 0, moves = 0;
};

}  // namespace tribo::job

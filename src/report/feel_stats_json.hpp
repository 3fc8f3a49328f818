// SPDX-License-Identifier: MIT
// The servo statistics of `tribo feel --stats`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tribo::report {

struct DurationFigures {
    double p50_us = 0, p99_us = 0, p999_us = 0, max_us = 0;
};

// The size of a force table along the path.
struct ForceTableFigures {
    std::size_t pieces = 0, knots = 0, bytes = 0;
    double worst_jnd = 0;           // by a dense check
    std::size_t uniform_knots = 0;  // of a table with uniform spacing and the same worst error
};

struct FeelStats {
    std::string version, device, mode;
    std::uint64_t ticks = 0;
    double rate_hz = 0;
    DurationFigures cpu, wall;                // of whole ticks, without the overhead of the clocks
    DurationFigures empty_cpu, empty_wall;    // of sections without a tick, with this overhead
    std::optional<DurationFigures> lateness;  // of the start of a tick, if the loop had deadlines
    std::uint64_t late = 0;                   // ticks that exceeded their deadline
    double max_force_n = 0;
    double lowest_energy_nmm = 0;  // of the passivity observer
    struct FaultCount {
        std::string name;
        std::uint32_t count = 0;
    };
    // Cut mode, if this run made the table.
    std::optional<ForceTableFigures> table;
    std::vector<FaultCount> faults;  // that happened
    std::vector<std::string> notes;  // permissions refused by the system, as text
};

std::string feel_stats_json(const FeelStats& stats);

}  // namespace tribo::report

// SPDX-License-Identifier: MIT
// What `tribo feel --stats` writes about its servo.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tribo::report {

struct DurationFigures {
    double p50_us = 0, p99_us = 0, p999_us = 0, max_us = 0;
};

// What a table of forces along the path costs.
struct ForceTableFigures {
    std::size_t pieces = 0, knots = 0, bytes = 0;
    double worst_jnd = 0;           // by a dense check
    std::size_t uniform_knots = 0;  // of a table of even spacing with the same worst error
};

struct FeelStats {
    std::string version, device, mode;
    std::uint64_t ticks = 0;
    double rate_hz = 0;
    DurationFigures cpu, wall;                // of whole ticks, the clocks' own cost taken off
    DurationFigures empty_cpu, empty_wall;    // of sections without a tick, nothing taken off
    std::optional<DurationFigures> lateness;  // of the start of a tick, where the loop had deadlines
    std::uint64_t late = 0;                   // ticks that took longer than they had
    double max_force_n = 0;
    double lowest_energy_nmm = 0;  // of the passivity observer
    struct FaultCount {
        std::string name;
        std::uint32_t count = 0;
    };
    // Of cut mode, where the table was made in this run.
    std::optional<ForceTableFigures> table;
    std::vector<FaultCount> faults;  // that happened
    std::vector<std::string> notes;  // what the system did not grant, in words
};

std::string feel_stats_json(const FeelStats& stats);

}  // namespace tribo::report

// SPDX-License-Identifier: MIT
// summary.json: the results of a render, with keys that other programs rely on (docs/results.md).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "base/vec3.hpp"
#include "job/stock_record.hpp"

namespace tribo::report {

// A collision of the tool, its shank or its holder.
struct SummaryCollision {
    int line = 0;
    double t_s = 0;
    std::string kind;
    Vec3 tip_mm;
};

// A line of the program that chatters, at the place with the largest multiplier.
struct SummaryChatter {
    int line = 0;
    double t_s = 0, multiplier = 0, chatter_hz = 0;
};

// What bending of tool and part leaves on the surface; lines of the program.
struct SummaryFormError {
    double left_mm = 0, overcut_mm = 0;   // at most, >= 0
    double wave_mm = 0;                   // highest to lowest within half a millimetre, at most
    int left_line = 0, overcut_line = 0;  // 0: none
};

// A force, torque or power, and the band in which the true one likely lies. Without one, all are equal.
struct ForceValue {
    double value = 0, low = 0, high = 0;
};

struct Summary {
    std::string job;      // name of the job file
    std::string version;  // of the program
    double duration_s = 0, cutting_s = 0, path_mm = 0;
    double removed_mm3 = 0, remaining_mm3 = 0;
    ForceValue mean_force_n, peak_force_n, peak_torque_nm, peak_power_w;
    std::optional<std::size_t> uncertain_cases;  // of which the bands are; absent: of the spread of forces
    std::optional<double> chatter_probability;   // of the worst row, in these cases
    std::optional<double> tooth_passing_hz;      // absent: nothing was cut
    // Work of the spindle. The balance is the shear work over ktc times the cut volume; absent if the
    // engagement is prescribed or nothing was cut.
    double work_j = 0;
    std::optional<double> energy_balance;
    std::optional<std::uint64_t> triangles;  // absent: no mesh was requested
    double resolution_mm = 0;
    std::optional<double> gouge_max_mm, rest_max_mm, scallop_max_mm;  // if there is a designed surface
    std::optional<Vec3> gouge_at_mm, rest_at_mm;   // on the machined surface; absent: there is none
    std::optional<job::StockRecord> stock_record;  // absent: rendered from a program without a job
    bool as_published = false;
    std::vector<SummaryCollision> collisions;
    std::optional<std::vector<SummaryChatter>> chatter;  // absent: the job has no modes
    std::optional<double> largest_displacement_mm;
    std::optional<SummaryFormError> form_error;  // absent: no modes, or no tooth left a known surface
    Warnings warnings;
    double seconds = 0, peak_memory_mb = 0;
};

// Returns the text of summary.json: the schema first, then the keys in the order above. Absent and non-finite
// values have no key.
std::string summary_json(const Summary& summary);

}  // namespace tribo::report

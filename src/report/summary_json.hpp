// SPDX-License-Identifier: MIT
// summary.json: what a render came to, in the keys that outsiders rely on (docs/results.md).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "base/vec3.hpp"
#include "job/stock_record.hpp"

namespace tribo::report {

// The tool, its shank or its holder where it must not be.
struct SummaryCollision {
    int line = 0;
    double t_s = 0;
    std::string kind;
    Vec3 tip_mm;
};

struct Summary {
    std::string job;      // name of the job file
    std::string version;  // of the program
    double duration_s = 0, cutting_s = 0, path_mm = 0;
    double removed_mm3 = 0, remaining_mm3 = 0;
    double mean_force_n = 0, peak_force_n = 0, peak_torque_nm = 0, peak_power_w = 0;
    // Forces, torque and power may really be these factors times what stands there: published coefficients
    // for one material differ by that much.
    double force_low_factor = 1, force_high_factor = 1;
    std::optional<double> tooth_passing_hz;  // absent where nothing was cut
    // Of the spindle; and the share of it that shears over ktc times the volume cut. The balance is absent
    // where the engagement is prescribed or nothing was cut.
    double work_j = 0;
    std::optional<double> energy_balance;
    std::optional<std::uint64_t> triangles;  // absent where no mesh was asked for
    double resolution_mm = 0;
    std::optional<double> gouge_max_mm, rest_max_mm, scallop_max_mm;  // where a designed surface is given
    std::optional<job::StockRecord> stock_record;
    bool as_published = false;
    std::vector<SummaryCollision> collisions;
    Warnings warnings;
    double seconds = 0, peak_memory_mb = 0;
};

// The text of summary.json: the schema first, then the keys in the order above. Values that are absent or not
// finite have no key.
std::string summary_json(const Summary& summary);

}  // namespace tribo::report

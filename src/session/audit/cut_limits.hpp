// SPDX-License-Identifier: MIT
// What cutter, spindle and part stand: each limit with its band and where it is from. A job states some of
// them ([limits]); the others come from the shape and the body of the tool, or are rules of thumb.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "job/job.hpp"
#include "session/audit/load_kind.hpp"
#include "session/cut/mill_session.hpp"

namespace tribo::session {

// The true limit lies between `low` and `high`; both are `value` where it is exact.
struct CutLimit {
    double value = 0, low = 0, high = 0;
    std::string source;
    bool rule_of_thumb = false;
};

// The loads of one cutter. A load without a limit is only reported.
struct ToolLimits {
    std::array<std::optional<CutLimit>, kLoadKinds> most;
    CutLimit least_chip;  // a thinner one is rubbed off, mm

    const std::optional<CutLimit>& of(LoadKind kind) const { return most[index_of(kind)]; }
};

struct CutLimits {
    std::vector<ToolLimits> of_cutter;       // one per cutter of the setup
    std::vector<job::SpindlePoint> spindle;  // speeds ascending; empty: not known
    std::optional<double> tolerance_mm;      // of the part
    Warnings assumptions;                    // what was taken for granted
};

// Torque and power of the spindle at a speed: linear between the points. Below the first one the torque is
// that of the first, above the last one both are those of the last.
job::SpindlePoint spindle_at(std::span<const job::SpindlePoint> curve, double rpm);

// The setup must have its cutters.
CutLimits cut_limits(const job::Job& job, const MillSetup& setup);

}  // namespace tribo::session

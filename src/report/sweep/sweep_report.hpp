// SPDX-License-Identifier: MIT
// report.html of a sweep: which inputs move which results, bands, extreme cases, failures. Opens offline.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sweep/band.hpp"

namespace tribo::report {

struct SweepInput {
    std::string key;
    std::string values;  // in words: "8000, 9000", "uniform 8000 to 9000"
};

// A result over all cases that stand for the inputs (of a plan with Sobol's points: A and B).
struct SweepOutput {
    std::string name;
    std::uint64_t count = 0;
    double mean = 0;
    sweep::Band band;
    double least = 0, most = 0;
    std::uint64_t least_case = 0, most_case = 0;
    std::vector<std::uint64_t> histogram;  // from least to most, equal widths
    struct Share {
        double first = 0, total = 0;
    };
    std::vector<Share> shares;  // Sobol' indices, one per input; empty: not sampled so
};

struct SweepFailure {
    std::string reason;
    std::uint64_t count = 0, example = 0;
};

struct SweepReport {
    std::string file, version;
    std::uint64_t planned = 0, finished = 0;
    std::vector<SweepInput> inputs;
    std::vector<SweepOutput> outputs;
    std::vector<SweepFailure> failures;  // most frequent first
};

std::string sweep_report(const SweepReport& report);

}  // namespace tribo::report

// SPDX-License-Identifier: MIT
// Inputs of a run that a program alone does not say. They come from the flags of a call
// (words/tool_words.hpp, words/stock_words.hpp); what is absent is assumed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "job/job.hpp"

namespace tribo::job {

// A block by its size, placed around the path, or a solid at its place.
struct StockInput {
    std::optional<Vec3> size_mm;  // > 0
    JobSolid solid;               // empty where `size_mm` is given
};

struct ProgramInputs {
    std::vector<milling::Cutter> cutters;  // numbers differ; a single one may have none
    std::string tool_table;                // a file; may be empty
    std::optional<StockInput> stock;
    std::string material;  // a name; may be empty
    std::string machine;   // a name or a description (.toml); may be empty
    std::optional<readers::Dialect> dialect;
    JobProcess process;  // 0: assumed
};

}  // namespace tribo::job

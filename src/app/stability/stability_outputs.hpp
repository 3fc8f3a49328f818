// SPDX-License-Identifier: MIT
// What `tribo stability` prints and writes.
#pragma once

#include <string>

#include "app/stability/stability.hpp"
#include "files/output_folder.hpp"

namespace tribo::app {

// The object of --json.
std::string stability_json(const StabilityAnswer& answer);
void print(const StabilityCall& call, const StabilityAnswer& answer);

// True for the names of the files of a chart.
bool is_chart_file(const std::string& name);
FileResult<void> write_chart(const StabilityCall& call, const StabilityAnswer& answer,
                             const files::OutputFolder& folder);

}  // namespace tribo::app

// SPDX-License-Identifier: MIT
// What `tribo stability` prints and writes.
#pragma once

#include <string>

#include "app/stability/stability.hpp"
#include "files/output_folder.hpp"

namespace tribo::app {

// The object of --json.
std::string stability_json(const StabilityCall& call, const StabilityAnswer& answer);
void print(const StabilityCall& call, const StabilityAnswer& answer);

// True for the names of the files that are written here.
bool is_stability_file(const std::string& name);
// Simulates, and writes vibration.csv. Ends early where the run is interrupted. Prints and adds a warning
// where the simulation ends before its turns do.
FileResult<void> write_vibration(const StabilityCall& call, StabilityAnswer& answer,
                                 const files::OutputFolder& folder);
// The rest: summary.json, and the chart if there is one.
FileResult<void> write_files(const StabilityCall& call, const StabilityAnswer& answer,
                             const files::OutputFolder& folder);

}  // namespace tribo::app

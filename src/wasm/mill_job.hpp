// SPDX-License-Identifier: MIT
// Loads a job, or a single program, for milling in the page.
#pragma once

#include <optional>
#include <string>

#include "job/file_source.hpp"
#include "protocol/live_frame.hpp"
#include "session/cut/mill_setup.hpp"

namespace tribo::wasm {

struct LoadedMill {
    session::MillSetup setup;
    job::Listening listening;
    std::optional<TriangleMesh> part;  // the designed surface
    std::string material;              // its name; empty: the job has its own coefficients
    Warnings warnings;
};

// `name`: a .toml job, or a program, whose other inputs are assumed, with warnings. `part`: name of a model
// among the files, for the designed surface. Refuses a job that does not fit into the memory of a module.
Result<LoadedMill> load_mill(const job::FileSource& files, const std::string& name, const std::string& part,
                             std::optional<double> cell_mm);

}  // namespace tribo::wasm

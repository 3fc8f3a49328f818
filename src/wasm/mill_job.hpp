// SPDX-License-Identifier: MIT
// A job, or a program that comes alone, out of the files in memory.
#pragma once

#include <optional>
#include <string>

#include "protocol/live_frame.hpp"
#include "session/cut/mill_setup.hpp"

namespace tribo::wasm {

struct LoadedMill {
    session::MillSetup setup;
    job::Listening listening;
    std::optional<TriangleMesh> part;  // the designed surface
    std::string material;              // its name, or nothing where the job has coefficients of its own
    Warnings warnings;
};

// `name`: a .toml job, or a program, for which the rest is assumed and said; of a program, a model among the
// files is its designed surface where `part` names it. Refuses what would not fit into a module's memory.
Result<LoadedMill> load_mill(const std::string& name, const std::string& part, std::optional<double> cell_mm);

}  // namespace tribo::wasm

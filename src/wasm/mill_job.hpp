// SPDX-License-Identifier: MIT
// A job, or a program that comes alone, ready to be milled in the page.
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
    std::string material;              // its name, or nothing where the job has coefficients of its own
    Warnings warnings;
};

// `name`: a .toml job, or a program, for which the rest is assumed and said; a model among the files is its
// designed surface where `part` names it. Refuses what would not fit into a module's memory.
Result<LoadedMill> load_mill(const job::FileSource& files, const std::string& name, const std::string& part,
                             std::optional<double> cell_mm);

}  // namespace tribo::wasm

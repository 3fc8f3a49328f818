// SPDX-License-Identifier: MIT
// Loads a job, or a single program, for milling in the page.
#pragma once

#include <optional>
#include <string>

#include "job/memory_source.hpp"
#include "session/live/live_mill.hpp"

namespace tribo::wasm {

// `name`: a .toml job, or a program, whose tools are those of a tool library among the files; its other
// inputs are assumed, with warnings. `part`: name of a model among the files, for the designed surface.
// Refuses a job that does not fit into the memory of a module.
Result<session::LiveInput> load_mill(const job::MemorySource& files, const std::string& name,
                                     const std::string& part, std::optional<double> cell_mm);

// The job file that stands for a program among the files, with all that is assumed; also of a program that
// load_mill() refuses as its rotary words have no machine.
Result<std::string> job_of_program(const job::MemorySource& files, const std::string& name);

}  // namespace tribo::wasm

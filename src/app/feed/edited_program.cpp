// SPDX-License-Identifier: MIT
#include "app/feed/edited_program.hpp"

#include <utility>

#include "app/feed/edited_source.hpp"
#include "files/machine_limits.hpp"

namespace tribo::app {

FileResult<session::MillSetup> prepare_edited(const FeedCall& call, const std::string& file, std::string text,
                                              double cell_mm) {
    job::LoadOptions limits = files::machine_limits();
    auto inputs = program_inputs(call.program);
    if (!inputs) return std::unexpected(FileFailure(inputs.error()));
    limits.program = *std::move(inputs);
    auto loaded = job::load_job(EditedSource(file, std::move(text)), call.job, limits);
    if (!loaded) return std::unexpected(loaded.error());
    Warnings again;  // said already
    session::MillOptions options{cell_mm, {}};
    options.memory_bytes = limits.memory_bytes;
    auto setup = session::prepare_mill(*loaded, options, again);
    if (!setup) return std::unexpected(FileFailure(setup.error()));
    return *std::move(setup);
}

}  // namespace tribo::app

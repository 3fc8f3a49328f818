// SPDX-License-Identifier: MIT
// What `tribo render` works on: a job with everything it names read and checked, and whether it fits into
// memory.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/render/render.hpp"
#include "files/files.hpp"
#include "job/job.hpp"
#include "milling/tool/materials.hpp"
#include "readers/mesh/model.hpp"
#include "session/cut/mill_setup.hpp"
#include "sound/play/soundtrack.hpp"

namespace tribo::app {

struct LoadedJob {
    job::Job job;
    milling::Material material;
    session::MillSetup setup;
    std::uint64_t stock_hash = 0;            // of the stock it begins with: session::JobStock
    std::vector<std::string> stock_folders;  // renders that this comes from: StockOnDisk
    std::optional<readers::Model> part;
    sound::SoundtrackOptions track;  // head and voices, where sound is asked for
    Warnings warnings;
};

// Moves are cut into pieces of at most `longest_piece_mm` where it is given.
FileResult<LoadedJob> load_job(const RenderCall& call, std::optional<double> longest_piece_mm = {});

// Refuses what would not fit, naming the finest spacing of the grid that would.
Result<void> check_memory(const RenderCall& call, const LoadedJob& loaded);

}  // namespace tribo::app

// SPDX-License-Identifier: MIT
// What `tribo render` works on: a job with everything it names read and checked, and whether it fits into
// memory.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/render.hpp"
#include "formats/job.hpp"
#include "formats/model.hpp"
#include "io/files.hpp"
#include "milling/materials.hpp"
#include "session/mill_setup.hpp"
#include "sound/soundtrack.hpp"

namespace tribo::app {

struct LoadedJob {
    formats::Job job;
    milling::Material material;
    session::MillSetup setup;
    std::uint64_t stock_hash = 0;            // of the stock it begins with: session::JobStock
    std::vector<std::string> stock_folders;  // renders that this comes from: StockOnDisk
    std::optional<formats::Model> part;
    sound::SoundtrackOptions track;  // head and voices, where sound is asked for
    Warnings warnings;
};

// Moves are cut into pieces of at most `longest_piece_mm` where it is given.
io::FileResult<LoadedJob> load_job(const RenderCall& call, std::optional<double> longest_piece_mm = {});

// Refuses what would not fit, naming the finest spacing of the grid that would.
Result<void> check_memory(const RenderCall& call, const LoadedJob& loaded);

}  // namespace tribo::app

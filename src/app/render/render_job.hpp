// SPDX-License-Identifier: MIT
// A job of the command line, ready to run, and whether it fits into memory.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/file_result.hpp"
#include "job/loader.hpp"
#include "milling/tool/materials.hpp"
#include "session/cut/mill_setup.hpp"
#include "sound/play/soundtrack.hpp"

namespace tribo::app {

// The verb, not shown in the help, by which the program starts itself to read a SOFA file.
inline constexpr const char* kReadSofaVerb = "read-sofa";

struct PreparedJob {
    job::Job job;
    milling::WorkpieceMaterial material;
    session::MillSetup setup;
    std::vector<std::string> stock_folders;  // renders that the stock comes from; absolute, links resolved
    std::optional<readers::Model> part;
    sound::SoundtrackOptions track;  // head and voices, where sound is asked for
    Warnings warnings;
};

// From the disk. Its sound files are read where `sound_rate_hz` says at which rate they will be heard.
FileResult<PreparedJob> prepare_job(const std::string& file, const session::MillOptions& options,
                                    std::optional<int> sound_rate_hz = {});

// What a run makes besides the milled part.
struct RunOutputs {
    bool mesh = false, report = false, sound = false;
};

// Refuses what would not fit, naming the finest spacing of the grid that would. Absent `memory_mb`: as much
// as the machine gives.
Result<void> check_memory(const std::string& file, const session::MillSetup& setup,
                          const std::optional<readers::Model>& part, RunOutputs outputs,
                          std::optional<double> memory_mb = {});

}  // namespace tribo::app

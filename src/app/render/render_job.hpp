// SPDX-License-Identifier: MIT
// Loads a job, or a program in its place, for the command line and checks that it fits into memory.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/render/program_flags.hpp"
#include "base/file_result.hpp"
#include "files/files.hpp"
#include "job/loader.hpp"
#include "milling/tool/materials.hpp"
#include "session/cut/mill_setup.hpp"
#include "sound/play/soundtrack.hpp"

namespace tribo::app {

// The verb, not shown in the help, by which the program starts itself to read a SOFA file.
inline constexpr const char* kReadSofaVerb = "read-sofa";

struct PreparedJob {
    job::Job job;
    bool is_program = false;  // a program stood in place of the job
    milling::WorkpieceMaterial material;
    session::MillSetup setup;
    std::vector<std::string> stock_folders;  // render folders of the stock; absolute, without links
    std::optional<readers::Model> part;
    sound::SoundtrackOptions track;  // head and voices, if sound is requested
    Warnings warnings;
};

// Loads a job or a program from the disk. Refuses flags of a program beside a job. `limits`: see
// files/machine_limits.hpp; its `program` is set here.
FileResult<job::LoadedJob> load_job(const std::string& file, const ProgramFlags& flags,
                                    job::LoadOptions limits, files::Pipes pipes = files::Pipes::read);

// Loads and prepares, within options.memory_bytes or half of the machine's memory. Reads sound files only if
// `sound_rate_hz` is set. Writes the file of --job-out.
FileResult<PreparedJob> prepare_job(const std::string& file, const ProgramFlags& flags,
                                    const session::MillOptions& options,
                                    std::optional<int> sound_rate_hz = {},
                                    files::Pipes pipes = files::Pipes::read);

// Outputs of a run besides the milled part.
struct RunOutputs {
    bool mesh = false, report = false, sound = false;
    double chatter_bytes = 0;  // of what a vibration leaves on the part, or adds to the force
    int sessions = 1;          // how many times the part is milled at the same time
    bool states = false;       // that one of them keeps
};

// Refuses a run that does not fit into memory. The error names the finest grid spacing that fits. Absent
// `memory_mb`: memory of the machine.
Result<void> check_memory(const std::string& file, const session::MillSetup& setup,
                          const std::optional<readers::Model>& part, RunOutputs outputs,
                          std::optional<double> memory_mb = {});

}  // namespace tribo::app

// SPDX-License-Identifier: MIT
#include "app/render/render_job.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "files/disk_source.hpp"
#include "files/machine_limits.hpp"
#include "files/memory.hpp"
#include "job/job_files.hpp"
#include "session/cut/memory_estimate.hpp"
#include "surface/deviation.hpp"
#include "tribo/job_hearing.hpp"

namespace tribo::app {
namespace {

constexpr double kMB = 1e6;

// Memory of every run, bytes, measured: the program itself; picture and page of the report; the tables of the
// sound.
constexpr double kProgramBytes = 15 * kMB, kReportBytes = 58 * kMB, kSoundBytes = 10 * kMB;
constexpr double kReportVertexBytes = 80;  // of the whole mesh, while it is reduced for the report
// For a comparison with a design: a sample with its copy; a point of the machined surface; a triangle of the
// design in trees and tables.
constexpr double kSampleBytes = 150, kPointBytes = 40, kTriangleBytes = 300;

// Returns the peak memory of the run, bytes, at a grid spacing.
double bytes_at(RunOutputs outputs, const std::optional<readers::Model>& part,
                const session::MemoryEstimate& estimate, double cell) {
    double mesh = 0, kept = 0, comparison = 0, after = 0;
    if (outputs.mesh || outputs.report) {
        mesh = estimate.mesh_bytes(cell);
        kept = 40 * estimate.vertices(cell);
    }
    if (part) {
        const double samples =
            std::min(static_cast<double>(surface::kMaxSamples), 2.7 * area_mm2(part->mesh) / (cell * cell));
        const double points = std::min(static_cast<double>(surface::kMaxSamples),
                                       30 * estimate.cut_bricks(cell) + estimate.vertices(cell));
        comparison = samples * kSampleBytes + points * kPointBytes;
        after += static_cast<double>(part->mesh.triangles.size()) * kTriangleBytes;
    }
    if (outputs.report) after += kReportBytes + kReportVertexBytes * estimate.vertices(cell);
    const double sound = outputs.sound ? kSoundBytes : 0;
    const double states = outputs.states ? estimate.states_bytes(cell) : 0;
    return kProgramBytes + sound + states + outputs.chatter_bytes +
           outputs.sessions * estimate.session_bytes(cell) +
           std::max({mesh, kept + comparison, kept + after});
}

}  // namespace

FileResult<job::LoadedJob> load_job(const std::string& file, const ProgramFlags& flags,
                                    job::LoadOptions limits, files::Pipes pipes) {
    auto inputs = program_inputs(flags);
    if (!inputs) return std::unexpected(FileFailure(inputs.error()));
    limits.program = *std::move(inputs);
    auto loaded = job::load_job(files::DiskSource(pipes), file, limits);
    if (!loaded || loaded->is_program) return loaded;
    const auto good = refuse_flags(flags, file, "this is a job",
                                   "change the job, or name its program: " + loaded->job.path.file);
    if (!good) return std::unexpected(FileFailure(good.error()));
    return loaded;
}

FileResult<PreparedJob> prepare_job(const std::string& file, const ProgramFlags& flags,
                                    const session::MillOptions& options, std::optional<int> sound_rate_hz,
                                    files::Pipes pipes) {
    const job::LoadOptions limits = files::machine_limits(options.memory_bytes);
    auto loaded = load_job(file, flags, limits, pipes);
    if (!loaded) return std::unexpected(loaded.error());
    session::MillOptions limited = options;
    limited.memory_bytes = limits.memory_bytes;
    PreparedJob prepared;
    prepared.warnings = std::move(loaded->warnings);
    auto setup = session::prepare_mill(*loaded, limited, prepared.warnings);
    if (!setup) return std::unexpected(FileFailure(setup.error()));
    if (auto written = write_job_out(flags, *loaded); !written) return std::unexpected(written.error());
    if (sound_rate_hz) {
        const job::JobSound& sound = loaded->job.sound;
        auto head = head_of(sound, *sound_rate_hz, file, SofaReader{"/proc/self/exe", kReadSofaVerb},
                            prepared.warnings);
        if (!head) return std::unexpected(job::at_key(loaded->job, head.error()));
        prepared.track.head = std::move(*head);
        if (auto read = read_voices(sound, prepared.track); !read)
            return std::unexpected(job::at_key(loaded->job, read.error()));
    }
    prepared.setup = std::move(*setup);
    prepared.material = *session::job_material(loaded->job);
    for (const job::EarlierJob& earlier : loaded->earlier) {
        if (!earlier.source.folder.empty()) prepared.stock_folders.push_back(earlier.source.folder);
    }
    prepared.is_program = loaded->is_program;
    prepared.job = std::move(loaded->job);
    prepared.part = std::move(loaded->part);
    return prepared;
}

Result<void> check_memory(const std::string& file, const session::MillSetup& setup,
                          const std::optional<readers::Model>& part, RunOutputs outputs,
                          std::optional<double> memory_mb) {
    const double budget =
        memory_mb ? *memory_mb * kMB : static_cast<double>(files::default_memory_budget_bytes());
    if (budget <= 0) return {};
    const auto shortage =
        session::memory_shortage(setup, budget, [&](const session::MemoryEstimate& estimate, double cell) {
            return bytes_at(outputs, part, estimate, cell);
        });
    if (!shortage) return {};
    char cause[160], remedy[160];
    std::snprintf(cause, sizeof cause,
                  "the job takes about %.0f MB at a resolution of %.3g mm, and %.0f MB are allowed",
                  shortage->need_bytes / kMB, setup.cell_mm, budget / kMB);
    if (shortage->fitting_cell_mm) {
        std::snprintf(remedy, sizeof remedy, "try --resolution %.2g, or allow more with --memory",
                      std::ceil(*shortage->fitting_cell_mm * 1e3) / 1e3);
    } else {
        std::snprintf(remedy, sizeof remedy, "allow at least %.0f MB with --memory",
                      std::ceil(shortage->least_bytes / kMB));
    }
    return fail_at(file, 0, 0, cause, remedy);
}

}  // namespace tribo::app

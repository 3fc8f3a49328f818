// SPDX-License-Identifier: MIT
#include "app/render/render_job.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/render/job_files.hpp"
#include "app/render/listening.hpp"
#include "files/memory.hpp"
#include "files/model/model_file.hpp"
#include "job/completion.hpp"
#include "job/program_file.hpp"
#include "job/toml/job_toml.hpp"
#include "session/cut/memory_estimate.hpp"
#include "session/cut/part_in_stock.hpp"
#include "surface/deviation.hpp"

namespace tribo::app {
namespace {

constexpr double kMegabyte = 1e6;

// What a run holds whatever it does, bytes, measured: the program itself; the report's picture and page; the
// sound's tables.
constexpr double kProgramBytes = 15 * kMegabyte, kReportBytes = 58 * kMegabyte, kSoundBytes = 10 * kMegabyte;
constexpr double kReportVertexBytes = 80;  // of the whole mesh, while the report thins it out
// Of a comparison with a design: a sample with its copy, a point of the machined surface; of the design, a
// triangle in trees and tables.
constexpr double kSampleBytes = 150, kPointBytes = 40, kTriangleBytes = 300;

// The most that the run may hold at once, bytes, at a spacing of the grid.
double bytes_at(const RenderCall& call, const LoadedJob& loaded, const session::MemoryEstimate& estimate,
                double cell) {
    const bool report = call.wants("report");
    double mesh = 0, kept = 0, comparison = 0, after = 0;
    if (call.wants("mesh") || report) {
        mesh = estimate.mesh_bytes(cell);
        kept = 40 * estimate.vertices(cell);
    }
    if (loaded.part) {
        const double samples = std::min(static_cast<double>(surface::kMaxSamples),
                                        2.7 * area_mm2(loaded.part->mesh) / (cell * cell));
        const double points = std::min(static_cast<double>(surface::kMaxSamples),
                                       30 * estimate.cut_bricks(cell) + estimate.vertices(cell));
        comparison = samples * kSampleBytes + points * kPointBytes;
        after += static_cast<double>(loaded.part->mesh.triangles.size()) * kTriangleBytes;
    }
    if (report) after += kReportBytes + kReportVertexBytes * estimate.vertices(cell);
    const double sound = call.wants("sound") ? kSoundBytes : 0;
    return kProgramBytes + sound + estimate.session_bytes(cell) +
           std::max({mesh, kept + comparison, kept + after});
}

}  // namespace

FileResult<LoadedJob> load_job(const RenderCall& call, std::optional<double> longest_piece_mm) {
    LoadedJob loaded;
    auto job = job::read_job(call.job);
    if (!job) return std::unexpected(job.error());
    loaded.job = std::move(*job);
    auto program = job::read_program(loaded.job);
    if (!program) return std::unexpected(program.error());
    loaded.warnings = program->warnings;
    if (auto done = job::complete_job(loaded.job, *program, loaded.warnings); !done) {
        return std::unexpected(FileFailure(done.error()));
    }
    session::MillInputs inputs;
    inputs.program = std::move(*program);
    auto begun = read_stock(loaded.job, loaded.warnings);
    if (!begun) return std::unexpected(begun.error());
    inputs.blank = std::move(begun->stock.blank);
    inputs.blank_volume_mm3 = begun->stock.blank_volume_mm3;
    inputs.earlier = std::move(begun->stock.earlier);
    loaded.stock_hash = begun->stock.hash;
    loaded.stock_folders = std::move(begun->folders);
    for (const job::JobSolid& fixture : loaded.job.fixtures) {
        auto solid = read_solid(fixture);
        if (!solid) return std::unexpected(solid.error());
        inputs.fixtures.push_back(std::move(solid->shape));
    }
    if (loaded.job.part) {
        auto part = files::read_model_file(*loaded.job.part);
        if (!part) return std::unexpected(part.error());
        loaded.part = std::move(*part);
        loaded.warnings.insert(loaded.warnings.end(), loaded.part->warnings.begin(),
                               loaded.part->warnings.end());
    }
    if (call.wants("sound")) {
        auto head = head_of(loaded.job.sound, call.sample_rate_hz, call.job, loaded.warnings);
        if (!head) return std::unexpected(head.error());
        loaded.track.head = std::move(*head);
        if (auto read = read_voices(loaded.job.sound, loaded.track); !read) {
            return std::unexpected(read.error());
        }
    }
    auto material = session::job_material(loaded.job);
    if (!material) {
        Error error = material.error();
        if (error.file.empty()) error.file = call.job;
        return std::unexpected(FileFailure(error));
    }
    loaded.material = std::move(*material);
    auto setup = session::prepare_mill(loaded.job, std::move(inputs),
                                       {call.resolution_mm, call.until_s, longest_piece_mm}, loaded.warnings);
    if (!setup) {
        Error error = setup.error();
        if (error.file.empty()) error.file = call.job;
        return std::unexpected(FileFailure(error));
    }
    loaded.setup = std::move(*setup);
    if (loaded.part) {
        session::warn_of_part_outside(loaded.part->mesh, *loaded.setup.blank, call.job, loaded.warnings);
    }
    return loaded;
}

Result<void> check_memory(const RenderCall& call, const LoadedJob& loaded) {
    const double budget = call.memory_mb ? *call.memory_mb * kMegabyte
                                         : static_cast<double>(files::default_memory_budget_bytes());
    const auto need_at = [&](double cell) {
        return bytes_at(call, loaded, session::MemoryEstimate(loaded.setup, cell), cell);
    };
    const double need = need_at(loaded.setup.cell_mm);
    if (budget <= 0 || need <= budget) return {};
    const Vec3 size = loaded.setup.blank->bounds_mm().size();
    const double largest = std::max({size.x, size.y, size.z});
    double fits = loaded.setup.cell_mm, least = need;
    while (fits < largest && least > budget) {
        fits *= 1.1;
        least = need_at(fits);
    }
    char cause[160], remedy[160];
    std::snprintf(cause, sizeof cause,
                  "the job takes about %.0f MB at a resolution of %.3g mm, and %.0f MB are allowed",
                  need / kMegabyte, loaded.setup.cell_mm, budget / kMegabyte);
    if (fits < largest) {
        std::snprintf(remedy, sizeof remedy, "try --resolution %.2g, or allow more with --memory",
                      std::ceil(fits * 1e3) / 1e3);
    } else {
        std::snprintf(remedy, sizeof remedy, "allow at least %.0f MB with --memory",
                      std::ceil(least / kMegabyte));
    }
    return fail_at(call.job, 0, 0, cause, remedy);
}

}  // namespace tribo::app

// SPDX-License-Identifier: MIT
#include "app/render_job.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/listening.hpp"
#include "field/box_shape.hpp"
#include "field/carved_field.hpp"
#include "field/mesh_shape.hpp"
#include "io/job_toml.hpp"
#include "io/memory.hpp"
#include "io/model_file.hpp"
#include "io/program_file.hpp"
#include "motion/path.hpp"
#include "session/job_completion.hpp"
#include "session/part_in_stock.hpp"

namespace tribo::app {
namespace {

constexpr double kMegabyte = 1e6;

struct Solid {
    std::unique_ptr<const field::Shape> shape;
    double volume_mm3 = 0;
};

io::FileResult<Solid> read_solid(const formats::JobSolid& solid) {
    if (!solid.model) return Solid{std::make_unique<field::BoxShape>(solid.box_mm), solid.box_mm.volume()};
    auto model = io::read_model_file(*solid.model);
    if (!model) return std::unexpected(model.error());
    auto shape = field::MeshShape::make(std::move(model->mesh));
    if (!shape) {
        Error error = shape.error();
        error.file = solid.model->path;
        return std::unexpected(io::Failure(error));
    }
    const double volume = volume_mm3((*shape)->mesh());
    return Solid{std::move(*shape), volume};
}

// The most that the run may hold at once, bytes, at a spacing of the grid.
double bytes_at(const RenderCall& call, const session::MillSetup& setup, double cell) {
    const Box3 blank = setup.blank->bounds_mm();
    const Vec3 s = blank.size();
    const double faces = 2 * (s.x * s.y + s.y * s.z + s.z * s.x);
    double swept = 0;
    for (std::size_t n = 0; n < setup.moves.size(); ++n) {
        const milling::Cutter& c = setup.cutters[setup.cutter_of_move[n]];
        swept += motion::path_length_mm(setup.moves[n]) * c.diameter_mm;
    }
    // A cut surface lies within the blank: repeated passes make no more of it than a few layers of its faces.
    const double surface = std::min(faces + 2 * swept, 3 * faces);
    double bytes = field::CarvedField::estimated_bytes(blank, cell, surface);
    if (call.wants("mesh") || call.wants("report")) bytes += surface / (cell * cell) * 60;
    constexpr double kPerMove = sizeof(motion::Move) + 2 * sizeof(motion::MoveTiming) + 320;
    return bytes + kPerMove * static_cast<double>(setup.moves.size()) + 30 * kMegabyte;
}

}  // namespace

io::FileResult<LoadedJob> load_job(const RenderCall& call, std::optional<double> longest_piece_mm) {
    LoadedJob loaded;
    auto job = io::read_job(call.job);
    if (!job) return std::unexpected(job.error());
    loaded.job = std::move(*job);
    auto program = io::read_program(loaded.job);
    if (!program) return std::unexpected(program.error());
    loaded.warnings = program->warnings;
    if (auto done = session::complete_job(loaded.job, *program, loaded.warnings); !done) {
        return std::unexpected(io::Failure(done.error()));
    }
    session::MillInputs inputs;
    inputs.program = std::move(*program);
    auto blank = read_solid(loaded.job.stock);
    if (!blank) return std::unexpected(blank.error());
    inputs.blank = std::move(blank->shape);
    inputs.blank_volume_mm3 = blank->volume_mm3;
    for (const formats::JobSolid& fixture : loaded.job.fixtures) {
        auto solid = read_solid(fixture);
        if (!solid) return std::unexpected(solid.error());
        inputs.fixtures.push_back(std::move(solid->shape));
    }
    if (loaded.job.part) {
        auto part = io::read_model_file(*loaded.job.part);
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
        const milling::Cutter& cutter = loaded.job.cutters.front();
        loaded.track.body = sound::tool_body(cutter.diameter_mm, cutter.length_mm,
                                             sound::material_damping(loaded.job.material.name));
    }
    auto material = session::job_material(loaded.job);
    if (!material) {
        Error error = material.error();
        if (error.file.empty()) error.file = call.job;
        return std::unexpected(io::Failure(error));
    }
    loaded.material = std::move(*material);
    auto setup = session::prepare_mill(loaded.job, std::move(inputs),
                                       {call.resolution_mm, call.until_s, longest_piece_mm}, loaded.warnings);
    if (!setup) {
        Error error = setup.error();
        if (error.file.empty()) error.file = call.job;
        return std::unexpected(io::Failure(error));
    }
    loaded.setup = std::move(*setup);
    if (loaded.part) {
        session::warn_of_part_outside(loaded.part->mesh, *loaded.setup.blank, call.job, loaded.warnings);
    }
    return loaded;
}

Result<void> check_memory(const RenderCall& call, const LoadedJob& loaded) {
    const double budget =
        call.memory_mb ? *call.memory_mb * kMegabyte : static_cast<double>(io::default_memory_budget_bytes());
    const double need = bytes_at(call, loaded.setup, loaded.setup.cell_mm);
    if (budget <= 0 || need <= budget) return {};
    double fits = loaded.setup.cell_mm;
    const Vec3 size = loaded.setup.blank->bounds_mm().size();
    const double largest = std::max({size.x, size.y, size.z});
    while (fits < largest && bytes_at(call, loaded.setup, fits) > budget) fits *= 1.05;
    char cause[160], remedy[160];
    std::snprintf(cause, sizeof cause,
                  "the job may take %.0f MB at a resolution of %.3g mm, and %.0f MB are allowed",
                  need / kMegabyte, loaded.setup.cell_mm, budget / kMegabyte);
    if (fits < largest) {
        std::snprintf(remedy, sizeof remedy, "try --resolution %.3g, or allow more with --memory", fits);
    } else {
        std::snprintf(remedy, sizeof remedy, "allow at least %.0f MB with --memory",
                      std::ceil(bytes_at(call, loaded.setup, largest) / kMegabyte));
    }
    return fail_at(call.job, 0, 0, cause, remedy);
}

}  // namespace tribo::app

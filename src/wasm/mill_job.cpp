// SPDX-License-Identifier: MIT
#include "wasm/mill_job.hpp"

#include <cmath>

#include "base/decimal.hpp"
#include "field/box_shape.hpp"
#include "field/mesh_shape.hpp"
#include "io/file_names.hpp"
#include "io/job_toml.hpp"
#include "io/program_file.hpp"
#include "session/job_assumption.hpp"
#include "session/job_completion.hpp"
#include "session/live_mill.hpp"
#include "session/memory_estimate.hpp"
#include "session/part_in_stock.hpp"
#include "wasm/mill_files.hpp"

namespace tribo::wasm {
namespace {

// A module may hold 4 GB, and a phone's page much less.
constexpr double kMostBytes = 1.2e9;

struct Solid {
    std::unique_ptr<const field::Shape> shape;
    double volume_mm3 = 0;
};

Result<Solid> solid_of(const formats::JobSolid& solid) {
    if (!solid.model) return Solid{std::make_unique<field::BoxShape>(solid.box_mm), solid.box_mm.volume()};
    auto model = read_model(*solid.model);
    if (!model) return std::unexpected(model.error());
    auto shape = field::MeshShape::make(std::move(model->mesh));
    if (!shape) {
        Error error = shape.error();
        error.file = solid.model->path;
        return std::unexpected(std::move(error));
    }
    const double volume = volume_mm3((*shape)->mesh());
    return Solid{std::move(*shape), volume};
}

Result<formats::Job> job_of(const std::string& name, bool& assumed) {
    assumed = io::extension_of(name) != ".toml";
    if (!assumed) {
        auto job = io::read_job(name);
        if (!job) return std::unexpected(Error(job.error()));
        return *std::move(job);
    }
    const auto bytes = io::read_file(name);
    if (!bytes) return std::unexpected(Error(bytes.error()));
    const auto kind = io::detect_program(*bytes, name);
    if (!kind) {
        return fail_at(name, 0, 0, "this is no job and no program that is known here",
                       "drop a job (.toml) with its files, G-code, APT or keyframes (.csv)");
    }
    return session::job_of_program(name, *kind);
}

Result<void> check_memory(const session::MillSetup& setup, const std::string& name) {
    const auto bytes = [&](double cell) {
        const session::MemoryEstimate estimate(setup, cell);
        return estimate.session_bytes(cell) + estimate.mesh_bytes(cell);
    };
    const double need = bytes(setup.cell_mm);
    if (need <= kMostBytes) return {};
    double cell = 1.1 * setup.cell_mm;
    while (bytes(cell) > kMostBytes) cell *= 1.1;
    return fail_at(name, 0, 0,
                   "at a grid of " + format_decimal(setup.cell_mm) + " mm the part takes about " +
                       format_decimal(std::round(need / 1e6)) + " MB, and a page has " +
                       format_decimal(kMostBytes / 1e6),
                   "use the program, or a grid of about " + format_decimal(static_cast<float>(cell)) + " mm");
}

}  // namespace

Result<LoadedMill> load_mill(const std::string& name, const std::string& part,
                             std::optional<double> cell_mm) {
    bool assumed = false;
    auto job = job_of(name, assumed);
    if (!job) return std::unexpected(job.error());
    auto program = io::read_program(*job);
    if (!program) return std::unexpected(Error(program.error()));
    LoadedMill loaded;
    loaded.warnings = program->warnings;
    if (assumed) session::assume_job(*job, *program, loaded.warnings);
    if (auto done = session::complete_job(*job, *program, loaded.warnings); !done) {
        return std::unexpected(done.error());
    }
    session::MillInputs inputs;
    inputs.program = std::move(*program);
    auto blank = solid_of(job->stock);
    if (!blank) return std::unexpected(blank.error());
    inputs.blank = std::move(blank->shape);
    inputs.blank_volume_mm3 = blank->volume_mm3;
    for (const formats::JobSolid& fixture : job->fixtures) {
        auto solid = solid_of(fixture);
        if (!solid) return std::unexpected(solid.error());
        inputs.fixtures.push_back(std::move(solid->shape));
    }
    if (!part.empty()) job->part = formats::ModelFile{part, {}};
    if (job->part) {
        auto model = read_model(*job->part);
        if (!model) return std::unexpected(model.error());
        loaded.warnings.insert(loaded.warnings.end(), model->warnings.begin(), model->warnings.end());
        loaded.part = std::move(model->mesh);
    }
    loaded.material = job->material.name;
    const milling::Cutter& cutter = job->cutters.front();
    session::LiveListening& listening = loaded.listening;
    const Box3 box = inputs.blank->bounds_mm();
    listening.listener_mm = job->sound.listener_mm.value_or(Vec3{box.centre().x, box.centre().y, box.max.z});
    listening.distance_factor = job->sound.distance_factor;
    listening.gain_db = job->sound.gain_db;
    listening.body =
        sound::tool_body(cutter.diameter_mm, cutter.length_mm, sound::material_damping(job->material.name));
    auto setup = session::prepare_mill(*job, std::move(inputs), {cell_mm, {}, session::LiveMill::kPieceMm},
                                       loaded.warnings);
    if (!setup) {
        Error error = setup.error();
        if (error.file.empty()) error.file = name;
        return std::unexpected(std::move(error));
    }
    loaded.setup = std::move(*setup);
    if (loaded.part) session::warn_of_part_outside(*loaded.part, *loaded.setup.blank, name, loaded.warnings);
    if (auto fits = check_memory(loaded.setup, name); !fits) return std::unexpected(fits.error());
    return loaded;
}

}  // namespace tribo::wasm

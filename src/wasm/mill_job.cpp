// SPDX-License-Identifier: MIT
#include "wasm/mill_job.hpp"

#include <cmath>

#include "base/decimal.hpp"
#include "base/file_names.hpp"
#include "job/assumption.hpp"
#include "job/completion.hpp"
#include "job/program_file.hpp"
#include "job/toml/job_toml.hpp"
#include "session/cut/job_stock.hpp"
#include "session/cut/memory_estimate.hpp"
#include "session/cut/part_in_stock.hpp"
#include "session/live/live_mill.hpp"
#include "wasm/mill_files.hpp"

namespace tribo::wasm {
namespace {

// A module may hold 4 GB, and a phone's page much less.
constexpr double kMostBytes = 1.2e9;

Result<job::Solid> solid_of(const job::JobSolid& solid) {
    if (!solid.model) return job::box_solid(solid.box_mm);
    auto model = read_model(*solid.model);
    if (!model) return std::unexpected(model.error());
    return job::mesh_solid(std::move(model->mesh), solid.model->path);
}

// Earlier jobs among the files in memory; folders of renders are not among them.
session::JobFiles job_files() {
    session::JobFiles files;
    files.job = [](const std::string& file) -> Result<job::Job> {
        auto job = job::read_job(file);
        if (!job) return std::unexpected(Error(job.error()));
        return *std::move(job);
    };
    files.program = [](const job::Job& job) -> Result<motion::Program> {
        auto program = job::read_program(job);
        if (!program) return std::unexpected(Error(program.error()));
        return *std::move(program);
    };
    files.solid = solid_of;
    files.source = [](const std::string& path) -> Result<session::StockSource> {
        if (extension_of(path) == ".toml") return session::StockSource{path, {}};
        return fail("a page takes the stock from a job alone, not from '" + path + "'",
                    "name the earlier job (.toml) and drop it too, or use the program");
    };
    files.identity = [](const std::string& file) { return file; };
    return files;
}

Result<job::Job> job_of(const std::string& name, bool& assumed) {
    assumed = extension_of(name) != ".toml";
    if (!assumed) {
        auto job = job::read_job(name);
        if (!job) return std::unexpected(Error(job.error()));
        return *std::move(job);
    }
    const auto bytes = files::read_file(name);
    if (!bytes) return std::unexpected(Error(bytes.error()));
    const auto kind = job::detect_program(*bytes, name);
    if (!kind) {
        return fail_at(name, 0, 0, "this is no job and no program that is known here",
                       "drop a job (.toml) with its files, G-code, APT or keyframes (.csv)");
    }
    return job::job_of_program(name, *kind);
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
    auto program = job::read_program(*job);
    if (!program) return std::unexpected(Error(program.error()));
    LoadedMill loaded;
    loaded.warnings = program->warnings;
    if (assumed) job::assume_job(*job, *program, loaded.warnings);
    if (auto done = job::complete_job(*job, *program, loaded.warnings); !done) {
        return std::unexpected(done.error());
    }
    session::MillInputs inputs;
    inputs.program = std::move(*program);
    auto stock = session::read_stock(*job, job_files(), loaded.warnings);
    if (!stock) return std::unexpected(stock.error());
    inputs.blank = std::move(stock->blank);
    inputs.blank_volume_mm3 = stock->blank_volume_mm3;
    inputs.earlier = std::move(stock->earlier);
    for (const job::JobSolid& fixture : job->fixtures) {
        auto solid = solid_of(fixture);
        if (!solid) return std::unexpected(solid.error());
        inputs.fixtures.push_back(std::move(solid->shape));
    }
    if (!part.empty()) job->part = readers::ModelFile{part, {}};
    if (job->part) {
        auto model = read_model(*job->part);
        if (!model) return std::unexpected(model.error());
        loaded.warnings.insert(loaded.warnings.end(), model->warnings.begin(), model->warnings.end());
        loaded.part = std::move(model->mesh);
    }
    loaded.material = job->material.name;
    loaded.listening = job::listening_to(*job, inputs.blank->bounds_mm());
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

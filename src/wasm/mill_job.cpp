// SPDX-License-Identifier: MIT
#include "wasm/mill_job.hpp"

#include <cmath>

#include "base/text/decimal.hpp"
#include "job/program_file.hpp"
#include "job/toml/job_writer.hpp"
#include "session/cut/memory_estimate.hpp"

namespace tribo::wasm {
namespace {

// A module can hold 4 GB, and the page of a phone much less.
constexpr double kMostBytes = 1.2e9;

job::LoadOptions limits_of(const job::MemorySource& files) {
    job::LoadOptions limits;
    limits.memory_bytes = static_cast<std::uint64_t>(kMostBytes);
    limits.program.tool_table = files.tool_table();
    return limits;
}

Result<void> check_memory(const session::MillSetup& setup, const std::string& name) {
    const auto shortage =
        session::memory_shortage(setup, kMostBytes, [](const session::MemoryEstimate& estimate, double cell) {
            return estimate.session_bytes(cell) + estimate.mesh_bytes(cell);
        });
    if (!shortage) return {};
    std::string remedy = "use the program";
    if (shortage->fitting_cell_mm)
        remedy +=
            ", or a grid of about " + format_decimal(static_cast<float>(*shortage->fitting_cell_mm)) + " mm";
    return fail_at(name, 0, 0,
                   "at a grid of " + format_decimal(setup.cell_mm) + " mm the part takes about " +
                       format_decimal(std::round(shortage->need_bytes / 1e6)) + " MB, and a page has " +
                       format_decimal(kMostBytes / 1e6),
                   remedy);
}

}  // namespace

Result<session::LiveInput> load_mill(const job::MemorySource& files, const std::string& name,
                                     const std::string& part, std::optional<double> cell_mm) {
    job::LoadOptions limits = limits_of(files);
    limits.part = part;
    auto loaded = job::load_job(files, name, limits);
    if (!loaded) return std::unexpected(Error(loaded.error()));
    session::LiveExtras told;
    told.warnings = std::move(loaded->warnings);
    const session::MillOptions options{cell_mm, {}, session::LiveMill::kPieceMm, limits.memory_bytes};
    auto setup = session::prepare_mill(*loaded, options, told.warnings);
    if (!setup) return std::unexpected(setup.error());
    if (auto fits = check_memory(*setup, name); !fits) return std::unexpected(fits.error());
    told.material = loaded->job.material.name;
    told.limits = session::cut_limits(loaded->job, *setup);
    told.program = {loaded->job.path.file, job::shown_program(files, loaded->job)};
    told.listening = job::listening_to(loaded->job, setup->blank->bounds_mm());
    if (loaded->part) told.designed = std::make_shared<const TriangleMesh>(std::move(loaded->part->mesh));
    return session::LiveInput(*std::move(setup), std::move(told));
}

Result<std::string> job_of_program(const job::MemorySource& files, const std::string& name) {
    const job::LoadOptions limits = limits_of(files);
    auto loaded = job::load_job(files, name, limits);
    if (!loaded) return std::unexpected(Error(loaded.error()));
    if (!loaded->is_program) return fail_at(name, 0, 0, "this is a job already", "read the file itself");
    return job::job_text(*loaded, [](const std::string& file) { return file; });
}

}  // namespace tribo::wasm

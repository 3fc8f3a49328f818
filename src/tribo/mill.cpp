// SPDX-License-Identifier: MIT
#include "tribo/mill.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/text/decimal.hpp"
#include "base/text/limit_text.hpp"
#include "field/contour/contour_refine.hpp"
#include "files/disk_source.hpp"
#include "files/machine_limits.hpp"
#include "files/memory.hpp"
#include "session/cut/contact_of_cut.hpp"
#include "session/cut/memory_estimate.hpp"
#include "session/cut/mill_setup.hpp"
#include "session/cut/mill_warnings.hpp"
#include "tribo/mill_state.hpp"
#include "tribo/threads.hpp"

namespace tribo {
namespace {

constexpr double kMegabyte = 1e6;

Result<void> check_mill(const MillOptions& options) {
    if (options.cell_mm && !kLimits.resolution.range.contains(*options.cell_mm))
        return fail("cell_mm is out of range", range_remedy(kLimits.resolution));
    if (options.until_s && !kLimits.until.range.contains(*options.until_s))
        return fail("until_s is out of range", range_remedy(kLimits.until) + ", or leave it out");
    if (options.threads < 0 || options.threads > kMaxThreads)
        return fail("the number of threads is out of range", "give 0 to 256");
    if (options.memory_mb && !kLimits.memory.range.contains(*options.memory_mb))
        return fail("memory_mb is out of range", range_remedy(kLimits.memory) + ", or leave it out");
    return {};
}

// The message names the finest grid that fits, by the name of the option.
Result<void> check_memory(const session::MillSetup& setup, const MillOptions& options,
                          const std::string& file) {
    const double budget = options.memory_mb ? *options.memory_mb * kMegabyte
                                            : static_cast<double>(files::default_memory_budget_bytes());
    if (budget <= 0) return {};
    const auto shortage =
        session::memory_shortage(setup, budget, [](const session::MemoryEstimate& estimate, double cell) {
            return estimate.session_bytes(cell) + estimate.mesh_bytes(cell);
        });
    if (!shortage) return {};
    const auto megabytes = [](double bytes) { return format_decimal(std::ceil(bytes / kMegabyte)) + " MB"; };
    return fail_at(file, 0, 0,
                   "the job takes about " + megabytes(shortage->need_bytes) + " at a grid of " +
                       format_decimal(setup.cell_mm) + " mm, and " + megabytes(budget) + " are allowed",
                   shortage->fitting_cell_mm
                       ? "try cell_mm " + format_decimal(static_cast<float>(*shortage->fitting_cell_mm))
                       : "allow more with memory_mb");
}

}  // namespace

Mill::Mill(std::unique_ptr<State> state) : state_(std::move(state)) {}
Mill::Mill(Mill&&) noexcept = default;
Mill& Mill::operator=(Mill&&) noexcept = default;
Mill::~Mill() = default;

FileResult<Mill> Mill::open(const std::string& file, const MillOptions& options) {
    if (auto good = check_mill(options); !good) return std::unexpected(FileFailure(good.error()));
    const job::LoadOptions limits =
        files::machine_limits(static_cast<std::uint64_t>(options.memory_mb.value_or(0) * kMegabyte));
    auto loaded = job::load_job(files::DiskSource(), file, limits);
    if (!loaded) return std::unexpected(loaded.error());
    auto state = std::make_unique<State>();
    state->file = file;
    state->warnings = std::move(loaded->warnings);
    session::MillOptions how{options.cell_mm, options.until_s};
    how.memory_bytes = limits.memory_bytes;
    auto setup = session::prepare_mill(*loaded, how, state->warnings);
    if (!setup) return std::unexpected(FileFailure(setup.error()));
    if (auto fits = check_memory(*setup, options, file); !fits)
        return std::unexpected(FileFailure(fits.error()));
    state->job = std::move(loaded->job);
    state->blank_mm = setup->blank->bounds_mm();
    const int most = available_threads();
    state->parallel = parallel_for_over(options.threads > 0 ? std::min(options.threads, most) : most);
    state->session = std::make_unique<session::MillSession>(std::move(*setup), state->parallel);
    return Mill(std::move(state));
}

Warnings Mill::warnings() const {
    Warnings all = state_->warnings;
    if (!state_->done) return all;
    const Warnings found = session::warnings_of(totals(), state_->file, state_->job.path.file);
    all.insert(all.end(), found.begin(), found.end());
    return all;
}

double Mill::duration_s() const {
    return state_->session->duration_s();
}

const std::vector<milling::Cutter>& Mill::cutters() const {
    return state_->session->setup().cutters;
}

bool Mill::run(const OnRow& on_row, const OnProgress& on_progress) {
    state_->done = state_->session->run({on_row, on_progress}) || state_->done;
    return state_->done;
}

bool Mill::run_to(double t_s, const OnRow& on_row, const OnProgress& on_progress) {
    return state_->session->run_to(t_s, {on_row, on_progress});
}

contact::ContactSample Mill::contact(const milling::CutRow& row, const milling::RowForce& force,
                                     double t_s) const {
    return session::contact_of_cut(row, force, cutters()[row.cutter].flutes, t_s);
}

const session::MillTotals& Mill::totals() const {
    return state_->session->totals();
}

TriangleMesh Mill::part() const {
    return field::fine_contour(state_->session->stock(), state_->parallel);
}

const contact::DistanceField& Mill::surface() const {
    return state_->session->stock();
}

}  // namespace tribo

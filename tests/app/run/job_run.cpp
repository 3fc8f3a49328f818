// SPDX-License-Identifier: MIT
#include "app/run/job_run.hpp"

#include "job/loader.hpp"
#include "job/memory_source.hpp"
#include "session/cut/mill_setup.hpp"

namespace tribo::test {

JobRun run_job(const std::map<std::string, std::string>& files, double cell_mm) {
    JobRun run;
    const auto loaded = job::load_job(job::MemorySource(files), "job.toml");
    if (!loaded) return run.error = loaded.error().text(), run;
    run.warnings = loaded->warnings;
    auto setup = session::prepare_mill(*loaded, {.cell_mm = cell_mm, .until_s = {}}, run.warnings);
    if (!setup) return run.error = setup.error().text(), run;
    run.job = loaded->job;
    run.coefficients = setup->coefficients;
    session::MillSession session(std::move(*setup), serial_for);
    session.run(session::keep_rows(run.rows));
    run.totals = session.totals();
    return run;
}

}  // namespace tribo::test

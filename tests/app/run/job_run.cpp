// SPDX-License-Identifier: MIT
#include "app/run/job_run.hpp"

#include "field/shape/box_shape.hpp"
#include "files/scratch.hpp"
#include "job/program_file.hpp"
#include "job/toml/job_toml.hpp"
#include "session/cut/mill_setup.hpp"

namespace tribo::test {

JobRun run_job(const std::map<std::string, std::string>& files, double cell_mm) {
    const Scratch scratch;
    for (const auto& [name, text] : files) scratch.put(name, text);
    JobRun run;
    const auto job = job::read_job(scratch / "job.toml");
    if (!job) return run.error = job.error().text(), run;
    auto program = job::read_program(*job);
    if (!program) return run.error = program.error().text(), run;
    session::MillInputs inputs;
    inputs.program = std::move(*program);
    inputs.blank = std::make_unique<field::BoxShape>(job->stock.box_mm);
    inputs.blank_volume_mm3 = job->stock.box_mm.volume();
    for (const job::JobSolid& fixture : job->fixtures) {
        inputs.fixtures.push_back(std::make_unique<field::BoxShape>(fixture.box_mm));
    }
    auto setup =
        session::prepare_mill(*job, std::move(inputs), {.cell_mm = cell_mm, .until_s = {}}, run.warnings);
    if (!setup) return run.error = setup.error().text(), run;
    run.job = *job;
    run.coefficients = setup->coefficients;
    session::MillSession session(std::move(*setup), serial_for);
    session.run(session::keep_rows(run.rows));
    run.totals = session.totals();
    return run;
}

}  // namespace tribo::test

// SPDX-License-Identifier: MIT
// `tribo sweep SWEEP.toml`: the flags. And the verb by which it starts its workers.
#include "app/sweep/sweep.hpp"

#include <map>
#include <memory>

#include "app/options.hpp"
#include "app/sweep/sweep_worker.hpp"
#include "app/verbs/verbs.hpp"
#include "tribo/threads.hpp"

namespace tribo::app {

void add_sweep(CLI::App& program, int& exit_code) {
    const auto call = std::make_shared<SweepCall>();
    CLI::App* verb =
        program.add_subcommand("sweep", "Run many cases of a job: here on all cores, or on a cluster");
    verb->add_option("SWEEP", call->file, "File of the sweep (TOML)")->required();
    verb->add_option("--out", call->out, "Folder of the cases and results; finished cases in it are kept")
        ->type_name("DIR");
    verb->add_option("--engine", call->engine, "Where the cases run: local or slurm")
        ->transform(CLI::CheckedTransformer(
            std::map<std::string, SweepEngine>{{"local", SweepEngine::local}, {"slurm", SweepEngine::slurm}}))
        ->type_name("WHERE");
    verb->add_option("--workers", call->workers, "Processes at the same time")
        ->check(CLI::Range(1, kMaxThreads))
        ->type_name("N");
    CLI::Option* dry =
        verb->add_flag("--dry-run", call->dry_run, "Say how many cases there are, and what they take");
    CLI::Option* status =
        verb->add_flag("--status", call->status, "Say how many cases are finished")->excludes(dry);
    verb->add_option("--case", call->only_case, "Run this case alone and print its results; from 0")
        ->excludes(dry)
        ->excludes(status)
        ->type_name("N");
    verb->callback([call, &exit_code] { exit_code = sweep(*call); });
}

void add_sweep_worker(CLI::App& program, int& exit_code) {
    const auto call = std::make_shared<SweepWorkerCall>();
    const auto memory_mb = std::make_shared<double>(0);
    CLI::App* verb = program.add_subcommand(kSweepWorkerVerb)->group("");
    verb->add_option("SWEEP", call->sweep)->required();
    verb->add_option("--digest", call->digest);
    verb->add_option("--cases", call->cases)->required();
    verb->add_option("--restart", call->restart);
    verb->add_option("--memory", *memory_mb);
    verb->add_option("--numbers", call->numbers);
    verb->add_option("--first", call->first);
    verb->add_option("--of", call->of)->check(CLI::PositiveNumber);
    verb->callback([call, memory_mb, &exit_code] {
        call->memory_bytes = 1e6 * *memory_mb;
        exit_code = sweep_worker(*call);
    });
}

}  // namespace tribo::app

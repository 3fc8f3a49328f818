// SPDX-License-Identifier: MIT
// `tribo audit JOB`: the flags.
#include "app/audit/audit.hpp"

#include <memory>

#include "app/options.hpp"
#include "app/uncertain_flag.hpp"
#include "app/verbs/verbs.hpp"

namespace tribo::app {

void add_audit(CLI::App& program, int& exit_code) {
    const auto call = std::make_shared<AuditCall>();
    CLI::App* verb = program.add_subcommand(
        "audit", "Say whether cutter, spindle and part stand a job or a program, and where it is worst");
    add_job(*verb, call->job, "Job file (TOML), or a program; - is standard input", call->program)
        ->required();
    verb->add_option(
            "--out", call->out,
            "Folder for audit.csv, audit.json and audit.html; an older one of Tribo's is replaced whole")
        ->type_name("DIR");
    verb->add_option("--resolution", call->resolution_mm, "Spacing of the grid that finds the surface")
        ->check(within(kLimits.resolution))
        ->type_name("MM");
    verb->add_option("--fail-over", call->fail_over,
                     "Exit with 4 if any load is more than this times its limit, or something collides")
        ->check(within(kLimits.fail_ratio))
        ->type_name("RATIO");
    verb->add_flag("--stable", call->stable, "Propose spindle speeds at which the tools do not chatter");
    add_uncertain(*verb, call->uncertain);
    verb->add_flag("--json", call->json, "Print one JSON object");
    verb->callback([call, &exit_code] { exit_code = audit(*call); });
}

}  // namespace tribo::app

// SPDX-License-Identifier: MIT
// `tribo live JOB`: the flags.
#include <memory>

#include "app/live.hpp"
#include "app/options.hpp"
#include "app/threads.hpp"
#include "app/verbs.hpp"

namespace tribo::app {

void add_live(CLI::App& program, int& exit_code) {
    const auto call = std::make_shared<LiveCall>();
    CLI::App* verb = program.add_subcommand("live", "Mill a job before the eyes of a browser");
    verb->add_option("JOB", call->job, "Job file (TOML)")->required();
    verb->add_option("--port", call->port, "Port to serve on; 0 takes any that is free")
        ->check(CLI::Range(0, 65535))
        ->capture_default_str();
    verb->add_flag("--open", call->open, "Open the page in a browser");
    verb->add_option("--web-root", call->web_root, "Folder of the built page")->type_name("DIR");
    verb->add_option("--resolution", call->resolution_mm, "Spacing of the grid that finds the surface")
        ->check(finite_number(0, 100))
        ->type_name("MM");
    verb->add_option("--threads", call->threads, "Threads to use; all processors if absent")
        ->check(CLI::Range(1, kMaxThreads))
        ->type_name("N");
    verb->add_option("--device", call->device,
                     "auto, simulated, or the arm's name as `tribo devices` says it")
        ->capture_default_str();
    verb->callback([call, &exit_code] { exit_code = live(*call); });
}

}  // namespace tribo::app

// SPDX-License-Identifier: MIT
// `tribo render JOB --out DIR`: the flags.
#include "app/render/render.hpp"

#include <memory>
#include <string>
#include <vector>

#include "app/options.hpp"
#include "app/uncertain_flag.hpp"
#include "app/verbs/verbs.hpp"
#include "tribo/threads.hpp"

namespace tribo::app {

void add_render(CLI::App& program, int& exit_code) {
    const auto call = std::make_shared<RenderCall>();
    const auto only = std::make_shared<std::vector<std::string>>();
    CLI::App* verb =
        program.add_subcommand("render", "Mill a job or a program: part, forces, sound and report as files");
    add_job(*verb, call->job, "Job file (TOML), or a program; - is standard input", call->program)
        ->required();
    verb->add_option("--out", call->out, "Folder for the results; an older one of Tribo's is replaced whole")
        ->required()
        ->type_name("DIR");
    verb->add_option("--resolution", call->resolution_mm, "Spacing of the grid that finds the surface")
        ->check(within(kLimits.resolution))
        ->type_name("MM");
    verb->add_option("--until", call->until_s, "Stop the program at this time")
        ->check(within(kLimits.until))
        ->type_name("S");
    verb->add_option("--sample-rate", call->sample_rate_hz, "Of sound.wav: 48000 or 44100")
        ->check(CLI::IsMember({44100, 48000}))
        ->type_name("HZ");
    verb->add_option("--only", *only,
                     "Write only these: summary, forces, sound, mesh, report, surface (comma separated)")
        ->delimiter(',')
        ->check(one_of({"summary", "forces", "sound", "mesh", "report", "surface"}))
        ->type_name("LIST");
    verb->add_option("--memory", call->memory_mb,
                     "Refuse a job that could take more; half of the machine's if absent")
        ->check(within(kLimits.memory))
        ->type_name("MB");
    add_uncertain(*verb, call->uncertain);
    verb->add_flag(
        "--as-published", call->as_published,
        "Forces by the paper's equations 2 to 5 beside the corrected ones, sound by its equation 23");
    verb->add_option("--threads", call->threads, "Threads to use; all processors if absent")
        ->check(CLI::Range(1, kMaxThreads))
        ->type_name("N");
    verb->callback([call, only, &exit_code] {
        call->only.insert(only->begin(), only->end());
        exit_code = render(*call);
    });
}

}  // namespace tribo::app

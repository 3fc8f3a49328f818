// SPDX-License-Identifier: MIT
// `tribo feel JOB --stroke CSV --out TRACE.csv`: the flags.
#include "app/feel/feel.hpp"

#include <memory>
#include <string>

#include "app/options.hpp"
#include "app/verbs/verbs.hpp"
#include "tribo/threads.hpp"

namespace tribo::app {

void add_feel(CLI::App& program, int& exit_code) {
    const auto call = std::make_shared<FeelCall>();
    const auto texture = std::make_shared<std::string>("on"), scaling = std::make_shared<std::string>("gain");
    CLI::App* verb = program.add_subcommand("feel", "Touch the milled part along a stroke: a force per tick");
    add_job(*verb, call->job, "Job file (TOML), a program, or a model to touch as it is", call->program)
        ->required();
    verb->add_option("--stroke", call->stroke, "Where the hand goes: t_s,x_mm,y_mm,z_mm")
        ->required()
        ->type_name("CSV");
    verb->add_option("--out", call->out, "The trace: t_s,x_mm,y_mm,z_mm,fx_n,fy_n,fz_n,contact")
        ->required()
        ->type_name("CSV");
    verb->add_option("--mode", call->mode, "inspect: the part after the program; cut: the cut itself")
        ->check(CLI::IsMember({"cut", "inspect"}));
    verb->add_option("--device", call->device,
                     "simulated: a hand that yields; playback: exactly on the stroke; or an arm's name")
        ->check(device_name({"simulated", "playback"}))
        ->type_name("NAME");
    verb->add_option("--rate", call->rate_hz, "Ticks per second, 100 to 20000; 1000 if absent")
        ->check(within(kLimits.servo_rate))
        ->type_name("HZ");
    verb->add_option("--probe-mm", call->probe_mm, "Radius of the probe; 0, a point, if absent")
        ->check(within(kLimits.probe_radius))
        ->type_name("R");
    verb->add_option("--stiffness", call->stiffness_n_per_mm,
                     "Of the surface; the job's, else 0.5, at most the device's")
        ->check(within(kLimits.surface_stiffness))
        ->type_name("N_PER_MM");
    verb->add_option(
            "--friction", call->friction_static,
            "Static coefficient of friction; the job's, else none; the kinetic one too if that is absent")
        ->check(within(kLimits.friction))
        ->type_name("MU");
    verb->add_option("--friction-kinetic", call->friction_kinetic,
                     "Kinetic coefficient, at most the static one")
        ->check(within(kLimits.friction))
        ->type_name("MU");
    verb->add_option("--unit-mm", call->unit_mm,
                     "Of a model: millimetres per unit of the file, 1000 for metres, 25.4 for inches")
        ->check(within(kLimits.unit))
        ->type_name("MM");
    verb->add_option("--scale", call->scale, "Of a model: so many times as large; 1 if absent")
        ->check(within(kLimits.model_scale))
        ->type_name("TIMES");
    verb->add_option("--source", call->source,
                     "A library with a force of your own (docs/feel.md), handed what Tribo would give")
        ->type_name("PLUGIN.so");
    add_arm_flags(*verb, call->arm);
    verb->add_option("--resolution", call->resolution_mm, "Spacing of the grid that finds the surface")
        ->check(within(kLimits.resolution))
        ->type_name("MM");
    verb->add_option("--until", call->until_s, "Stop the program at this time")
        ->check(within(kLimits.until))
        ->type_name("S");
    verb->add_option("--texture", *texture, "The grooves' own force in cut mode; on if absent")
        ->check(CLI::IsMember({"on", "off"}));
    verb->add_option(
            "--scaling", *scaling,
            "From the cutter's newtons to the hand's: gain clamps, compressive never reaches the limit")
        ->check(CLI::IsMember({"gain", "compressive"}));
    verb->add_option("--profile", call->profile, "What this user can tell apart; the job's, else the default")
        ->type_name("TOML");
    verb->add_option("--bake", call->bake, "Keep the table of cutting forces in this file")
        ->type_name("FILE");
    verb->add_option("--stats", call->stats, "Times of the servo's ticks as JSON")->type_name("FILE");
    verb->add_flag("--real-time", call->real_time,
                   "Tick by the clock even without an arm, in the real-time class where allowed");
    verb->add_option("--threads", call->threads, "Threads to mill with; all processors if absent")
        ->check(CLI::Range(1, kMaxThreads))
        ->type_name("N");
    verb->callback([=, &exit_code] {
        call->texture = *texture == "on";
        call->compressive = *scaling == "compressive";
        exit_code = feel(*call);
    });
}

}  // namespace tribo::app

// SPDX-License-Identifier: MIT
// `tribo live [JOB]`: the flags.
#include "app/live/live.hpp"

#include <memory>

#include "app/options.hpp"
#include "app/uncertain_flag.hpp"
#include "app/verbs/verbs.hpp"
#include "net/addresses.hpp"
#include "tribo/threads.hpp"

namespace tribo::app {

void add_live(CLI::App& program, int& exit_code) {
    const auto call = std::make_shared<LiveCall>();
    CLI::App* verb = program.add_subcommand("live", "Mill a job before the eyes of a browser");
    add_job(
        *verb, call->job,
        "Job file (TOML), or a program; without one the bench is empty and mills what is dropped into the "
        "page",
        call->program);
    verb->add_option("--port", call->port, "Port to serve on; 0 takes any that is free")
        ->check(CLI::Range(0, 65535))
        ->capture_default_str();
    verb->add_option("--listen", call->listen, "Address to serve on; 0.0.0.0 lets other machines in")
        ->check([](const std::string& text) {
            return net::is_address(text) ? "" : "'" + text + "' is no address in digits, such as 0.0.0.0";
        })
        ->type_name("ADDR")
        ->capture_default_str();
    CLI::Option* certificate =
        verb->add_option("--tls-cert", call->tls_certificate, "Certificate for https, in PEM")
            ->type_name("FILE");
    CLI::Option* key = verb->add_option("--tls-key", call->tls_key, "Its key, in PEM")->type_name("FILE");
    certificate->needs(key);
    key->needs(certificate);
    verb->add_flag("--open", call->open, "Open the page in a browser");
    verb->add_option("--web-root", call->web_root, "Folder of the built page")->type_name("DIR");
    verb->add_option("--resolution", call->resolution_mm, "Spacing of the grid that finds the surface")
        ->check(within(kLimits.resolution))
        ->type_name("MM");
    verb->add_option("--memory", call->memory_mb,
                     "Refuse a job that could take more; half of the machine's if absent")
        ->check(within(kLimits.memory))
        ->type_name("MB");
    verb->add_option("--threads", call->threads, "Threads to use; all processors if absent")
        ->check(CLI::Range(1, kMaxThreads))
        ->type_name("N");
    add_uncertain(*verb, call->uncertain);
    verb->add_option("--device", call->device,
                     "auto, simulated, or the arm's name as `tribo devices` says it")
        ->check(device_name({"simulated"}))
        ->capture_default_str();
    add_arm_flags(*verb, call->arm);
    verb->add_option("--audio", call->audio, "Who sounds: the page, this machine's loudspeaker, or nobody")
        ->check(CLI::IsMember({"browser", "native", "off"}))
        ->capture_default_str();
    verb->callback([call, &exit_code] { exit_code = live(*call); });
}

}  // namespace tribo::app

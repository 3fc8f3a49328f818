// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <new>

#include "app/exit.hpp"
#include "app/interrupt.hpp"
#include "app/options.hpp"
#include "app/verbs/verbs.hpp"

namespace {

int run(int argc, char** argv) {
    using namespace tribo::app;
    int exit_code = kDone;
    CLI::App program("Tribo renders contact to three senses: see, hear and feel the cut.", "tribo");
    program.set_version_flag("--version", "tribo " TRIBO_VERSION, "Print the version");
    program.set_help_flag("--help,-h", "Print this help");
    program.get_formatter()->column_width(34);
    add_render(program, exit_code);
    add_read_sofa(program, exit_code);
    add_live(program, exit_code);
    add_inspect(program, exit_code);
    add_learn(program, exit_code);
    add_rub(program, exit_code);
    add_feel(program, exit_code);
    add_press(program, exit_code);
    add_site(program, exit_code);
    add_stability(program, exit_code);
    add_audit(program, exit_code);
    add_feed(program, exit_code);
    add_compare(program, exit_code);
    add_sweep(program, exit_code);
    add_sweep_worker(program, exit_code);
    add_devices(program, exit_code);
    try {
        program.parse(argc, argv);
    } catch (const CLI::Success& success) {
        return program.exit(success);  // help or version, on stdout
    } catch (const CLI::ParseError& error) {
        std::fprintf(stderr, "%s\n", explain_usage(program, error).c_str());
        return kWrongInput;
    }
    if (program.get_subcommands().empty()) {
        std::fprintf(stderr, "error: no verb; see 'tribo --help'\n");
        return kWrongInput;
    }
    return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
    tribo::app::catch_signals();
    try {
        return run(argc, argv);
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "error: out of memory; try a coarser --resolution or a lower --memory\n");
    } catch (const std::exception& error) {
        std::fprintf(stderr, "error: internal: %s; please report this with the call that led to it\n",
                     error.what());
    }
    return tribo::app::kOurFault;
}

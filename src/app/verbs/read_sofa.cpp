// SPDX-License-Identifier: MIT
// `tribo read-sofa FILE`: the program starts it as a child process, in which a crash is harmless.
#include <CLI/App.hpp>
#include <memory>
#include <string>

#include "app/render/render_job.hpp"
#include "app/verbs/verbs.hpp"
#include "files/sound/hrir_file.hpp"

namespace tribo::app {

void add_read_sofa(CLI::App& program, int& exit_code) {
    const auto file = std::make_shared<std::string>();
    CLI::App* verb = program.add_subcommand(kReadSofaVerb, "Read head responses for another process");
    verb->group("");  // not in the help
    verb->add_option("FILE", *file, "SOFA file")->required();
    verb->callback([file, &exit_code] { exit_code = files::serve_hrirs(*file); });
}

}  // namespace tribo::app

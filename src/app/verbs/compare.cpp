// SPDX-License-Identifier: MIT
// `tribo compare A B --out DIR`: the flags.
#include "app/compare/compare.hpp"

#include <map>
#include <memory>

#include "app/options.hpp"
#include "app/verbs/verbs.hpp"

namespace tribo::app {

void add_compare(CLI::App& program, int& exit_code) {
    const auto call = std::make_shared<CompareCall>();
    CLI::App* verb = program.add_subcommand(
        "compare", "Two runs side by side: what changed in time, force, sound and part, and where");
    add_job(*verb, call->a, "The first run: a job (TOML), a program, or the folder of a render",
            call->program, "A")
        ->required();
    verb->add_option("B", call->b, "The second run, likewise")->required();
    verb->add_option("--out", call->out,
                     "Folder for compare.html, compare.json, compare.csv and the sounds; an older one of "
                     "Tribo's is replaced whole")
        ->required()
        ->type_name("DIR");
    verb->add_option(
            "--resolution", call->resolution_mm,
            "Spacing of the grid that finds the surface, for both; the finer one of theirs if absent")
        ->check(within(kLimits.resolution))
        ->type_name("MM");
    using session::JoinBy;
    verb->add_option("--by", call->by,
                     "Join both cuts by line, volume or time; by line if they cut in the same lines, else by "
                     "volume if they remove the same")
        ->transform(CLI::CheckedTransformer(std::map<std::string, JoinBy>{
            {"line", JoinBy::line}, {"volume", JoinBy::removed}, {"time", JoinBy::time}}))
        ->type_name("WAY");
    verb->add_flag("--json", call->json, "Print compare.json");
    verb->callback([call, &exit_code] { exit_code = compare(*call); });
}

}  // namespace tribo::app

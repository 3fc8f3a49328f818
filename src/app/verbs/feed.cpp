// SPDX-License-Identifier: MIT
// `tribo feed JOB --out NEW`: the flags.
#include "app/feed/feed.hpp"

#include <memory>

#include "app/exit.hpp"
#include "app/options.hpp"
#include "app/verbs/verbs.hpp"
#include "base/text/decimal.hpp"
#include "base/text/limit_text.hpp"

namespace tribo::app {
namespace {

// What is wrong with LO:HI; empty: nothing.
std::string read_chips(const std::string& text, std::pair<double, double>& chips) {
    const std::size_t colon = text.find(':');
    const auto read = [](std::string_view number, double& value) {
        return !number.empty() && parse_decimal(number, value) == number.size();
    };
    if (colon == text.npos || !read(std::string_view(text).substr(0, colon), chips.first) ||
        !read(std::string_view(text).substr(colon + 1), chips.second))
        return "'" + text + "' is no range of chips; write LO:HI, as 0.01:0.1";
    for (const double value : {chips.first, chips.second})
        if (!kLimits.chip_limit.range.contains(value))
            return out_of_range(kLimits.chip_limit, value) + "; " + range_remedy(kLimits.chip_limit);
    return chips.first < chips.second ? "" : "the least chip is not below the largest; exchange them";
}

}  // namespace

void add_feed(CLI::App& program, int& exit_code) {
    const auto call = std::make_shared<FeedCall>();
    const auto chips = std::make_shared<std::string>();
    CLI::App* verb = program.add_subcommand(
        "feed", "Write a program with the feeds that its loads allow: only its feed words change");
    add_job(*verb, call->job, "Job file (TOML), or a program", call->program)->required();
    CLI::Option* out = verb->add_option("--out", call->out, "File of the new program")->type_name("NEW");
    CLI::Option* in_place =
        verb->add_flag("--in-place", call->in_place, "Replace the program itself")->excludes(out);
    verb->add_option("--resolution", call->resolution_mm, "Spacing of the grid that finds the surface")
        ->check(within(kLimits.resolution))
        ->type_name("MM");
    verb->add_option("--force-n", call->force_n, "Largest force in a turn")
        ->check(within(kLimits.most_force))
        ->type_name("N");
    verb->add_option("--power-w", call->power_w, "Mean power of a turn")
        ->check(within(kLimits.most_power))
        ->type_name("W");
    verb->add_option("--stress", call->stress_n_per_mm2, "Bending stress of the cutter")
        ->check(within(kLimits.most_stress))
        ->type_name("N_PER_MM2");
    verb->add_option("--deflection-mm", call->deflection_mm, "Deflection of the tip")
        ->check(within(kLimits.most_deflection))
        ->type_name("MM");
    verb->add_option("--chip-mm", *chips, "Least and largest thickness of the chip")
        ->check(CLI::Validator(
            [](const std::string& text) {
                std::pair<double, double> read;
                return read_chips(text, read);
            },
            ""))
        ->type_name("LO:HI");
    verb->add_flag("--sure", call->sure,
                   "Stay within the limits at the worst end of the band of forces and limits");
    verb->add_flag("--stable", call->stable,
                   "First write spindle speeds at which the tools do not chatter; the chips stay");
    CLI::Option* unroll =
        verb->add_flag("--unroll", call->unroll,
                       "Write the program anew in plain words first: no loops, calls, cycles and variables");
    verb->add_option("--split", call->split_mm, "Longest straight block of a program that is written anew")
        ->check(within(kLimits.edge))
        ->needs(unroll)
        ->type_name("MM");
    verb->add_flag("--json", call->json, "Print one JSON object");
    verb->callback([call, chips, out, in_place, &exit_code] {
        if (out->empty() && in_place->empty()) {
            exit_code =
                report(Error{"", 0, 0, "no file for the new program", "add --out NEW, or --in-place"});
            return;
        }
        if (!chips->empty()) read_chips(*chips, call->chip_mm.emplace());
        exit_code = feed(*call);
    });
}

}  // namespace tribo::app

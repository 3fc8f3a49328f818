// SPDX-License-Identifier: MIT
#include "app/uncertain_flag.hpp"

#include "app/options.hpp"

namespace tribo::app {

void add_uncertain(CLI::App& verb, std::optional<int>& cases) {
    verb.add_option("--uncertain", cases,
                    "Bands from N cases of what the job knows with a spread: forces, run-out, modes")
        ->check(within(kLimits.uncertain_cases))
        ->type_name("N");
}

Result<void> check_uncertain(const std::string& file, std::optional<int> cases, bool has_spread) {
    if (!cases || has_spread) return {};
    return fail_at(
        file, 0, 0, "nothing in this job has a spread, so there is no band",
        "leave --uncertain out, or say how well a value is known: spread of [material], runout_spread of "
        "a cutter, frequency_spread, damping_spread or stiffness_spread of a mode");
}

}  // namespace tribo::app

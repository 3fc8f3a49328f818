// SPDX-License-Identifier: MIT
// Spindle speeds without chatter, as `tribo audit --stable` proposes them and `tribo feed --stable` writes
// them.
#pragma once

#include <string>
#include <vector>

#include "app/render/render_job.hpp"
#include "files/json/json.hpp"
#include "session/chatter/stable_speed.hpp"

namespace tribo::app {

struct SpeedAdvice {
    std::vector<session::StableSpeed> speeds;  // one per tool that cuts with the edges along it
    std::vector<int> tools;                    // their numbers; 0: without one
    std::vector<std::string> bounds;           // where `most_rpm` is from; empty: there is none
};

// Refuses a job in which nothing bends.
Result<void> check_bends(const job::Job& job);

// `search` has all rows of a run of the setup. A speed keeps to the end of [limits] `spindle` and to usual
// surface speeds.
SpeedAdvice advise_speeds(const session::StableSpeedSearch& search, const PreparedJob& loaded,
                          const session::MillSetup& setup, const ParallelFor& parallel);

// One clause per tool.
std::vector<std::string> in_words(const SpeedAdvice& advice);
files::Json speeds_json(const SpeedAdvice& advice);

}  // namespace tribo::app

// SPDX-License-Identifier: MIT
// A measured frequency response of a job, and what was fitted to it.
#pragma once

#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "base/vec3.hpp"
#include "dynamics/mode.hpp"
#include "dynamics/mode_fit.hpp"
#include "readers/response/frequency_response.hpp"

namespace tribo::job {

// [[frf]]
struct JobFrf {
    std::string file;
    Vec3 direction{1, 0, 0};  // unit
    dynamics::ModeOn on = dynamics::ModeOn::tool;
    std::optional<double> from_hz, to_hz;         // the band; both or none
    std::optional<int> modes;                     // how many to fit
    const readers::ResponseUnit* unit = nullptr;  // in place of what the file says
    std::optional<dynamics::ModeFit> fit;         // once the file is loaded
};

}  // namespace tribo::job

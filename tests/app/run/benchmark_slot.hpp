// SPDX-License-Identifier: MIT
// The benchmark of the literature as a job: two teeth, one mode (Insperger and Stepan 2004).
#pragma once

#include <string>

namespace tribo::test {

// Mills `slot.nc` at 8000 rpm. Without a mode.
inline constexpr const char* kBenchmarkSlot = R"([stock]
box_mm = [[0, 0, -10], [40, 40, 0]]
[cutter]
kind = "flat"
diameter_mm = 10
flutes = 2
helix_deg = 0
length_mm = 20
[material]
ktc_n_per_mm2 = 600
krc_n_per_mm2 = 200
kac_n_per_mm2 = 0
kte_n_per_mm = 0
kre_n_per_mm = 0
kae_n_per_mm = 0
[process]
spindle_rpm = 8000
feed_mm_per_min = 1600
[path]
gcode = "slot.nc"
)";

inline std::string benchmark_mode(const std::string& direction, const std::string& on = "tool") {
    return "[[mode]]\ndirection = [" + direction +
           "]\nfrequency_hz = 922\ndamping_ratio = 0.011\nstiffness_n_per_mm = 1340.0496480507\non = \"" +
           on + "\"\n";
}

}  // namespace tribo::test

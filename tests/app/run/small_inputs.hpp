// SPDX-License-Identifier: MIT
// The smallest inputs with which every verb runs.
#pragma once

namespace tribo::test {

// Mills `slot.nc`: a slot along y = 10, 2 mm deep. Without a measured head, whose preparation takes longer
// than the cut.
inline constexpr const char* kSlotJob = R"(
[stock]
box_mm = [[0, 0, -10], [30, 20, 0]]
[cutter]
kind = "flat"
diameter_mm = 6
flutes = 2
length_mm = 20
[material]
name = "al7075-t6"
[process]
spindle_rpm = 6000
feed_mm_per_min = 900
[path]
gcode = "slot.nc"
[sound]
mode = "pan"
)";
inline constexpr const char* kSlotProgram = "G21 G90\nG0 X-5 Y10 Z-2\nG1 X35\nM30\n";

inline constexpr const char* kVoicedMaterial = R"({"schema": "tribo.material/1", "stiffness_n_per_mm": 4,
 "viscosity_n_s_per_mm": 0.3, "voices": [
  {"speed_mm_per_s": 100, "level_db": -20, "sample_rate_hz": 48000, "reflection": [-0.5, 0.3]}]})";

}  // namespace tribo::test

// SPDX-License-Identifier: MIT

/** A job file: a ball cutter in a block, by the program p.nc. */
export function jobText(box_mm: string, more = ""): string {
  return `${more}[stock]
box_mm = ${box_mm}
[cutter]
kind = "ball"
diameter_mm = 6
flutes = 2
helix_deg = 30
length_mm = 20
[material]
name = "al7075-t6"
[process]
spindle_rpm = 9000
feed_mm_per_min = 1200
[path]
gcode = "p.nc"
`;
}

/** The slot of the benchmark (tests/app/run/benchmark_slot.hpp) by slot.nc, with its mode. */
export const BENDING_SLOT = `[stock]
box_mm = [[0, 0, -10], [60, 20, 0]]
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
[sound]
machine = "none"
[path]
gcode = "slot.nc"
[[mode]]
direction = [1, 0, 0]
frequency_hz = 922
damping_ratio = 0.011
stiffness_n_per_mm = 1340.0496480507
`;
/** 1 mm deep: it chatters at 8000 rpm, and not at 9000. */
export const SLOT_PROGRAM = "G21 G90\nG0 X-8 Y10 Z5\nG1 Z-1\nG1 X70\n";

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

// SPDX-License-Identifier: MIT
// Makes pocket.nc: a pocket of 40 x 24 x 4 mm whose program has three mistakes in its feeds.
import { writeFileSync } from "node:fs";

const lines = [
  "(POCKET 40 X 24 X 4, T1 D=6 FLAT END MILL)",
  "G21 G90 G17 G94",
  "T1 M6",
  "S12000 M3",
  "G0 X0 Y0 Z5",
  "Z1",
];
const half = { x: 20 - 3, y: 12 - 3 }; // of the path of the wall
const finish = 0.2; // left for the last pass
const sidestep = 2.4;
lines.push("G1 Z-4 F1500 (A PLUNGE AT THE FEED OF SIDE MILLING)");
lines.push("X11 (A SLOT OF FULL WIDTH AT THE SAME FEED)", "X-11", "X0");
// Rectangles from the inside out.
for (let y = sidestep; y < half.y - finish + sidestep; y += sidestep) {
  const out = Math.min(y, half.y - finish);
  const x = half.x - half.y + out;
  for (const corner of [`Y${-out}`, `X${x}`, `Y${out}`, `X${-x}`, `Y${-out}`, "X0"])
    lines.push(corner.replace(/\d+\.\d+/, (number) => Number(number).toFixed(2)));
}
lines.push("Y0");
lines.push(
  `Y${-half.y} F240 (A WALL SO SLOW THAT THE TEETH RUB)`,
  `X${half.x}`, `Y${half.y}`, `X${-half.x}`, `Y${-half.y}`, "X0", "Y0",
  "G0 Z5", "M5", "M30",
);
writeFileSync(new URL("pocket.nc", import.meta.url), lines.join("\n") + "\n");

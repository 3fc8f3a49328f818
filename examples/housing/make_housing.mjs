// Writes top.nc and bottom.nc beside this file: node make_housing.mjs
//
// A bearing housing of 56 x 36 x 20 mm out of a block of 60 x 40, milled from both sides. Each program counts from the lower
// left corner of the face that is up in its own set-up; between the two the part is turned over about the x axis.
import {writeFileSync} from 'node:fs';

const WIDTH = 60, HEIGHT = 40, WALL = 2, CORNER = 8, X = WIDTH / 2, Y = HEIGHT / 2;

// Around the outside, clockwise seen from above, so that the material stays on the right: climb milling.
function outline(tool, depths) {
  const r = CORNER + tool / 2, low = WALL - tool / 2, right = WIDTH - low, top = HEIGHT - low, lines = [];
  lines.push(`G0 X${low - tool} Y${Y}`);
  for (const z of depths) {
    lines.push(`G0 Z${z}`, `G1 X${low} F600`, `Y${top - r}`, `G2 X${low + r} Y${top} I${r} J0`, `G1 X${right - r}`,
      `G2 X${right} Y${top - r} I0 J-${r}`, `G1 Y${low + r}`, `G2 X${right - r} Y${low} I-${r} J0`, `G1 X${low + r}`,
      `G2 X${low} Y${low + r} I0 J${r}`, `G1 Y${Y}`, `G0 X${low - tool}`);
  }
  lines.push('G0 Z10');
  return lines;
}

// A round pocket about the middle: down a helix, then circles, each a little wider, counter-clockwise.
function pocket(tool, diameter, depth, down, ramp) {
  const widest = diameter / 2 - tool / 2, across = 0.45 * tool, start = Math.min(widest, across), lines = [];
  const circle = (r, z) => `G3 X${X + r} Y${Y} I${-r} J0${z === undefined ? '' : ` Z${z}`} F500`;
  lines.push(`G0 X${X + start} Y${Y}`, 'G0 Z1', 'G1 Z0 F300');
  for (let z = 0; z > -depth;) {
    const next = Math.max(-depth, z - down);
    lines.push(`G1 X${X + start} F500`);
    while (z > next) lines.push(circle(start, z = Math.max(next, z - ramp)));
    for (let r = start; ; r = Math.min(widest, r + across)) {
      if (r > start) lines.push(`G1 X${X + r}`);
      lines.push(circle(r));
      if (r === widest) break;
    }
  }
  lines.push(`G1 X${X}`, 'G0 Z10');
  return lines;
}

const program = (side, lines) => ['%', `(housing, ${side}: zero at the lower left corner of the face that is up)`,
  '(T1 D=10 CR=0 flat end mill, 3 flutes)', '(T2 D=6 CR=0 flat end mill, 2 flutes)', 'G21 G90 G17 G94 G40 G49 G80',
  ...lines, 'M5', 'M30', '%', ''].join('\n');

// The seat of the bearing, and more than half of the outside.
writeFileSync(new URL('top.nc', import.meta.url), program('first side', [
  'T1 M6', 'S9000 M3', 'G0 Z10', ...pocket(10, 28, 9, 3, 0.75), ...outline(10, [-4, -8, -12])]));
// The bore down into that seat, a recess about it, and the rest of the outside.
writeFileSync(new URL('bottom.nc', import.meta.url), program('second side', [
  'T1 M6', 'S9000 M3', 'G0 Z10', ...outline(10, [-4, -8.5]), ...pocket(10, 22, 3, 3, 0.75),
  'T2 M6', 'S12000 M3', 'G0 Z10', ...pocket(6, 14, 12, 3, 0.5)]));

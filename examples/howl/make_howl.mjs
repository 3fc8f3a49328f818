// Writes the programs of this folder: node make_howl.mjs
//
// A slot that takes nine seconds, for a cutter that bends along it, and the two sides of a thin wall.
import {writeFileSync} from 'node:fs';

const write = (name, lines) =>
  writeFileSync(new URL(name, import.meta.url), `%\n${lines.join('\n')}\nM30\n%\n`);

write('slot.nc', [
  '(slot: 240 x 20 x 10, top of stock at Z0, 1 mm deep along the middle)',
  '(speed and feed are those of the job)',
  'G21 G90 G17 G94 G40 G49 G80',
  'M3',
  'G0 X-7 Y10 Z5',
  'G0 Z-1',
  'G1 X247',
  'G0 Z5',
]);

// 2.5 mm thick before; a quarter of a millimetre off each side, climbing: the wall lies to the right of the feed.
// The same chip at both speeds.
write('wall.nc', [
  '(wall: 60 long, 2.5 thick, 25 high, top at Z0; 0.25 mm off both sides of its upper millimetre)',
  '(T1 D=8 CR=0 flat end mill, 3 flutes)',
  'G21 G90 G17 G94 G40 G49 G80',
  'T1 M6',
  '(one side at a speed that looks harmless)',
  'S8100 M3',
  'G0 X68 Y-3.75 Z5',
  'G0 Z-1',
  'G1 X-8 F972',
  '(the other one in a pocket of the chart)',
  'S12500',
  'G0 Y6.25',
  'G1 X68 F1500',
  'G0 Z5',
]);

// A step test: the same side cut, deeper from pass to pass.
const steps = [2, 3, 5];
write('steps.nc', [
  '(steps: 90 x 40 x 12, top at Z0; 3 mm of the side, 2, 3 and 5 mm deep, climbing)',
  '(T1 D=10 CR=0 flat end mill, 4 flutes)',
  'G21 G90 G17 G94 G40 G49 G80',
  'T1 M6',
  'S6200 M3',
  ...steps.flatMap((depth, n) => [
    `(${depth} mm deep)`,
    `G0 X96 Y${3 * n - 2} Z5`,
    `G0 Z${-depth}`,
    'G1 X-6 F1984',
    'G0 Z5',
  ]),
]);

// Two taps with a hammer at the tip, as a measuring program would save them: modes, residual compliance, 1 %
// of noise.
const modes = {
  x: [[780, 0.035, 9000], [1640, 0.03, 26000]],
  y: [[820, 0.03, 11000], [1710, 0.03, 30000]],
};
let seed = 20261124;
const noise = () => {
  // A sum of twelve even numbers is nearly Gaussian (Park and Miller 1988 for the numbers).
  let sum = -6;
  for (let n = 0; n < 12; n++) sum += (seed = (seed * 48271) % 2147483647) / 2147483647;
  return sum;
};
for (const [axis, of] of Object.entries(modes)) {
  const lines = ['frequency_hz,re_mm_per_n,im_mm_per_n'];
  const peak = Math.max(...of.map(([, zeta, k]) => 1 / (2 * zeta * k)));
  for (let hz = 200; hz <= 2600; hz += 4) {
    let re = 1 / 120000, im = 0;
    for (const [f, zeta, k] of of) {
      const r = hz / f, a = 1 - r * r, b = 2 * zeta * r, size = k * (a * a + b * b);
      re += a / size;
      im -= b / size;
    }
    lines.push([hz, ...[re, im].map(v => (v + 0.01 * peak * noise()).toExponential(5))].join(','));
  }
  writeFileSync(new URL(`tap_${axis}.csv`, import.meta.url), lines.join('\n') + '\n');
}

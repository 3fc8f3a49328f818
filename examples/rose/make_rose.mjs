// Writes rose.nc beside this file: node make_rose.mjs
//
// A rose of five rings of petals, engraved with a ball nose of 3 mm. Each ring is one closed rational B-spline of order
// 4 (G5.2 ... G5.3): the valleys between petals and the petals' tips are control points, and their weights (P) say how
// close the curve comes to them.
import {writeFileSync} from 'node:fs';

const out = [];
const say = (...words) => out.push(words.join(' '));
const n = v => Number(v.toFixed(4)) + 0;
const at = (r, degrees) => {
  const a = degrees * Math.PI / 180;
  return `X${n(r * Math.cos(a))} Y${n(r * Math.sin(a))}`;
};

say('%');
say('(rose: 80 x 80 x 10, origin at the middle of the top)');
say('(T1 D=3 CR=1.5 ball end mill, 2 flutes)');
say('G21 G90 G17 G94 G40 G49 G80 G54');
say('T1 M6');
say('S18000 M3');
const rings = [
  {radius: 27, petals: 8, turn: 0, depth: 1.2},
  {radius: 21, petals: 8, turn: 22.5, depth: 1.1},
  {radius: 15, petals: 6, turn: 10, depth: 1.0},
  {radius: 9.5, petals: 5, turn: 40, depth: 0.9},
  {radius: 4.5, petals: 3, turn: 0, depth: 0.8},
];
for (const {radius, petals, turn, depth} of rings) {
  const step = 360 / petals, valley = 0.72 * radius;
  say(`(${petals} petals)`);
  say(`G0 ${at(valley, turn)} Z5`);
  say('G0 Z1');
  for (const z of [depth / 2, depth]) {
    say(`G1 Z${n(-z)} F200`);
    say('F900');
    say('G5.2 P1 L4');
    for (let k = 0; k < petals; ++k) {
      const from = turn + k * step;
      say(`${at(1.1 * radius, from + 0.04 * step)} P1.5`);
      say(`${at(1.42 * radius, from + 0.5 * step)} P2`);
      say(`${at(1.1 * radius, from + 0.96 * step)} P1.5`);
      say(`${at(valley, from + step)} P4`);
    }
    say('G5.3');
  }
  say('G0 Z5');
}
say('M5');
say('M30');
say('%');
writeFileSync(new URL('rose.nc', import.meta.url), out.join('\n') + '\n');

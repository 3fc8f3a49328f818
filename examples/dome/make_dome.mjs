// Writes dome.nc beside this file: node make_dome.mjs
//
// A spherical cap of radius 45 mm on a block of 80 x 80 x 30 mm, on a table that tilts (A) and turns (C): roughed level
// by level with the table flat, then finished along one spiral from the rim to the top with tool tip control. The ball
// nose leans 20 degrees away from the surface's normal, so that it never cuts with its tip, which stands still.
import {writeFileSync} from 'node:fs';

const out = [];
const say = (...words) => out.push(words.join(' '));
const n = v => Number(v.toFixed(4)) + 0;
const rad = degrees => degrees * Math.PI / 180;

const radius = 45, centre = -45.5, rim = 49.9; // mm, mm, degrees from the top
const across = z => Math.sqrt(Math.max(0, radius * radius - (z - centre) ** 2));

say('%');
say('(dome: spherical cap of 45 mm, origin at the middle of the top of the block)');
say('(T1 D=12 CR=0 flat end mill, 4 flutes)');
say('(T2 D=8 CR=4 ball end mill, 2 flutes)');
say('G21 G90 G17 G94 G40 G49 G80 G54');
say('T1 M6');
say('S6000 M3');
say('G0 A0 C0');
say('(rough level by level, 0.5 mm left)');
const flat = 6, left = 0.5;
const from = 66;
say(`G0 X${from} Y0 Z20`);
for (let z = -3; z >= -18; z -= 3) {
  const inner = across(z - left) + left + flat;
  say(`G0 X${from} Y0`);
  say(`G0 Z${z}`);
  for (let r = 62 - ((62 - inner) % 8); r > inner - 1e-9; r -= 8) {
    say(`G1 X${n(r)} Y0 F1200`);
    say(`G2 X${n(r)} Y0 I${n(-r)} J0 F1000`);
  }
  say('G0 Z20');
}

say('(finish: one spiral with tool tip control)');
say('T2 M6');
say('S9000 M3');
const ball = 4, step = 3, sidestep = 1.5, lean = 20;
const fall = sidestep / radius * 180 / Math.PI * step / 360; // degrees towards the top per block
const place = (polar, turn) => {
  const tilt = Math.max(polar - lean, 0);
  const axis = [Math.sin(rad(tilt)) * Math.cos(rad(turn)), Math.sin(rad(tilt)) * Math.sin(rad(turn)), Math.cos(rad(tilt))];
  const normal = [Math.sin(rad(polar)) * Math.cos(rad(turn)), Math.sin(rad(polar)) * Math.sin(rad(turn)), Math.cos(rad(polar))];
  const tip = normal.map((u, k) => (k === 2 ? centre : 0) + (radius + ball) * u - ball * axis[k]);
  return `X${n(tip[0])} Y${n(tip[1])} Z${n(tip[2])} A${n(tilt)} C${n(90 - turn)}`;
};
say('G43.4 H2');
say(`G0 ${place(rim, 0).replace(/Z[-.0-9]+/, 'Z20')}`);
say(`G1 ${place(rim, 0)} F600`);
say('F1500');
let turn = 0;
for (let polar = rim; polar > 1; polar -= fall) {
  turn += step;
  say(`G1 ${place(polar - fall, turn)}`);
}
say('G0 Z20');
say('G49');
say('M5');
say('M30');
say('%');
writeFileSync(new URL('dome.nc', import.meta.url), out.join('\n') + '\n');

// Writes plate.nc beside this file: node make_plate.mjs
//
// A plate of 80 x 60 x 12 mm: faced, a pocket with round corners cleared in two levels, a slot along an arc, four
// holes opened by helices, one tool of 8 mm.
import {writeFileSync} from 'node:fs';

const out = [];
const say = (...words) => out.push(words.join(' '));
const n = v => Number(v.toFixed(4));

say('%');
say('(plate: 80 x 60 x 12, top of stock at Z0, origin at the lower left corner)');
say('(T1 D=8 CR=0 flat end mill, 3 flutes)');
say('G21 G90 G17 G94 G40 G49 G80');
say('T1 M6');
say('S8000 M3');
say('G54');
say('G0 X-8 Y3 Z5');
say('(face off 0.5 mm)');
say('G1 Z-0.5 F300');
let right = true;
for (let y = 3; y <= 60; y += 6) {
  say(`G1 Y${n(y)} F1200`);
  say(`G1 X${right ? 88 : -8}`);
  right = !right;
}
say('G0 Z5');

say('(pocket 40 x 28, corners 6 mm, 4 mm deep in two levels)');
const cx = 32, cy = 30, w = 40, h = 28, tool = 4, corner = 6;
for (const z of [-2.5, -4.5]) {
  say(`G0 X${cx - 8} Y${cy}`);
  say('G0 Z1');
  say(`G1 Z${z + 2} F300`);
  say(`G1 X${cx + 8} Z${z + 1} F400`);
  say(`G1 X${cx - 8} Z${z}`);
  say(`G1 X${cx + 8} F900`);
  for (let inset = 8; inset >= 0; inset -= 4) {
    const x0 = cx - w / 2 + tool + inset, x1 = cx + w / 2 - tool - inset;
    const y0 = cy - h / 2 + tool + inset, y1 = cy + h / 2 - tool - inset;
    const r = corner - tool;
    say(`G1 X${n(cx)} Y${n(y1)}`);
    // Counter-clockwise around the inside: climb milling.
    say(`G1 X${n(x0 + r)}`);
    say(`G3 X${n(x0)} Y${n(y1 - r)} I0 J${-r}`);
    say(`G1 Y${n(y0 + r)}`);
    say(`G3 X${n(x0 + r)} Y${n(y0)} I${r} J0`);
    say(`G1 X${n(x1 - r)}`);
    say(`G3 X${n(x1)} Y${n(y0 + r)} I0 J${r}`);
    say(`G1 Y${n(y1 - r)}`);
    say(`G3 X${n(x1 - r)} Y${n(y1)} I${-r} J0`);
    say(`G1 X${n(cx)}`);
  }
  say('G0 Z5');
}

say('(slot along an arc, 2 mm deep)');
say('G0 X58 Y12');
say('G0 Z1');
say('G1 Z-2.5 F200');
say('G3 X58 Y48 R24 F700');
say('G0 Z5');

say('(four holes of 11 mm, helical)');
for (const [x, y] of [[7, 7], [73, 7], [73, 53], [7, 53]]) {
  say(`G0 X${x + 1.5} Y${y}`);
  say('G0 Z0');
  say('G1 Z-0.5 F200');
  for (let z = -2; z >= -8; z -= 1.5) say(`G3 X${x + 1.5} Y${y} Z${n(z)} I-1.5 J0 F500`);
  say(`G3 X${x + 1.5} Y${y} I-1.5 J0`);
  say('G0 Z5');
}
say('M5');
say('G0 X0 Y0 Z50');
say('M30');
say('%');
writeFileSync(new URL('plate.nc', new URL('.', import.meta.url)), out.join('\n') + '\n');

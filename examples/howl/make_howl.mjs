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

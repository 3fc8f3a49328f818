// Writes blade.apt (the program), blade.wrl (the designed part) and blank.wrl (its forging) beside this file:
// node make_blade.mjs
//
// A twisted, tapered blade, 36 mm wide at its foot and 30 mm high. A ball of 8 mm winds around it from the tip to the
// foot, 2 mm lower with each turn, its axis leaning 60 degrees from the surface towards the tip: around the edges it
// swings through half a turn within two millimetres. The forging has a millimetre more all around.
import {writeFileSync} from 'node:fs';

const height = 30, chord = 36, thickness = 7, camber = 2.5, twist = 24 * Math.PI / 180, taper = 0.25;
const radius = 4, lean = 60 * Math.PI / 180, pitch = 2, allowance = 1;

const add = (a, b, s = 1) => a.map((v, i) => v + s * b[i]);
const scaled = (a, s) => a.map(v => s * v);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = a => scaled(a, 1 / Math.hypot(...a));

// The section, counter-clockwise: an ellipse, thicker towards its leading edge, on a parabola of camber.
const section = t => [
  0.5 * chord * Math.cos(t),
  0.5 * thickness * Math.sin(t) * (0.8 + 0.2 * Math.cos(t)) + camber * Math.sin(t) ** 2,
];
const turn = z => twist * (z / height - 0.5), size = z => 1 - taper * z / height;
function point(t, z) {
  const [x, y] = section(t), c = Math.cos(turn(z)), s = Math.sin(turn(z)), k = size(z);
  return [k * (c * x - s * y), k * (s * x + c * y), z];
}
function normal(t, z) {
  const h = 1e-5;
  const along = add(point(t + h, z), point(t - h, z), -1), up = add(point(t, z + h), point(t, z - h), -1);
  return unit(cross(along, up));
}
// Of the tool whose ball touches the surface there.
function pose(t, z, away = 0) {
  const n = normal(t, z), up = unit(add([0, 0, 1], n, -n[2]));
  const axis = add(scaled(n, Math.cos(lean)), up, Math.sin(lean));
  return [add(add(point(t, z), n, radius + away), axis, -radius), axis];
}

const out = [];
const say = (word, ...items) => out.push(items.length ? `${word}/${items.join(',')}` : word);
const go = ([tip, axis]) =>
  say('GOTO', ...tip.map(v => Number(v.toFixed(4))), ...axis.map(v => Number(v.toFixed(6))));
out.push('PARTNO BLADE');
out.push('$$ a ball of 8 mm winds around a twisted blade, from the tip down');
say('UNITS', 'MM');
say('MULTAX', 'ON');
say('LOADTL', 1);
say('CUTTER', 2 * radius, radius, 0, radius, 0, 0, 60);
say('SPINDL', 'RPM', 3200, 'CLW');
say('COOLNT', 'ON');
const top = height + 1, bottom = -0.5, turns = (top - bottom) / pitch;
say('RAPID');
go(pose(0, top, 20));
say('FEDRAT', 'MMPM', 200);
go(pose(0, top, 0));
say('FEDRAT', 'MMPM', 512);
// Straight steps on which the axis swings by two degrees at most and the tip moves by two millimetres: around the
// edges they cut up to 22 um too deep.
for (let t = 0; t < 2 * Math.PI * turns;) {
  const from = pose(t, top - pitch * t / (2 * Math.PI));
  let step = 0.2;
  for (;; step *= 0.8) {
    const to = pose(t + step, top - pitch * (t + step) / (2 * Math.PI));
    const swing = Math.acos(Math.min(1, dot(from[1], to[1])));
    if (swing < 2 * Math.PI / 180 && Math.hypot(...add(to[0], from[0], -1)) < 2) break;
  }
  t += step;
  go(pose(t, top - pitch * t / (2 * Math.PI)));
}
say('RAPID');
go(pose(2 * Math.PI * turns, bottom, 20));
say('SPINDL', 'OFF');
say('FINI');
const folder = new URL('.', import.meta.url);
writeFileSync(new URL('blade.apt', folder), out.join('\n') + '\n');

// An Extrusion along z has its section in x and -y, and turns by its orientation about the spine.
function extrusion(name, low, high, grow, caps) {
  const corners = 120, levels = 30, rows = [];
  for (let i = 0; i <= corners; ++i) {
    const t = 2 * Math.PI * (i % corners) / corners, h = 1e-5;
    const [x, y] = section(t), [dx, dy] = add([...section(t + h), 0], [...section(t - h), 0], -1);
    const l = Math.hypot(dx, dy);
    rows.push(`${(x + grow * dy / l).toFixed(5)} ${(-(y - grow * dx / l)).toFixed(5)}`);
  }
  const spine = [], scale = [], orientation = [];
  for (let k = 0; k <= levels; ++k) {
    const z = low + (high - low) * k / levels;
    spine.push(`0 0 ${z}`);
    scale.push(`${size(z).toFixed(6)} ${size(z).toFixed(6)}`);
    orientation.push(`0 1 0 ${turn(z).toFixed(7)}`);
  }
  writeFileSync(new URL(name, folder), `#VRML V2.0 utf8
Shape {
  appearance Appearance { material Material { diffuseColor 0.62 0.66 0.72 } }
  geometry Extrusion {
    creaseAngle 0.8
    beginCap ${caps} endCap ${caps}
    crossSection [ ${rows.join(', ')} ]
    spine [ ${spine.join(', ')} ]
    scale [ ${scale.join(', ')} ]
    orientation [ ${orientation.join(', ')} ]
  }
}
`);
}
// What the tool goes around: the ends, and what lies within half a millimetre of them, are not machined.
extrusion('blade.wrl', 0.5, height - 0.5, 0, 'FALSE');
extrusion('blank.wrl', 0, height, allowance, 'TRUE');

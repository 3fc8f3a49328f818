// Writes bowl.wrl (the designed surface) and bowl.csv (keyframes of the tool) beside this file: node make_bowl.mjs
//
// The surface is one bicubic Bezier patch over a square of 130 mm. A flat end mill of 12 mm follows it in passes 6 mm
// apart, leaning 20 degrees forward, so that the ellipse of its bottom edge leaves grooves of about 0.2 mm.
import {writeFileSync} from 'node:fs';

const half = 65;  // mm, the patch spans -half..half in x and y
const heights = [
  [-1.0, -2.5, -2.0, -1.2],
  [-3.0, -14.0, -9.0, -2.0],
  [-2.0, -9.5, -13.0, -3.5],
  [-1.5, -2.0, -3.0, -1.0],
];
const radius = 6, lead = 20 * Math.PI / 180, sidestep = 6, spacing = 4;
const reach = 60;  // passes run from -reach to reach, 10 mm past the stock

const bernstein = t => [(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t * t * (1 - t), t ** 3];
const slope = t => [-3 * (1 - t) ** 2, 3 * (1 - t) * (1 - 3 * t), 3 * t * (2 - 3 * t), 3 * t * t];
function blend(bu, bv) {
  let z = 0;
  for (let j = 0; j < 4; ++j) for (let i = 0; i < 4; ++i) z += bv[j] * bu[i] * heights[j][i];
  return z;
}
const parameter = x => (x + half) / (2 * half);
const height = (x, y) => blend(bernstein(parameter(x)), bernstein(parameter(y)));
function normal(x, y) {
  const u = parameter(x), v = parameter(y);
  const dx = blend(slope(u), bernstein(v)) / (2 * half), dy = blend(bernstein(u), slope(v)) / (2 * half);
  const l = Math.hypot(dx, dy, 1);
  return [-dx / l, -dy / l, 1 / l];
}

// The tip of the tool that touches the surface at (x, y) with the front of its bottom edge while it heads along `angle`.
function keyframe(x, y, angle) {
  const n = normal(x, y);
  const h = [Math.cos(angle), Math.sin(angle), 0];
  const along = h[0] * n[0] + h[1] * n[1];
  let f = h.map((c, i) => c - along * n[i]);
  const l = Math.hypot(...f);
  f = f.map(c => c / l);
  const axis = n.map((c, i) => c * Math.cos(lead) + f[i] * Math.sin(lead));
  const front = f.map((c, i) => c * Math.cos(lead) - n[i] * Math.sin(lead));
  const contact = [x, y, height(x, y)];
  const tip = contact.map((c, i) => c - radius * front[i]);
  return [...tip, ...axis].map(c => c.toFixed(6)).join(',');
}

const rows = [];
let forward = true;
const last = 54;
for (let y = -last; y <= last + 1e-9; y += sidestep) {
  const steps = 2 * reach / spacing;
  for (let k = 0; k <= steps; ++k) {
    const x = (forward ? 1 : -1) * (-reach + k * spacing);
    rows.push(keyframe(x, y, forward ? 0 : Math.PI));
  }
  // Half a turn outside the stock to the next pass.
  if (y + sidestep <= last + 1e-9) {
    const r = sidestep / 2, side = forward ? 1 : -1;
    for (const turn of [0.25, 0.5, 0.75]) {
      const a = turn * Math.PI;
      rows.push(keyframe(side * (reach + r * Math.sin(a)), y + r * (1 - Math.cos(a)), forward ? a : Math.PI - a));
    }
  }
  forward = !forward;
}
const folder = new URL('.', import.meta.url);
writeFileSync(new URL('bowl.csv', folder), 'x,y,z,i,j,k\n' + rows.join('\n') + '\n');

const grid = 50, points = [], faces = [];
for (let j = 0; j <= grid; ++j) {
  for (let i = 0; i <= grid; ++i) {
    const x = -50 + 100 * i / grid, y = -50 + 100 * j / grid;
    points.push(`${x} ${y} ${height(x, y).toFixed(5)}`);
  }
}
for (let j = 0; j < grid; ++j) {
  for (let i = 0; i < grid; ++i) {
    const a = i + (grid + 1) * j, b = a + 1, c = a + grid + 2, d = a + grid + 1;
    faces.push(`${a} ${b} ${c} -1 ${a} ${c} ${d} -1`);
  }
}
writeFileSync(new URL('bowl.wrl', folder), `#VRML V2.0 utf8
Shape {
  appearance Appearance { material Material { diffuseColor 0.85 0.6 0.65 } }
  geometry IndexedFaceSet {
    solid FALSE
    creaseAngle 1.0
    coord Coordinate { point [
${points.join(',\n')}
    ] }
    coordIndex [
${faces.join('\n')}
    ]
  }
}
`);

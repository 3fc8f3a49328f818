// SPDX-License-Identifier: MIT
// Draws figures 1, 2, 3 and 6 of the touch paper again, from Tribo's own output, into docs/touch/: needs build/release/tribo
// (or TRIBO_PROGRAM) and ImageMagick's `convert`. node scripts/draw_touch_figures.mjs
import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

const root = new URL("..", import.meta.url).pathname, out = join(root, "docs/touch");
const tribo = process.env.TRIBO_PROGRAM ?? join(root, "build/release/tribo");
const work = mkdtempSync(join(tmpdir(), "tribo-figures-"));
mkdirSync(out, { recursive: true });

const stroke = (name, rows) => {
  const file = join(work, name);
  writeFileSync(file, `t_s,x_mm,y_mm,force_n\n${rows.map((r) => r.join(",")).join("\n")}\n`);
  return file;
};
/** Frames of a material under a stroke; the folder. */
function press(material, strokeFile, name, flags) {
  const folder = join(work, name);
  execFileSync(tribo, ["press", material, "--stroke", strokeFile, "--out", folder, ...flags], { stdio: ["ignore", "ignore", "pipe"] });
  return folder;
}
const frame = (folder, index, kind = "png") => join(folder, `frame_${String(index).padStart(4, "0")}.${kind}`);
const convert = (...args) => execFileSync("convert", args);

// The materials of the examples, or a made-up one where there are none.
const examples = join(root, "examples/materials");
const materials = [];
const look = (folder) => {
  for (const entry of readdirSync(folder, { withFileTypes: true })) {
    const path = join(folder, entry.name);
    if (entry.isDirectory()) look(path);
    else if (entry.name.endsWith(".json") && JSON.parse(readFileSync(path, "utf8")).image) materials.push(path);
  }
};
if (existsSync(examples)) look(examples);
const named = (part) => materials.find((path) => path.includes(part)) ?? materials[0];
if (materials.length === 0) throw new Error("examples/materials has no material with an image");

const widthOf = (path) => JSON.parse(readFileSync(path, "utf8")).width_mm || 100;
const size = ["--size", "320"], photo = ["-strip", "-quality", "82"];

// Figure 1: the single point, and the contact.
{
  const sponge = named("sponge"), w = widthOf(sponge);
  const still = stroke("still.csv", [[0, w / 2, w / 2, 3], [1, w / 2, w / 2, 3]]);
  const point = press(sponge, still, "point", [...size, "--contact", "point"]);
  const area = press(sponge, still, "area", [...size, "--contact", "area"]);
  convert(frame(point, 60), frame(area, 60), "+append", ...photo, join(out, "figure-1.jpg"));

  // Figure 2: the two zones, on the pressed image. Under the contact green, around it to three half axes yellow.
  const c = 160, r = (6 / w) * 320;
  convert(frame(area, 60), "-fill", "rgba(240,210,40,0.25)", "-draw", `circle ${c},${c} ${c + 3 * r},${c}`,
    "-fill", "rgba(60,180,75,0.45)", "-draw", `circle ${c},${c} ${c + r},${c}`, ...photo, join(out, "figure-2.jpg"));
}

// Figure 3: eqs 1 and 2 over the distance for several durations, R_th 0.25 and R_max 10, out of as-published heights of a material
// with K = 1 and next to no viscosity, so that the displacement is the pressure. Beside it the default for several forces.
{
  const unit = join(work, "unit.json"), width = 20, nodes = 1024;
  writeFileSync(unit, JSON.stringify({ schema: "tribo.material/1", stiffness_n_per_mm: 1, viscosity_n_s_per_mm: 0, width_mm: width }));
  const profile = (folder, index) => {
    const bytes = readFileSync(frame(folder, index, "f32")), row = nodes / 2;
    return Array.from({ length: nodes / 2 }, (_, i) => [((i + 0.5) * width) / nodes, bytes.readFloatLE(4 * (row * nodes + nodes / 2 + i))]);
  };
  const flags = ["--size", String(nodes), "--radius-mm", "0.25", "--heights", "--fps", "10"];
  const held = stroke("held.csv", [[0, 10, 10, 1], [2, 10, 10, 1]]);
  const published = press(unit, held, "published", [...flags, "--as-published"]);
  const times = [2, 5, 10, 15, 20];
  const curves = times.map((i) => ({ label: `t = ${i / 10} s`, points: profile(published, i) }));
  const forces = [0.2, 0.5, 1, 1.5, 2];
  const ours = forces.map((f) => {
    const file = stroke(`force-${f}.csv`, [[0, 10, 10, f], [0.1, 10, 10, f]]);
    return { label: `F = ${f} N`, points: profile(press(unit, file, `force-${f}`, flags), 1) };
  });
  const plot = (title, lines, left, reach) => {
    const x = (d) => left + 50 + (330 * d) / reach, y = (p) => 40 - 100 * Math.max(-2.2, p);
    const hues = ["#1b6ca8", "#2a9d8f", "#8a9a1b", "#e08e1b", "#c8443a"];
    const shown = lines.map(({ label, points }, i) =>
      `<polyline fill="none" stroke="${hues[i]}" stroke-width="1.6" points="${points.filter(([d]) => d <= reach).map(([d, p]) => `${x(d).toFixed(1)},${y(p).toFixed(1)}`).join(" ")}"/>` +
      `<text x="${left + 310}" y="${180 + 15 * i}" fill="${hues[i]}">${label}</text>`).join("\n");
    const ticks = [0, 0.5, 1, 1.5, 2].map((p) => `<text x="${left + 44}" y="${y(-p) + 4}" text-anchor="end">${p === 0 ? 0 : -p}</text><path d="M${x(0)} ${y(-p)}h330" stroke="#ddd"/>`).join("");
    const steps = [0, 0.25, 0.5, 0.75, 1].map((s) => `<text x="${x(s * reach)}" y="275" text-anchor="middle">${s * reach}</text>`).join("");
    return `<text x="${x(0)}" y="22" font-weight="bold">${title}</text>${ticks}${steps}${shown}<text x="${x(reach / 2)}" y="292" text-anchor="middle">distance d, mm</text>`;
  };
  writeFileSync(join(out, "figure-3.svg"),
    `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 800 300" font-family="sans-serif" font-size="11"><rect width="800" height="300" fill="#fff"/>` +
    `${plot("as published: pressure by duration, R_th 0.25, R_max 10", curves, 0, 10)}${plot("default: pressure by force, radius 0.25", ours, 400, 2)}</svg>\n`);
}

// Figure 6: each material at rest, pressed on the left, at the end of a quick slide to the right; in the paper's order.
{
  const rows = [];
  for (const [i, path] of ["sponge", "paper", "towel", "carpet"].map(named).entries()) {
    const w = widthOf(path), left = 0.3 * w;
    const rub = stroke(`rub-${i}.csv`, [[0, left, w / 2, 0], [0.1, left, w / 2, 0], [0.101, left, w / 2, 3], [0.7, left, w / 2, 3], [0.85, 0.75 * w, w / 2, 3]]);
    const folder = press(path, rub, `rub-${i}`, [...size]);
    const row = join(work, `row-${i}.png`);
    convert(frame(folder, 0), frame(folder, 42), frame(folder, 51), "+append", row);
    rows.push(row);
  }
  convert(...rows, "-append", ...photo, join(out, "figure-6.jpg"));
}
rmSync(work, { recursive: true });

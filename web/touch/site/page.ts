// SPDX-License-Identifier: MIT
// The touch page: chooses the material, turns K and nu, says what they mean.
import type { ContactDetail, TriboTouch } from "../src/element.js";

interface Listed {
  file: string;
  name: string;
  note: string;
  image?: string;
}

const byId = <T extends HTMLElement>(id: string) => document.getElementById(id) as T;
const pictures = [byId<TriboTouch>("ours"), byId<TriboTouch>("published")];
const stiffness = byId<HTMLInputElement>("stiffness"),
  damping = byId<HTMLInputElement>("damping");

/** Two digits, never as a power of ten. */
const rounded = (value: number) => String(Number(value.toPrecision(2)));

function show(): void {
  const k = 10 ** Number(stiffness.value),
    nu = 10 ** Number(damping.value);
  byId("stiffness-value").textContent = `${k.toPrecision(3)} N/mm`;
  byId("damping-value").textContent = `${nu.toPrecision(3)} N s/mm`;
  byId("meaning").textContent =
    `A finger of 2 N goes ${rounded(2 / k)} mm deep; 63 % of the way takes ${rounded((1000 * nu) / k)} ms.`;
}

function turn(): void {
  for (const picture of pictures) {
    picture.stiffness = 10 ** Number(stiffness.value);
    picture.damping = 10 ** Number(damping.value);
  }
  show();
}

function own(): void {
  const material = pictures[0]!.material;
  if (material === undefined) return;
  for (const picture of pictures) {
    picture.removeAttribute("stiffness");
    picture.removeAttribute("damping");
  }
  stiffness.value = String(Math.log10(material.stiffness_n_per_mm));
  damping.value = String(Math.log10(Math.max(0.01, material.viscosity_n_s_per_mm)));
  show();
}

function choose(material: Listed): void {
  for (const picture of pictures) {
    picture.removeAttribute("stiffness");
    picture.removeAttribute("damping");
    // Fetched while the material is.
    picture.poster = material.image ?? "";
    picture.src = material.file;
    picture.alt = `${material.name}, ${picture.asPublished ? "as published" : "by Tribo"}`;
  }
  byId("note").textContent = material.note;
}

/** One more choice among the materials. */
function offer(material: Listed, chosen: boolean): void {
  const label = document.createElement("label"),
    input = document.createElement("input");
  input.type = "radio";
  input.name = "material";
  input.checked = chosen;
  input.addEventListener("change", () => choose(material));
  label.append(input, material.name);
  byId("materials").append(label);
  if (chosen) choose(material);
}

async function learnHere(): Promise<void> {
  const { start: begin } = await import("./make.js");
  begin(
    ({ file, name }) => offer({ file, name, note: "made on this page" }, true),
    () => pictures[0]!,
  );
}

async function start(): Promise<void> {
  pictures[0]!.addEventListener("load", own);
  stiffness.addEventListener("input", turn);
  damping.addEventListener("input", turn);
  byId("reset").addEventListener("click", own);
  document.addEventListener("contact-move", (event) => {
    const { depth_mm, force_n, speed_mm_per_s } = (event as CustomEvent<ContactDetail>).detail;
    byId("measured").textContent =
      `${depth_mm.toFixed(2)} mm, ${force_n.toFixed(1)} N, ${speed_mm_per_s.toFixed(0)} mm/s`;
  });
  const list = (await (await fetch("materials.json")).json()) as Listed[];
  list.forEach((material, i) => offer(material, i === 0));
  // Learning and what belongs to it is loaded for those who want it.
  byId("own").addEventListener("toggle", () => void learnHere(), { once: true });
  byId("own").addEventListener("dragenter", () => byId("own").setAttribute("open", ""));
}

void start();

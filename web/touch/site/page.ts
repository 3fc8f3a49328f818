// SPDX-License-Identifier: MIT
// The touch page: selects the material, sets K and nu, explains their meaning.
import { element } from "@tribo/ui/dom";
import type { ContactDetail, TriboErrorDetail, TriboTouch } from "../src/element.js";

interface Listed {
  file: string;
  name: string;
  note: string;
  /** One plain sentence. */
  says?: string;
  image?: string;
}

// The one at the top, its twin beside the published model, and that model.
const pictures = ["ours", "model", "published"].map((id) => element<TriboTouch>(id));
/** What was made here, beside its form. */
const made = element<TriboTouch>("made");
const stiffness = element<HTMLInputElement>("stiffness");
const damping = element<HTMLInputElement>("damping");

/** Rounds to two digits, never as a power of ten. */
const rounded = (value: number) => String(Number(value.toPrecision(2)));

function show(): void {
  const k = 10 ** Number(stiffness.value);
  const nu = 10 ** Number(damping.value);
  element("stiffness-value").textContent = `${k.toPrecision(3)} N/mm`;
  element("damping-value").textContent = `${nu.toPrecision(3)} N s/mm`;
  element("meaning").textContent =
    `A finger of 2 N goes ${rounded(2 / k)} mm deep; 63 % of the way takes ${rounded((1000 * nu) / k)} ms.`;
}

function turn(): void {
  for (const picture of [...pictures, made]) {
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
    // Loaded at the same time as the material.
    picture.poster = material.image ?? "";
    picture.src = material.file;
    picture.alt = `${material.name}, ${picture.asPublished ? "as published" : "by Tribo"}`;
  }
  element("wrong").textContent = "";
  if (material.says) element("says").textContent = material.says;
  element("note").textContent = material.note && `${material.name}: ${material.note}.`;
}

/** Adds a choice to the materials. */
function offer(material: Listed, chosen: boolean): void {
  const label = document.createElement("label");
  const input = document.createElement("input");
  input.type = "radio";
  input.name = "material";
  input.checked = chosen;
  input.addEventListener("change", () => choose(material));
  label.append(input, material.name);
  element("materials").append(label);
  if (chosen) choose(material);
}

async function learnHere(): Promise<void> {
  const { start: begin } = await import("./make.js");
  begin(
    ({ file, name }) => {
      offer(
        { file, name, note: "made on this page", says: `${name}: what you made of a picture and its sound.` },
        true,
      );
      made.src = file;
      made.alt = name;
      made.hidden = false;
    },
    () => pictures[0]!,
  );
}

async function start(): Promise<void> {
  pictures[0]!.addEventListener("load", own);
  for (const picture of pictures)
    picture.addEventListener("error", (event) => {
      element("wrong").textContent = (event as Event as CustomEvent<TriboErrorDetail>).detail.message;
    });
  stiffness.addEventListener("input", turn);
  damping.addEventListener("input", turn);
  element("reset").addEventListener("click", own);
  document.addEventListener("contact-move", (event) => {
    const { depth_mm, force_n, speed_mm_per_s } = (event as CustomEvent<ContactDetail>).detail;
    element("measured").textContent =
      `${depth_mm.toFixed(2)} mm, ${force_n.toFixed(1)} N, ${speed_mm_per_s.toFixed(0)} mm/s`;
  });
  const list = (await (await fetch("materials.json")).json()) as Listed[];
  list.forEach((material, i) => offer(material, i === 0));
  // The learning code is loaded only on request.
  element("own").addEventListener("toggle", () => void learnHere(), { once: true });
  element("own").addEventListener("dragenter", () => element("own").setAttribute("open", ""));
}

void start();

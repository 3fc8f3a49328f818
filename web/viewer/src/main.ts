// SPDX-License-Identifier: MIT
// The live mill's page: engine to picture, hands to engine.

import { Connection, type ServerInfo } from "./connection.js";
import type { CollisionFrame, Frame, StateFrame } from "./frames.js";
import { Plot } from "./plot.js";
import { Scene } from "./scene.js";

function element<T extends HTMLElement>(id: string): T {
  const found = document.getElementById(id);
  if (!found) throw new Error(`the page has no #${id}`);
  return found as T;
}

function clock(seconds: number): string {
  const s = Math.floor(seconds);
  return `${Math.floor(s / 60)}:${String(s % 60).padStart(2, "0")}`;
}

const scene = new Scene(element<HTMLCanvasElement>("scene"));
const plot = new Plot(element<HTMLCanvasElement>("plot"), (time) => connection.send({ op: "seek", t_s: time }));
const play = element<HTMLButtonElement>("play");
const time = element<HTMLInputElement>("time");
const speed = element<HTMLSelectElement>("speed");
const notice = element("notice");
const collisions = element<HTMLOListElement>("collisions");
let duration = 0;
let playing = false;
let scrubbing = false;

function show(state: StateFrame): void {
  scene.show(state);
  plot.setTime(state.time);
  playing = state.playing;
  play.textContent = playing ? "Pause" : "Play";
  play.setAttribute("aria-pressed", String(playing));
  if (!scrubbing) time.value = String(state.time);
  element("clock").textContent = `${clock(state.time)} / ${clock(duration)}`;
  element("force").textContent = `${Math.hypot(...state.force).toFixed(0)} N`;
  element("peak").textContent = `${state.peakForce.toFixed(0)} N`;
  element("torque").textContent = `${state.torque.toFixed(2)} Nm`;
  element("spindle").textContent = `${state.rpm.toFixed(0)} rpm`;
  element("feed").textContent = state.rapid ? "rapid" : `${state.feed.toFixed(0)} mm/min`;
  element("removed").textContent = `${(state.removed / 1000).toFixed(2)} cm³`;
  element("line").textContent = String(state.line);
}

function addCollision(frame: CollisionFrame): void {
  const item = document.createElement("li");
  const button = document.createElement("button");
  button.type = "button";
  button.textContent = `line ${frame.line}: ${frame.what}`;
  button.addEventListener("click", () => connection.send({ op: "seek", t_s: frame.time }));
  item.append(button);
  collisions.append(item);
  collisions.hidden = false;
}

function take(frame: Frame): void {
  switch (frame.kind) {
    case "job":
      duration = frame.duration;
      time.max = String(duration);
      collisions.replaceChildren();
      collisions.hidden = true;
      plot.begin(duration);
      scene.begin(frame);
      break;
    case "chunk":
      scene.take(frame);
      break;
    case "rows":
      plot.addRows(frame.rows);
      scene.addRows(frame.rows);
      break;
    case "collision":
      addCollision(frame);
      break;
    case "state":
      show(frame);
      break;
  }
}

function info(message: ServerInfo): void {
  document.title = `${message.job} - Tribo`;
}

const connection = new Connection({
  frame: take,
  info,
  line(open, why) {
    notice.hidden = open;
    notice.textContent = open ? "" : `No line to the engine: ${why}. Trying again.`;
  },
});

play.addEventListener("click", () => connection.send({ op: playing ? "pause" : "play" }));
speed.addEventListener("change", () => connection.send({ op: "speed", value: Number(speed.value) }));
time.addEventListener("input", () => (scrubbing = true));
time.addEventListener("change", () => {
  scrubbing = false;
  connection.send({ op: "seek", t_s: Number(time.value) });
});
element("fit").addEventListener("click", () => scene.fit());
for (const what of ["path", "tool"] as const) {
  const box = element<HTMLInputElement>(`show-${what}`);
  box.addEventListener("change", () => scene.setVisible(what, box.checked));
}
element("scene").addEventListener("keydown", (event) => {
  if (event.key === " ") {
    event.preventDefault();
    play.click();
  }
});

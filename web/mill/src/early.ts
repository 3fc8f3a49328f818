// SPDX-License-Identifier: MIT
// What takes time but little code, begun while the page's script is on its way: the graphics, which the browser has to
// start, and the line to the engine.

import { Connection } from "./sources/connection.js";
import { element } from "@tribo/ui/dom";

export const hasEngine = document.querySelector<HTMLMetaElement>('meta[name="tribo-engine"]')?.content !== "none";
export const canvas = element<HTMLCanvasElement>("scene");
export const context = canvas.getContext("webgl2", { alpha: true, antialias: true }) ?? undefined;

let connection: Connection | undefined;
/** The line, opened when it is first asked for. */
export function line(): Connection {
  return (connection ??= new Connection());
}

// What the engine sends would hold up the script; once that is there, it has still to be compiled.
const script = document.querySelector<HTMLLinkElement>('link[rel="modulepreload"]')?.href ?? "";
if (hasEngine) {
  new PerformanceObserver((fetched) => {
    if (fetched.getEntriesByName(script).length > 0) line();
  }).observe({ type: "resource", buffered: true });
}

void import("./main.js");

// SPDX-License-Identifier: MIT
// Starts slow work that needs little code while the script of the page is loading: the graphics of the browser, and
// the connection to the engine.

import { declineFilm, hidePoster, showPoster } from "./film/first_visit.js";
import { Connection } from "./sources/connection.js";
import { loadTexts } from "./texts/texts.js";
import { element } from "@tribo/ui/dom";

export const hasEngine = document.querySelector<HTMLMetaElement>('meta[name="tribo-engine"]')?.content !== "none";
export const canvas = element<HTMLCanvasElement>("scene");
/** Made before main.ts is loaded; undefined: the browser has no graphics. */
export let context: WebGL2RenderingContext | undefined;

let connection: Connection | undefined;
/** Returns the connection; it is opened at the first call. */
export function line(): Connection {
  return (connection ??= new Connection());
}

// Frames of the engine would delay the script. Therefore the connection is opened when the script is loaded;
// compiling it still takes time.
const script = document.querySelector<HTMLLinkElement>('link[rel="modulepreload"]')?.href ?? "";
if (hasEngine) {
  new PerformanceObserver((fetched) => {
    if (fetched.getEntriesByName(script).length > 0) line();
  }).observe({ type: "resource", buffered: true });
}

// Buttons are there before what they do: presses of them wait for it.
const pressed: HTMLElement[] = [];
function keep({ target }: MouseEvent): void {
  declineFilm();
  const button = target instanceof Element ? target.closest("button") : null;
  if (button) pressed.push(button);
}

// The browser draws nothing while it begins the graphics: the poster comes first.
async function begin(): Promise<void> {
  addEventListener("click", keep, { capture: true });
  if (hasEngine) hidePoster();
  else await showPoster();
  context = canvas.getContext("webgl2", { alpha: true, antialias: true }) ?? undefined;
  await loadTexts();
  await import("./main.js");
  removeEventListener("click", keep, { capture: true });
  for (const button of pressed) button.click();
}
void begin();

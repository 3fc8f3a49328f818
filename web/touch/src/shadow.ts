// SPDX-License-Identifier: MIT
// The shadow tree of an element.

const kStyle = `
:host { display: block; position: relative; contain: content; }
:host([hidden]), [hidden] { display: none; }
.surface { position: relative; overflow: hidden; cursor: grab; user-select: none; -webkit-user-select: none;
  -webkit-touch-callout: none; -webkit-tap-highlight-color: transparent; touch-action: var(--tribo-touch-action, none);
  border-radius: var(--tribo-radius, 0); outline-offset: 2px; }
.surface:focus-visible { outline: var(--tribo-focus, 3px solid #1a6fd0); }
.surface[aria-disabled=true] { cursor: default; touch-action: auto; }
.surface:active { cursor: grabbing; }
img, canvas { display: block; width: 100%; height: auto; }
canvas { position: absolute; inset: 0; height: 100%; visibility: hidden; }
.drawn canvas { visibility: visible; }
.cover { position: absolute; inset: 0; pointer-events: none; }
.cover img, .cover ::slotted(*) { width: 100%; height: 100%; object-fit: cover; }
.probe { position: absolute; width: 28px; height: 28px; margin: -14px; border: 2px solid #fff; border-radius: 50%;
  box-shadow: 0 0 0 2px #000a; pointer-events: none; }
.probe.down { background: #fff5; }
.spoken { position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); white-space: nowrap; }
`;

const kHelp =
  "Arrow keys move the finger, Space or Enter presses and lifts it, plus and minus make it firmer and softer, Escape lifts it.";

function make<K extends keyof HTMLElementTagNameMap>(tag: K, part: string, parent: Node): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  if (part !== "") element.setAttribute("part", part);
  parent.appendChild(element);
  return element;
}

export interface Parts {
  surface: HTMLDivElement;
  image: HTMLImageElement;
  canvas: HTMLCanvasElement;
  cover: HTMLDivElement;
  poster: HTMLImageElement;
  probe: HTMLDivElement;
  status: HTMLSpanElement;
}

export function build(host: HTMLElement): Parts {
  const root = host.attachShadow({ mode: "open" });
  make("style", "", root).textContent = kStyle;
  const surface = make("div", "surface", root);
  surface.className = "surface";
  surface.tabIndex = 0;
  // Screen readers pass arrow keys only to an application.
  surface.setAttribute("role", "application");
  surface.setAttribute("aria-roledescription", "touchable surface");
  surface.setAttribute("aria-describedby", "help");
  const image = make("img", "image", surface);
  image.alt = "";
  image.draggable = false;
  const canvas = make("canvas", "canvas", surface);
  canvas.setAttribute("aria-hidden", "true");
  const cover = make("div", "poster", surface);
  cover.className = "cover";
  const slot = make("slot", "", cover);
  slot.name = "poster";
  const poster = document.createElement("img");
  poster.alt = "";
  poster.hidden = true;
  slot.appendChild(poster);
  const probe = make("div", "probe", surface);
  probe.className = "probe";
  probe.hidden = true;
  const help = make("span", "", root);
  help.id = "help";
  help.className = "spoken";
  help.textContent = kHelp;
  const status = make("span", "", root);
  status.className = "spoken";
  status.setAttribute("aria-live", "polite");
  make("slot", "", root);
  return { surface, image, canvas, cover, poster, probe, status };
}

// SPDX-License-Identifier: MIT
// The window of a comparison: mills both runs beside the page, then shows them in a frame with the script of compare.html.

import "./compare.css";
import { download, element } from "@tribo/ui/dom";
import scriptUrl from "../../../../src/report/page/compare.js?url";
import type { Moment } from "../keep/moment.js";
import { jobNameOf } from "../setup/with_job.js";
import { unpacked } from "../sources/unpacked.js";
import { fixed, precise } from "../texts/figures.js";
import { t, translate, word } from "../texts/texts.js";
import type { Compared, FromCompare, ToCompare } from "./compare_worker.js";
import { comparisonPage, type Named } from "./page.js";
import type { Side } from "./run.js";

const WINDOW = `
<div id="comparison-head">
  <h2 id="comparison-title">Two runs compared</h2>
  <button id="comparison-save" type="button" title="As one file that opens offline" hidden>Save</button>
  <button id="comparison-close" type="button" aria-label="Close the comparison">✕</button>
</div>
<p id="comparison-said" role="status"></p>
<progress id="comparison-progress" max="1" value="0" aria-label="Milled of both runs"></progress>`;

async function sideOf({ order, changes }: Moment): Promise<Side> {
  const files = await Promise.all(order.files.map(async (file) => ({ name: file.name, bytes: await unpacked(file) })));
  return { files, job: order.job, part: order.part, changes };
}

const NAMES = { feed_percent: word("feed"), spindle_percent: word("spindle"), helix_deg: word("helix") } as const;

function named({ order, changes }: Moment): Named {
  const said = changes.flatMap((change) => {
    if (change.key === "material" || !(change.key in NAMES)) return [];
    const name = t(NAMES[change.key as keyof typeof NAMES]);
    return [`${name} ${precise(change.value, 3)} ${change.key === "helix_deg" ? "°" : "%"}`];
  });
  return { name: jobNameOf(order), changes: said };
}

export class ComparisonWindow {
  private readonly window = document.createElement("dialog");
  private worker: Worker | undefined;
  private frame: HTMLIFrameElement | undefined;
  private file: (() => string) | undefined;

  constructor() {
    this.window.id = "comparison";
    this.window.setAttribute("aria-labelledby", "comparison-title");
    this.window.innerHTML = WINDOW;
    translate(this.window);
    document.body.append(this.window);
    element("comparison-close").addEventListener("click", () => this.window.close());
    element("comparison-save").addEventListener("click", () => {
      if (this.file) download(new Blob([this.file()], { type: "text/html" }), "compare.html");
    });
    // Milling ends, and so does the sound.
    this.window.addEventListener("close", () => this.clear());
  }

  open(a: Moment, b: Moment): void {
    this.clear();
    this.say(t("Both runs are milled to their end, and once more against the part of the other."));
    this.progress(0);
    this.window.showModal();
    const names = { a: named(a), b: named(b) };
    const worker = new Worker(new URL("./compare_worker.ts", import.meta.url), { type: "module" });
    this.worker = worker;
    const fail = (why: string) => {
      this.progress(undefined);
      this.say(t("The runs cannot be compared here: {why}.", { why }));
    };
    worker.onerror = ({ message }) => fail(message || t("the script is not there"));
    worker.onmessage = ({ data }: MessageEvent<FromCompare>) => {
      if ("share" in data) this.progress(data.share);
      else if ("why" in data) fail(data.why);
      else this.show(data.compared, names);
    };
    Promise.all([sideOf(a), sideOf(b)]).then(
      ([ofA, ofB]) => worker.postMessage({ a: ofA, b: ofB } satisfies ToCompare),
      (error: unknown) => fail(String(error)),
    );
  }

  private show(compared: Compared, names: { a: Named; b: Named }): void {
    this.progress(undefined);
    this.say("");
    this.file = () => comparisonPage(compared, names, true);
    element("comparison-save").hidden = false;
    const frame = document.createElement("iframe");
    frame.title = t("Two runs compared");
    frame.addEventListener("load", () => {
      const page = frame.contentDocument;
      if (!page) return;
      const script = page.createElement("script");
      script.src = scriptUrl;
      page.body.append(script);
    });
    frame.srcdoc = comparisonPage(compared, names, false);
    this.frame = frame;
    this.window.append(frame);
    this.worker?.terminate();
  }

  private clear(): void {
    this.worker?.terminate();
    this.frame?.remove();
    this.worker = this.frame = this.file = undefined;
    element("comparison-save").hidden = true;
  }

  private say(text: string): void {
    element("comparison-said").hidden = text === "";
    element("comparison-said").textContent = text;
  }
  // Undefined: nothing is milled.
  private progress(share: number | undefined): void {
    const bar = element<HTMLProgressElement>("comparison-progress");
    bar.hidden = share === undefined;
    bar.value = share ?? 0;
    bar.textContent = `${fixed(100 * bar.value, 0)} %`;
  }
}

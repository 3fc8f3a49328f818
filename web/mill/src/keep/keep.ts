// SPDX-License-Identifier: MIT
// What a viewer takes away: the picture, the part, the rows of the cut, and a link to the moment.

import { download, element, wordsOf } from "@tribo/ui/dom";
import { hasEngine } from "../early.js";
import type { History } from "../panels/history.js";
import type { Scene } from "../sight/scene.js";
import { clock } from "../page.js";
import { t } from "../texts/texts.js";
import { ENDING, fragmentOf, LONGEST_FRAGMENT, pack, type Moment } from "./moment.js";
import { rowsCsv } from "./rows_csv.js";
import { stl } from "./stl.js";
import type { Triangles } from "./triangles.js";

/** The moment of the program is in the name of a file: the part changes. */
export function fileName(history: History, ending: string): string {
  const job = (element("job").textContent || "mill").replace(/\.\w+$/, "");
  return `${job} ${clock(history.time).replace(":", "-")}.${ending}`;
}

/** `momentNow` gives nothing where the page has not got the files of the job. */
export function listenToKeep(
  scene: Scene,
  history: History,
  say: (text: string) => void,
  momentNow: () => Moment | undefined,
): void {
  const name = (ending: string) => fileName(history, ending);
  element("keep-picture").addEventListener("click", () => {
    scene.picture().then(
      (picture) => download(picture, name("png")),
      (error: unknown) => say(wordsOf(error)),
    );
  });
  const keepPart = async (ending: string, made: (part: Triangles[]) => Blob | Promise<Blob>) => {
    try {
      download(await made(await scene.triangles()), name(ending));
    } catch (error) {
      say(wordsOf(error));
    }
  };
  element("keep-part").addEventListener(
    "click",
    () => void keepPart("stl", (part) => new Blob([stl(part)], { type: "model/stl" })),
  );
  element("keep-glb").addEventListener(
    "click",
    () => void keepPart("glb", async (part) => (await import("./glb.js")).glb(part, scene.colours)),
  );
  element("keep-rows").addEventListener("click", () =>
    download(new Blob([rowsCsv(history.rows)], { type: "text/csv" }), name("csv")),
  );
  element("keep-link").addEventListener("click", () => {
    const moment = momentNow();
    if (moment)
      keepMoment(moment, name).catch((error: unknown) => say(t("There is no link: {why}", { why: wordsOf(error) })));
  });
}

async function keepMoment(moment: Moment, name: (ending: string) => string): Promise<void> {
  // The page of an engine is at an address of its own machine, with a token.
  const fragment = hasEngine ? undefined : fragmentOf(await pack(moment, false));
  const link = element<HTMLInputElement>("link");
  const said = element("link-said");
  if (fragment === undefined) {
    download(new Blob([(await pack(moment, true)) as BlobPart]), name(ENDING.slice(1)));
    said.textContent = hasEngine
      ? t("Saved as a file: open it here or on a page without an engine.")
      : t("Too long for a link ({most} characters at most). Saved as a file: open it here.", {
          most: LONGEST_FRAGMENT,
        });
  }
  link.hidden = fragment === undefined;
  element("link-box").hidden = false;
  if (fragment === undefined) return;
  link.value = location.origin + location.pathname + fragment;
  link.select();
  const copied = await navigator.clipboard?.writeText(link.value).then(
    () => true,
    () => false,
  );
  const count = link.value.length;
  said.textContent = copied
    ? t("Copied: {count} characters.", { count })
    : t("To copy: {count} characters.", { count });
}

// SPDX-License-Identifier: MIT
// What a viewer takes away: the picture, the part, the rows of the cut.

import { download, element, wordsOf } from "@tribo/ui/dom";
import type { History } from "../panels/history.js";
import type { Scene } from "../sight/scene.js";
import { clock } from "../page.js";
import { rowsCsv } from "./rows_csv.js";
import { stl } from "./stl.js";

export function listenToKeep(scene: Scene, history: History, say: (text: string) => void): void {
  // The moment of the program is in the name: the part changes.
  const name = (ending: string) => {
    const job = (element("job").textContent || "mill").replace(/\.\w+$/, "");
    return `${job} ${clock(history.time).replace(":", "-")}.${ending}`;
  };
  element("keep-picture").addEventListener("click", () => {
    scene.picture().then(
      (picture) => download(picture, name("png")),
      (error: unknown) => say(wordsOf(error)),
    );
  });
  element("keep-part").addEventListener("click", () =>
    download(new Blob([stl(scene.triangles())], { type: "model/stl" }), name("stl")),
  );
  element("keep-rows").addEventListener("click", () =>
    download(new Blob([rowsCsv(history.rows)], { type: "text/csv" }), name("csv")),
  );
}

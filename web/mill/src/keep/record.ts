// SPDX-License-Identifier: MIT
// A recording of the frames, to be played again.

import { Recorder } from "@tribo/protocol/recording";
import { download, element } from "@tribo/ui/dom";
import { t } from "../texts/texts.js";
import type { FrameCache } from "../sources/frame_cache.js";

/** Listens to its button. Returns what takes each frame. */
export function listenToRecord(frames: FrameCache): (bytes: ArrayBuffer) => void {
  const button = element<HTMLButtonElement>("record");
  let recorder: Recorder | undefined;
  button.addEventListener("click", () => {
    if (!recorder) {
      recorder = new Recorder();
      for (const bytes of frames.replay()) recorder.take(bytes);
      button.textContent = t("Stop and keep");
    } else {
      download(recorder.file(), `${(element("job").textContent ?? "mill").replace(/\.\w+$/, "")}.tribo`);
      recorder = undefined;
      button.textContent = t("Record");
    }
    button.setAttribute("aria-pressed", String(recorder !== undefined));
  });
  return (bytes) => recorder?.take(bytes);
}

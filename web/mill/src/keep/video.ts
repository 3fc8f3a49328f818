// SPDX-License-Identifier: MIT
// A video of what plays, with its sound, as the browser encodes it.

import { download, element, wordsOf } from "@tribo/ui/dom";
import { clock } from "../page.js";
import type { Scene } from "../sight/scene.js";
import { fixed } from "../texts/figures.js";
import { t } from "../texts/texts.js";
import type { Sound } from "../sound/sound.js";

// A processor keeps up with VP8; VP9 is what other browsers offer.
const TYPES = ["video/webm;codecs=vp8,opus", "video/webm"];
// Of the longer side, pixels.
const LARGEST_SIDE = 1280;
const PICTURES_PER_S = 30;
const BITS_PER_S = 6e6;
// Length and size are shown so often, and a picture is drawn at least so often, ms.
const TOLD_EVERY_MS = 500;
// The browser keeps the video in memory: a longer one is saved by itself, bytes.
const LARGEST_VIDEO = 500e6;
// The head of a video lies within, bytes.
const HEAD = 4096;

export interface VideoActions {
  /** Makes the sound ready, in a gesture. */
  wake: () => Promise<void>;
  /** Of the file. */
  name: () => string;
  say: (text: string) => void;
}

/** Its button is hidden where the browser cannot make videos. */
export function listenToVideo(scene: Scene, sound: Sound, { wake, name, say }: VideoActions): void {
  const button = element<HTMLButtonElement>("keep-video");
  const mimeType =
    typeof MediaRecorder === "undefined" ? undefined : TYPES.find((type) => MediaRecorder.isTypeSupported(type));
  if (!mimeType) return;
  button.hidden = false;
  const words = button.textContent;
  let recorder: MediaRecorder | undefined;

  const nextPicture = () => new Promise((drawn) => requestAnimationFrame(drawn));

  async function begin(): Promise<void> {
    // Before the first picture: where it cannot be had, nothing is recorded in vain.
    const { withLength } = await import("./webm.js");
    const { width, height } = scene.canvas;
    const scale = Math.min(1, LARGEST_SIDE / Math.max(width, height));
    const copy = document.createElement("canvas");
    // Encoders take even sizes.
    copy.width = 2 * Math.round((scale * width) / 2);
    copy.height = 2 * Math.round((scale * height) / 2);
    const c = copy.getContext("2d")!;
    const tracks = [...copy.captureStream(PICTURES_PER_S).getTracks(), ...sound.tracks()];
    const video = new MediaRecorder(new MediaStream(tracks), { mimeType, videoBitsPerSecond: BITS_PER_S });
    const parts: Blob[] = [];
    let began = 0;
    let bytes = 0;
    video.addEventListener("dataavailable", ({ data }) => {
      parts.push(data);
      bytes += data.size;
      if (video.state !== "recording") return;
      button.textContent = t("Stop and keep ({time}, {size} MB)", {
        time: clock((performance.now() - began) / 1000),
        size: fixed(bytes / 1e6, 1),
      });
      scene.draw();
      if (bytes > LARGEST_VIDEO) video.stop();
    });
    video.addEventListener("stop", async () => {
      const length = performance.now() - began;
      recorder = scene.drawn = undefined;
      for (const track of tracks) track.stop();
      button.textContent = words;
      button.setAttribute("aria-pressed", "false");
      const whole = new Blob(parts);
      const head = withLength(new Uint8Array(await whole.slice(0, HEAD).arrayBuffer()), length);
      download(new Blob([head, whole.slice(HEAD)], { type: "video/webm" }), name());
    });
    scene.drawn = () => scene.paint(c);
    scene.draw();
    // A stream begins with the canvas as it was made: empty. That picture is not recorded.
    await nextPicture();
    await nextPicture();
    began = performance.now();
    video.start(TOLD_EVERY_MS);
    scene.draw();
    recorder = video;
    button.textContent = t("Stop and keep");
    button.setAttribute("aria-pressed", "true");
  }

  button.addEventListener("click", async () => {
    if (recorder) return recorder.stop();
    button.disabled = true;
    try {
      await wake();
      await begin();
    } catch (error) {
      scene.drawn = undefined;
      say(t("There is no video: {why}", { why: wordsOf(error) }));
    }
    button.disabled = false;
  });
}

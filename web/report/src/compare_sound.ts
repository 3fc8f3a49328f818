// SPDX-License-Identifier: MIT
// Both sounds run at the same time; the switch fades from one to the other, so that no gap is heard.

import { element } from "@tribo/ui/dom";
import { say, SIDES, type SideName } from "./compare_data.js";
import { bytesIn } from "./part_scene.js";

/** Time constant of the fade, s: too short to be heard as one, too long for a click. */
const FADE_S = 0.01;

export function abSound(): void {
  const button = element<HTMLButtonElement>("play-sound");
  let heard: SideName = "a";
  let context: AudioContext | undefined;
  const gains = new Map<SideName, GainNode>();

  const start = async () => {
    const made = new AudioContext();
    context = made;
    const sounds = await Promise.all(SIDES.map((side) => made.decodeAudioData(bytesIn(`sound-${side}`).buffer)));
    // Both repeat after the longer one, and stay together.
    const lasts = Math.max(...sounds.map((sound) => sound.duration));
    const begin = made.currentTime + 0.05;
    SIDES.forEach((side, n) => {
      const gain = made.createGain();
      gain.gain.value = Number(side === heard);
      const whole = made.createBuffer(2, Math.ceil(lasts * made.sampleRate), made.sampleRate);
      for (const channel of [0, 1]) whole.copyToChannel(sounds[n]!.getChannelData(channel), channel);
      const source = made.createBufferSource();
      source.buffer = whole;
      source.loop = true;
      source.connect(gain).connect(made.destination);
      source.start(begin);
      gains.set(side, gain);
    });
  };
  button.addEventListener("click", () => {
    const plays = context?.state === "running";
    button.textContent = plays ? say("Play") : say("Pause");
    if (!context) void start();
    else void (plays ? context.suspend() : context.resume());
  });
  element("listen").addEventListener("change", (e) => {
    heard = (e.target as HTMLInputElement).value as SideName;
    for (const [side, gain] of gains) gain.gain.setTargetAtTime(Number(side === heard), context!.currentTime, FADE_S);
  });
}

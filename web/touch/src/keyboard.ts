// SPDX-License-Identifier: MIT
// The finger of the keyboard: arrow keys move it over the image, space and Enter press and lift it, plus and minus
// change its force.
import { clamp } from "@tribo/ui/clamp";
import { kFullForceN, type Finger } from "./fingers.js";
import type { Parts } from "./shadow.js";

const kStep = 0.02;
const kMoves: Record<string, [number, number]> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
};

export interface KeyFinger {
  /** Whether the key is one of its keys. */
  key(event: KeyboardEvent): boolean;
  lift(): void;
  /** Shows where it is. */
  show(shown: boolean): void;
}

/**
 * `press`: it comes down at u, v (0 to 1 from the top left corner) with `firmness` times the usual force; `move`: it moves
 * while it is down; `lifted`: it comes up.
 */
export function keyFinger(
  { probe, status }: Parts,
  press: (u: number, v: number, firmness: number) => Finger,
  move: (finger: Finger, u: number, v: number) => void,
  lifted: () => void,
): KeyFinger {
  let u = 0.5;
  let v = 0.5;
  let firmness = 1;
  let finger: Finger | undefined;
  const say = (text: string) => (status.textContent = text);
  const lift = () => {
    if (!finger) return;
    finger = undefined;
    lifted();
    say("lifted");
  };
  return {
    lift,
    key({ key, repeat }) {
      const step = kMoves[key];
      if (step) {
        u = clamp(u + kStep * step[0], 0, 1);
        v = clamp(v + kStep * step[1], 0, 1);
        if (finger) move(finger, u, v);
      } else if (key === " " || key === "Enter") {
        if (finger && !repeat) lift();
        else if (!repeat) {
          say("pressed");
          finger = press(u, v, firmness);
        }
      } else if (key === "+" || key === "-") {
        firmness = clamp(firmness * (key === "+" ? 1.25 : 0.8), 0.25, 3);
        if (finger) finger.firmness = firmness;
        say(`force ${(kFullForceN * firmness).toFixed(1)} newton`);
      } else if (key === "Escape" && finger) lift();
      else return false;
      return true;
    },
    show(shown) {
      probe.hidden = !shown;
      probe.style.left = `${100 * u}%`;
      probe.style.top = `${100 * v}%`;
      probe.classList.toggle("down", !!finger);
    },
  };
}

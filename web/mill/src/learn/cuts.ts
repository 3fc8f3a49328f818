// SPDX-License-Identifier: MIT
// The cuts of the quiz: one job, and the same job with one thing wrong.

import { withKey } from "../setup/job_text.js";
import { word } from "../texts/texts.js";
import type { Order } from "../sources/workshop.js";
import type { Span } from "./clip.js";

export const JOB_NAME = "cut.toml";
const PROGRAM_NAME = "cut.nc";
export const SPINDLE_RPM = 6000;
export const FLUTES = 3;
const FEED_MM_PER_MIN = 900;
const STICKOUT_MM = 40;
const DEPTH_MM = 4;
// al7075-t6, written out: the forces of the edge, apart from those of the chip, are what a dull edge changes.
const EDGE = { kte_n_per_mm: 27.7, kre_n_per_mm: 26.6, kae_n_per_mm: 0.7 };

// The front of a block, 1 mm wide: climb milling, to the left. Machine and spindle are turned down and the chips up, so
// that the cut is heard well; the listener is in front of its middle.
const JOB = `# The cut of "Learn by ear"
[stock]
box_mm = [[0, 0, -20], [220, 20, 0]]

[[cutter]]
number = 1
kind = "flat"
diameter_mm = 10
flutes = ${FLUTES}
helix_deg = 30
length_mm = 22
stickout_mm = ${STICKOUT_MM}

[material]
ktc_n_per_mm2 = 767
krc_n_per_mm2 = 169
kac_n_per_mm2 = 222
${Object.entries(EDGE)
  .map(([key, value]) => `${key} = ${value}\n`)
  .join("")}
[process]
spindle_rpm = ${SPINDLE_RPM}
feed_mm_per_min = ${FEED_MM_PER_MIN}

[dynamics]
estimate = true

[sound]
mode = "pan"
listener_mm = [110, -800, 300]
gain_db = 12
cut_db = -12
spindle_db = -12
chips_db = 6

[path]
gcode = "${PROGRAM_NAME}"
`;

const program = (from: number, to: number, depth: number) =>
  `G21 G90 M3\nG0 X${from} Y-4 Z5\nG0 Z-${depth}\nG1 X${to}\nG0 Z5\n`;
const [LEFT, RIGHT] = [-10, 230] as const;

interface Parts {
  job: string;
  program: string;
  feed: number; // mm/min
}

export interface Cut {
  id: string;
  /** What is wrong. */
  name: string;
  /** Why it sounds as it does. */
  why: string;
  parts: Parts;
}

const RIGHT_PARTS: Parts = { job: JOB, program: program(RIGHT, LEFT, DEPTH_MM), feed: FEED_MM_PER_MIN };
const withFeed = (feed: number): Parts => ({
  ...RIGHT_PARTS,
  job: withKey(JOB, "process", "feed_mm_per_min", String(feed)),
  feed,
});
const withCutter = (key: string, value: number): Parts => ({
  ...RIGHT_PARTS,
  job: withKey(JOB, "cutter", key, String(value)),
});
const withProgram = (text: string): Parts => ({ ...RIGHT_PARTS, program: text });

export const RIGHT_CUT: Cut = {
  id: "right",
  name: word("The right cut"),
  why: word("Nothing is wrong with it."),
  parts: RIGHT_PARTS,
};

/** In the order in which the answers are offered. */
export const WRONG_CUTS: readonly Cut[] = [
  {
    id: "feed",
    name: word("Feed three times too high"),
    why: word(
      "Each tooth takes a chip that is three times as thick. The teeth are louder, and so is the hiss of the chips. The pitch stays, as it follows the spindle.",
    ),
    parts: withFeed(3 * FEED_MM_PER_MIN),
  },
  {
    id: "stickout",
    name: word("Tool sticks out half as far again"),
    why: word(
      "The longer tool bends more than three times as easily and swings by itself: a tone that is no multiple of the teeth's, and lower than that of a short tool.",
    ),
    parts: withCutter("stickout_mm", 1.5 * STICKOUT_MM),
  },
  {
    id: "rubbing",
    name: word("Edges rub, feed ten times too low"),
    why: word(
      "The chip is thinner than the edge is sharp. The edge slides more than it cuts: hum and hiss are weak. It sounds gentle and wears the edge out.",
    ),
    parts: withFeed(FEED_MM_PER_MIN / 10),
  },
  {
    id: "runout",
    name: word("Tool runs out of true"),
    why: word(
      "The tool is 0.06 mm beside the axis of the spindle, so one tooth takes most of the chip. Lower than the tone of the teeth is a new one, that of the turn.",
    ),
    parts: withCutter("runout_mm", 0.06),
  },
  {
    id: "conventional",
    name: word("Conventional in place of climb milling"),
    why: word(
      "A tooth now begins with no chip, slides, and leaves at the thickest. The forces are as large, but the tones of the teeth are softer, and the tool, thrown out of the cut, swings in high tones.",
    ),
    parts: withProgram(program(LEFT, RIGHT, DEPTH_MM)),
  },
  {
    id: "chatter",
    name: word("Chatter, three times too deep"),
    why: word(
      "Each tooth cuts the wave that the tooth before has left, and the wave grows: a howl of high tones, near the tool's own, over those of the teeth.",
    ),
    parts: withProgram(program(RIGHT, LEFT, 3 * DEPTH_MM)),
  },
  {
    id: "dull",
    name: word("Dull edges"),
    why: word(
      "The edge pushes three times as hard and cuts no more. The teeth are much louder, and the hiss of the chips is not.",
    ),
    parts: {
      ...RIGHT_PARTS,
      job: Object.entries(EDGE).reduce((text, [key, value]) => withKey(text, "material", key, String(3 * value)), JOB),
    },
  },
];

export function filesOf({ parts }: Cut): Record<string, string> {
  return { [JOB_NAME]: parts.job, [PROGRAM_NAME]: parts.program };
}

/** For the mill of the page. */
export function orderOf(cut: Cut): Order {
  const files = Object.entries(filesOf(cut)).map(([name, text]) => ({
    name,
    bytes: new TextEncoder().encode(text).buffer,
  }));
  return { files, job: JOB_NAME, part: "", cell: 0 };
}

const SKIP_S = 0.6;
const HEARD_S = 3;

/** What is heard: the middle of the block, in front of the listener, at every feed and in both directions. */
export function spanOf({ parts: { feed } }: Cut): Span {
  const middle_s = (60 * (RIGHT - LEFT)) / 2 / feed;
  return { from_s: middle_s - HEARD_S / 2 - SKIP_S, skip_s: SKIP_S, seconds: HEARD_S };
}

// SPDX-License-Identifier: MIT
// The film: half a minute in which a job shows itself. It is a list of shots. A shot says where the camera wants to be, and
// sets the clock, the colours and the curtain of the page; nothing is drawn or milled for the film alone.

import { Vector3 } from "three";

import type { Row, StateFrame } from "@tribo/protocol/frames";
import type { Command } from "@tribo/protocol/messages";
import type { Colouring } from "../sight/heat_map.js";
import type { Pose, Scene } from "../sight/scene.js";

/** What the film sets in the page. */
export interface Stage {
  readonly scene: Pick<Scene, "pose" | "wholePose" | "partPose" | "setCurtain" | "setFill" | "setBare">;
  readonly state: StateFrame | undefined;
  readonly duration: number; // of the program, s
  readonly rows: readonly Row[];
  readonly send: (command: Command) => void;
  readonly colour: (by: Colouring) => void;
  /** The part may be seen: what stood for it goes. */
  readonly reveal: () => void;
  /** Marks the line that the verdict names first. */
  readonly glow: (on: boolean) => void;
}

export type Phase = "prelude" | "plays" | "ended" | "skipped";

export interface Shot {
  readonly name: string;
  /** It lasts at least this long, s. */
  readonly seconds: number;
  /** Further conditions of its end, and how long they are waited for, s. */
  readonly done?: (stage: Stage) => boolean;
  readonly patience?: number;
  readonly begin?: (stage: Stage) => void;
  /** `share`: of `seconds`, 0 to 1. `elapsed`: s. */
  readonly each?: (stage: Stage, share: number) => void;
  readonly camera: (stage: Stage, elapsed: number) => Pose;
}

// A camera that is elsewhere flies to its new place in this time, s.
const FLIGHT_S = 1.6;
// Of the camera about the finished part, rad/s.
const TURN = 0.16;
// From the front right, little above the cutter, at a share of the distance from which the whole part is seen.
const LOW = new Vector3(0.4, -0.9, 0.36).normalize();
const CLOSE = 0.38;
// Towards the eye before the film: so low that the grooves reflect the light.
const GRAZING = new Vector3(0.42, -0.95, 0.4).normalize();
// Lead before the first cut, s of the program, and the speed through the air before a cut whose time is not known.
const LEAD_S = 0.3;
const AIR_SPEED = 60;
const FLOW_S = 2;
const PASS_S = 7;
const REST_S = 15;
const REST_AT_MOST_S = 60;
const END_S = 2;

const atEnd = ({ state, duration }: Stage) => (state?.time ?? 0) >= duration - 1e-3;
const smooth = (share: number) => share * share * (3 - 2 * share);

function atCutter({ scene, state }: Stage): Pose {
  const [x, y, z] = state?.tip ?? [0, 0, 0];
  return { target: new Vector3(x, y, z), towards: LOW, distance: CLOSE * scene.wholePose().distance };
}

/** The finished part, turning slowly, until somebody acts. */
export const PRELUDE: Shot[] = [
  {
    name: "finished",
    seconds: Infinity,
    begin: ({ scene, send, duration }) => {
      scene.setBare(true);
      send({ op: "seek", t_s: duration });
    },
    each: (stage) => {
      if (atEnd(stage)) stage.reveal();
    },
    camera: ({ scene }, elapsed) =>
      scene.partPose(GRAZING.clone().applyAxisAngle(new Vector3(0, 0, 1), TURN * elapsed)),
  },
];

export const FILM: Shot[] = [
  {
    name: "block",
    seconds: FLOW_S,
    begin: ({ scene, send, colour }) => {
      send({ op: "pause" });
      scene.setBare(true);
      colour("plain");
    },
    each: ({ scene }, share) => scene.setFill(smooth(share)),
    camera: ({ scene }) => scene.wholePose(),
  },
  {
    name: "approach",
    seconds: 0.2,
    begin: ({ scene, send, rows }) => {
      const [first] = rows;
      scene.setBare(false);
      send({ op: "seek", t_s: Math.max((first?.time ?? 0) - LEAD_S, 0) });
      send({ op: "speed", value: first ? 1 : AIR_SPEED });
      send({ op: "play" });
    },
    done: ({ state, rows }) => state !== undefined && (state.cutting || state.time < (rows[0]?.time ?? 0)),
    patience: 10,
    camera: atCutter,
  },
  {
    name: "first pass",
    seconds: PASS_S,
    begin: ({ scene, send }) => {
      scene.setFill(0);
      send({ op: "speed", value: 1 });
    },
    camera: atCutter,
  },
  {
    name: "the rest",
    seconds: REST_S,
    begin: ({ send, colour, state, duration }) => {
      colour("force");
      send({ op: "speed", value: Math.min(Math.max((duration - (state?.time ?? 0)) / REST_S, 1), 1000) });
    },
    each: ({ scene }, share) => scene.setCurtain(1 - smooth(share)),
    done: atEnd,
    patience: REST_AT_MOST_S,
    camera: ({ scene }) => scene.wholePose(),
  },
  {
    name: "verdict",
    seconds: END_S,
    begin: ({ glow }) => glow(true),
    camera: ({ scene }) => scene.wholePose(),
  },
];

/** Plays shots; each() is called for each picture. */
export class Director {
  private shots: Shot[] = [];
  private shot: Shot | undefined;
  private began = 0; // s
  private from: Pose | undefined;

  /** `still`: the camera jumps in place of flying. `told` is called when the phase changes. */
  constructor(
    private readonly stage: Stage,
    private readonly still: boolean,
    private readonly told: (phase: Phase) => void,
  ) {}

  get shows(): string | undefined {
    return this.shot?.name;
  }

  play(shots: Shot[], now: number): void {
    this.shots = [...shots];
    this.stage.glow(false);
    this.told(shots === PRELUDE ? "prelude" : "plays");
    this.next(now);
  }

  /** Somebody wants to use the page. */
  skip(): void {
    if (!this.shot) return;
    const finished = this.shot.name === "verdict";
    const { scene, send, colour } = this.stage;
    this.shot = undefined;
    scene.setFill(0);
    scene.setBare(false);
    scene.setCurtain(1);
    if (!finished) {
      send({ op: "pause" });
      colour("plain");
    }
    this.told(finished ? "ended" : "skipped");
  }

  /** `now` in s. */
  each(now: number): void {
    const { shot, stage } = this;
    if (!shot) return;
    const elapsed = now - this.began;
    const share = Number.isFinite(shot.seconds) ? Math.min(elapsed / shot.seconds, 1) : 0;
    shot.each?.(stage, share);
    this.fly(shot.camera(stage, elapsed), elapsed);
    const waits = shot.done && !shot.done(stage) && elapsed < (shot.patience ?? Infinity);
    if (elapsed >= shot.seconds && !waits) this.next(now);
  }

  private next(now: number): void {
    const next = this.shots.shift();
    if (!next) return this.skip();
    this.shot = next;
    this.began = now;
    this.from = this.stage.scene.pose;
    next.begin?.(this.stage);
  }

  private fly(to: Pose, elapsed: number): void {
    const share = this.still ? 1 : smooth(Math.min(elapsed / FLIGHT_S, 1));
    this.stage.scene.pose = share < 1 && this.from ? between(this.from, to, share) : to;
  }
}

/** A pose on the way; the eye keeps its distance. */
export function between(a: Pose, b: Pose, share: number): Pose {
  return {
    target: a.target.clone().lerp(b.target, share),
    towards: a.towards.clone().lerp(b.towards, share).normalize(),
    distance: a.distance + share * (b.distance - a.distance),
  };
}

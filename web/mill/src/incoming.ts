// SPDX-License-Identifier: MIT
// What comes in: frames and messages of the current source, to picture, sound and panels.

import type { CollisionFrame, Frame, StateFrame } from "@tribo/protocol/frames";
import type { Files, ServerInfo, Settings } from "@tribo/protocol/messages";
import { element } from "@tribo/ui/dom";
import type { AuditOfMill } from "@tribo/wasm/audit";
import type { Moment } from "./keep/moment.js";
import { listenToRecord } from "./keep/record.js";
import type { Lanes } from "./lanes/lanes.js";
import { advise, say } from "./panels/notice.js";
import type { ChatterPanel } from "./panels/chatter.js";
import type { Colours } from "./panels/colours.js";
import type { FeelPanel } from "./panels/feel.js";
import type { History } from "./panels/history.js";
import type { Now } from "./panels/now.js";
import type { Parameters } from "./panels/parameters.js";
import type { Plots } from "./panels/plots.js";
import type { Program } from "./panels/program.js";
import { Assumed, LineList, showFileFault, showServo } from "./panels/readout.js";
import type { Scene } from "./sight/scene.js";
import { Sound } from "./sound/sound.js";
import { FrameCache } from "./sources/frame_cache.js";
import type { Listener } from "./sources/source.js";
import { t, word } from "./texts/texts.js";
import type { Finger } from "./touch/finger.js";
import { pulseHeadset } from "./touch/headset.js";
import type { Transport } from "./transport/transport.js";

/** What shows, plays and tells it. */
export interface Parts {
  scene: Scene;
  sound: Sound;
  history: History;
  lanes: Lanes;
  program: Program;
  numbers: Now;
  colours: Colours;
  transport: Transport;
  finger: Finger;
  parameters: Parameters;
  feel: FeelPanel;
  chatter: ChatterPanel;
}

// To feel the part.
const FEEL_IT = word("Hold a press on the part to feel it");

export class Incoming implements Listener {
  // Opened, and not shown yet.
  arriving: Moment | undefined;
  plots: Plots | undefined;
  /** True when the page plays the sound, false when the engine does. */
  soundsHere = true;
  /** Settings as the job says, and now. */
  asWritten: Settings | undefined;
  settingsNow: Settings | undefined;
  duration = 0;
  milled = 0;
  hits: CollisionFrame[] = [];
  /** The newest state of the job. */
  shown: StateFrame | undefined;
  /** The audit of the rows so far. */
  told: AuditOfMill | undefined;
  programmedRpm = 0;
  private begun = false;
  private felt = false;
  private invitation = FEEL_IT;
  private first = true;
  private forceLimit = 3;
  private stoppedAtHit = false;
  private spindlePercent = 100;
  // A source whose tool bends is shown by its chatter, unless the user has chosen.
  private chatterOffered = false;
  private readonly assumed = new Assumed();
  private readonly frameCache = new FrameCache();
  private readonly record = listenToRecord(this.frameCache);
  // The verdict names the first.
  private readonly collisions = new LineList<CollisionFrame>(
    "collisions",
    (hit) => {
      this.mark(hit);
      this.parts.transport.seek(hit.time);
    },
    2,
  );

  /** `lost`: whether it is the current source whose line to the engine was lost. */
  constructor(
    private readonly parts: Parts,
    private readonly lost: () => boolean,
  ) {}

  frame(frame: Frame, bytes: ArrayBuffer): void {
    const { scene, sound, history, lanes, program, numbers, colours, transport, finger, chatter } = this.parts;
    this.frameCache.take(frame, bytes);
    this.record(bytes);
    sound.frame(frame.kind, bytes);
    switch (frame.kind) {
      case "job":
        this.duration = frame.duration;
        transport.begin(this.duration);
        this.collisions.clear();
        history.begin(this.duration);
        lanes.begin(this.duration);
        program.begin();
        numbers.begin();
        this.hits = [];
        this.shown = undefined;
        this.stoppedAtHit = false;
        this.told = undefined;
        scene.begin(frame);
        this.assumed.draw(frame);
        chatter.begin();
        element("chatter-colouring").hidden = true;
        element("designed-label").hidden = true;
        if (this.first && this.arriving) scene.view = this.arriving.view;
        else if (this.first) scene.fit();
        this.first = false;
        break;
      case "chunk":
        scene.take(frame);
        break;
      case "path":
        scene.addPath(frame);
        program.takePath(frame);
        break;
      case "designed":
        scene.addDesigned(frame);
        element("designed-label").hidden = false;
        break;
      case "rows":
        if (frame.anew) {
          lanes.forgetRows();
          numbers.forgetRows();
          program.forgetRows();
          history.forgetRows();
          scene.forgetRows();
        }
        lanes.addRows(frame.rows);
        program.addRows(frame.rows);
        numbers.addRows(frame.rows);
        history.addRows(frame.rows);
        scene.addRows(frame.rows);
        // That of the clock may be among them.
        if (this.shown) numbers.show(this.shown, history.rowAt(this.shown.time));
        break;
      case "sound":
        history.addPieces(frame.pieces);
        lanes.addPieces(frame.pieces);
        break;
      case "bending":
        history.bends = true;
        chatter.open();
        element("chatter-colouring").hidden = false;
        if (!this.chatterOffered && colours.now === "plain") colours.choose("chatter");
        this.chatterOffered = true;
        break;
      case "multipliers": {
        const rows = history.addMultipliers(frame.first, frame.multipliers);
        scene.showMultipliers(rows, frame.first);
        lanes.addMultipliers(rows);
        break;
      }
      case "chart":
        chatter.take(frame);
        break;
      case "collision":
        this.collisions.add(frame, frame.what);
        this.hits.push(frame);
        lanes.addDamage(frame.time);
        break;
      case "finger":
        element("felt-row").hidden = !frame.present;
        element("felt").textContent = `${Math.hypot(...frame.force).toFixed(2)} N`;
        if (frame.present) scene.overlays.showFinger(frame);
        else scene.overlays.hideFinger();
        finger.rumble(Math.hypot(...frame.force), this.forceLimit);
        if (frame.contact && !this.felt) {
          this.felt = true;
          advise("");
        }
        pulseHeadset(frame);
        scene.draw();
        break;
      case "servo":
        showServo(frame);
        break;
      case "texture":
        scene.overlays.showTexture(frame);
        scene.draw();
        break;
      case "state":
        this.show(frame);
        if (this.arriving) colours.choose(this.arriving.colouring);
        this.arriving = undefined;
        break;
      case "program":
        program.take(frame);
        // Its panel takes room.
        scene.centre();
        break;
      case "listening":
      case "other":
        break;
    }
  }

  private show(state: StateFrame): void {
    const { scene, sound, history, lanes, program, numbers, transport, finger, chatter } = this.parts;
    const before = this.shown;
    scene.show(state);
    sound.state(state);
    this.programmedRpm = (100 * state.rpm) / this.spindlePercent;
    chatter.show(state, this.programmedRpm);
    lanes.show(state.time, state.milled);
    program.show(state.line);
    history.time = state.time;
    this.plots?.changed();
    transport.show(state);
    if (state.playing) this.begun = true;
    element("begin").hidden = this.begun || this.duration === 0;
    // They would cover what has been cut until then.
    element("invitation").classList.toggle("away", state.time > 0);
    element("examples").hidden ||= this.begun;
    element("learn-begin").hidden ||= this.begun;
    this.shown = state;
    numbers.show(state, history.rowAt(state.time));
    this.milled = state.milled;
    if (finger.enabled && this.begun && !this.felt) advise(t(this.invitation));
    // At last: a source may answer at once.
    if (before) this.stopAtCollision(before, state);
  }

  // The clock stops at the first collision that it passes; after a step back again. One step may pass it and end the program.
  private stopAtCollision(before: StateFrame, now: StateFrame): void {
    if (now.time < before.time) this.stoppedAtHit = false;
    const hit = this.hits.find(({ time }) => time > before.time && time <= now.time);
    if (!hit || this.stoppedAtHit || !(this.parts.transport.pause() || before.playing)) return;
    this.stoppedAtHit = true;
    this.mark(hit);
    say(t("Line {line}: {what}. The clock stands; Play goes on.", { line: hit.line, what: hit.what }));
  }

  /** Marks where a collision is. */
  mark({ tip }: CollisionFrame): void {
    this.parts.scene.overlays.setMark(tip);
    this.parts.scene.draw();
  }

  /** Another source begins: its first frames restart the picture. */
  begin(): void {
    const { finger, feel, scene, parameters } = this.parts;
    this.begun = false;
    this.first = true;
    this.chatterOffered = false;
    this.invitation = FEEL_IT;
    this.asWritten = undefined;
    finger.enabled = false;
    feel.hide();
    scene.overlays.hideFinger();
    parameters.clear();
  }

  /** What there is to do after the film. */
  invite(): void {
    this.felt = false;
    this.invitation = word("Hold a press on the part to feel it, or drop a job of your own here");
    advise(t(this.invitation));
  }

  info(message: ServerInfo): void {
    const { finger, parameters } = this.parts;
    const name = (message.job ?? "").replace(/^.*\//, "");
    document.title = name ? `${name} - Tribo` : t("Tribo: mill");
    if (message.job === undefined) {
      advise(t("Drop a job with its files, G-code, APT or keyframes here, or press Open"));
      element("learn-begin").hidden = element("examples").hidden = false;
    }
    element("job").textContent = name;
    this.assumed.tell(message.warnings);
    showFileFault(null);
    parameters.info(message);
    this.soundsHere = (message.audio ?? "browser") === "browser";
    element("sound").hidden = !this.soundsHere || !Sound.possible;
    this.forceLimit = message.device?.max_force_n || 3;
    finger.arm = message.device?.arm ?? false;
  }

  settings(s: Settings): void {
    const { scene, finger, parameters, feel } = this.parts;
    parameters.show(s);
    this.spindlePercent = s.spindle_percent;
    this.asWritten ??= s;
    this.settingsNow = s;
    scene.setHelix(s.helix_deg);
    finger.enabled = true;
    feel.show(s);
  }

  line(there: boolean, why: string): void {
    say(there ? "" : this.lost() ? t("No line to the engine: {why}. Trying again.", { why }) : why);
  }

  files({ wrong, warnings }: Files): void {
    showFileFault(wrong);
    this.assumed.tell(warnings);
  }

  audit(told: AuditOfMill, lines: Float64Array): void {
    this.told = told;
    this.parts.numbers.audit(lines);
  }

  refused(why: string): void {
    say(why);
  }
}

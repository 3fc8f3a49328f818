// SPDX-License-Identifier: MIT
// The page of the mill: converts frames to picture, sound and plots, and sends input to the current source.

import * as drop from "./sources/drop.js";
import { canvas, context, hasEngine, line } from "./early.js";
import { EXAMPLES } from "./gallery/list.js";
import { order as orderOf } from "./sources/examples.js";
import { Finger } from "./touch/finger.js";
import type { CollisionFrame, Frame, StateFrame } from "@tribo/protocol/frames";
import { listenToCompare } from "./compare/compare.js";
import { ChatterPanel } from "./panels/chatter.js";
import { Film } from "./film/film.js";
import { History } from "./panels/history.js";
import { listenToKeys } from "./panels/keys.js";
import { fileName, listenToKeep } from "./keep/keep.js";
import { changesOf, type Moment } from "./keep/moment.js";
import { Reopen, setFragment } from "./keep/reopen.js";
import { listenToRecord } from "./keep/record.js";
import { listenToVideo } from "./keep/video.js";
import { FeelPanel } from "./panels/feel.js";
import { listenToFiles } from "./sources/file_input.js";
import { FrameCache } from "./sources/frame_cache.js";
import { recall, remember } from "./page.js";
import { listenToLook } from "./panels/look.js";
import { listenToMeasure } from "./panels/measure.js";
import { listenToGallery, listenToMoreLanes, listenToProgramSheet, listenToQuiz, toggles } from "./panels/openers.js";
import { Parameters } from "./panels/parameters.js";
import { Lanes } from "./lanes/lanes.js";
import { Now } from "./panels/now.js";
import { Program } from "./panels/program.js";
import { Verdict } from "./panels/verdict.js";
import { Colours } from "./panels/colours.js";
import type { Plots } from "./panels/plots.js";
import { Assumed, ChipList, LineList, showFileFault, showServo } from "./panels/readout.js";
import { readRecording } from "@tribo/protocol/recording";
import { element, wordsOf } from "@tribo/ui/dom";
import { Replay } from "./sources/replay.js";
import { t, word } from "./texts/texts.js";
import { Scene } from "./sight/scene.js";
import { Sound } from "./sound/sound.js";
import { listenToHeadset, pulseHeadset } from "./touch/headset.js";
import { Transport } from "./transport/transport.js";
import type { Command, ServerInfo, Settings } from "@tribo/protocol/messages";
import type { Listener, Source } from "./sources/source.js";
import type { AuditOfMill } from "@tribo/wasm/audit";
import { Workshop, type JobFile, type Order } from "./sources/workshop.js";
import { SetUpCard } from "./setup/card.js";
import { StockHandles } from "./setup/stock_handles.js";
import { chainOf, textOf } from "./setup/chain.js";
import { MachineQuestion } from "./setup/machine_question.js";
import { jobNameOf, withJob } from "./setup/with_job.js";

const listener: Listener = {
  frame: take,
  info(message: ServerInfo) {
    const name = (message.job ?? "").replace(/^.*\//, "");
    document.title = name ? `${name} - Tribo` : t("Tribo: mill");
    if (message.job === undefined) {
      advise(t("Drop a job with its files, G-code, APT or keyframes here, or press Open"));
      element("learn-begin").hidden = element("examples").hidden = false;
    }
    element("job").textContent = name;
    assumed.tell(message.warnings);
    showFileFault(null);
    parameters.info(message);
    soundsHere = (message.audio ?? "browser") === "browser";
    element("sound").hidden = !soundsHere || !Sound.possible;
    forceLimit = message.device?.max_force_n || 3;
    finger.arm = message.device?.arm ?? false;
  },
  settings(s: Settings) {
    parameters.show(s);
    spindlePercent = s.spindle_percent;
    asWritten ??= s;
    settings = s;
    scene.setHelix(s.helix_deg);
    finger.enabled = true;
    feel.show(s);
  },
  line(there, why) {
    say(there ? "" : hasEngine && source === engine ? t("No line to the engine: {why}. Trying again.", { why }) : why);
  },
  files({ wrong, warnings }) {
    showFileFault(wrong);
    assumed.tell(warnings);
  },
  audit(told, lines) {
    audit = told;
    numbers.audit(lines);
  },
  refused: say,
};

const engine = hasEngine ? line() : undefined;
let source: Source | undefined = engine;

const scene = new Scene(canvas, context);
const history = new History();
const frameCache = new FrameCache();
const record = listenToRecord(frameCache);
const sound = new Sound();
// True when the page plays the sound, false when the engine does.
let soundsHere = true;
const transport = new Transport(
  (command) => source?.send(command),
  () => {
    if (!Sound.possible) element("sound").hidden = true;
    void hear();
  },
  () => history.rows,
);
const seek = (t_s: number) => transport.seek(t_s);
const lanes = new Lanes(element<HTMLCanvasElement>("lanes"), element("time"));
const program = new Program(seek);
const numbers = new Now();
const verdict = new Verdict(({ time: at, line: of }) => {
  if (at === undefined) program.choose(of);
  else seek(at);
});
const colours = new Colours(scene, say);
const collisions = new LineList<CollisionFrame>("collisions", ({ tip, time: at }) => {
  scene.overlays.setMark(tip);
  scene.draw();
  seek(at);
});
const chips = new ChipList((mark) => seek(mark.time));
const finger = new Finger(scene, () => source);
const assumed = new Assumed();
const send = (command: Command) => source?.send(command);
const parameters = new Parameters(send);
const feel = new FeelPanel(send);
// In the limits of the command.
const chatter = new ChatterPanel((rpm) => {
  if (!(programmedRpm > 0)) return;
  const percent = Math.min(Math.max((100 * rpm) / programmedRpm, 10), 300);
  source?.send({ op: "set", key: "spindle_percent", value: Number(percent.toPrecision(5)) });
});
const notice = element("notice");
const begin = element<HTMLButtonElement>("begin");
const hint = element("hint");

let order: Order | undefined;
// Settings as the job says, and now.
let asWritten: Settings | undefined;
let settings: Settings | undefined;
// Opened, and not shown yet.
let arriving: Moment | undefined;
let plots: Plots | undefined;
let begun = false;
let felt = false;
// To feel the part.
const FEEL_IT = word("Press on the part to feel it");
let invitation = FEEL_IT;
let first = true;
let forceLimit = 3;
let duration = 0;
let milled = 0;
let hits: CollisionFrame[] = [];
// The newest state of the job.
let shown: StateFrame | undefined;
let stoppedAtHit = false;
let audit: AuditOfMill | undefined;
let spindlePercent = 100;
let programmedRpm = 0;
// A source whose tool bends is shown by its chatter, unless the user has chosen.
let chatterOffered = false;

function say(text: string): void {
  element("notice-box").hidden = text === "";
  notice.textContent = text;
}
element("dismiss").addEventListener("click", () => say(""));
function advise(text: string): void {
  hint.hidden = text === "";
  hint.textContent = text;
}

// The clock stops at the first collision that it passes; after a step back again. One step may pass it and end the program.
function stopAtCollision(before: StateFrame, now: StateFrame): void {
  if (now.time < before.time) stoppedAtHit = false;
  const hit = hits.find(({ time }) => time > before.time && time <= now.time);
  if (!hit || stoppedAtHit || !(transport.pause() || before.playing)) return;
  stoppedAtHit = true;
  say(t("Line {line}: {what}. The clock stands; Play goes on.", { line: hit.line, what: hit.what }));
}

function show(state: StateFrame): void {
  const before = shown;
  scene.show(state);
  sound.state(state);
  programmedRpm = (100 * state.rpm) / spindlePercent;
  chatter.show(state, programmedRpm);
  lanes.show(state.time, state.milled);
  program.show(state.line);
  history.time = state.time;
  plots?.changed();
  transport.show(state);
  if (state.playing) begun = true;
  begin.hidden = begun || duration === 0;
  element("examples").hidden ||= begun;
  element("learn-begin").hidden ||= begun;
  shown = state;
  numbers.show(state, history.rowAt(state.time));
  milled = state.milled;
  if (finger.enabled && begun && !felt) advise(t(invitation));
  // At last: a source may answer at once.
  if (before) stopAtCollision(before, state);
}

function take(frame: Frame, bytes: ArrayBuffer): void {
  frameCache.take(frame, bytes);
  record(bytes);
  sound.frame(frame.kind, bytes);
  switch (frame.kind) {
    case "job":
      duration = frame.duration;
      transport.begin(duration);
      collisions.clear();
      history.begin(duration);
      lanes.begin(duration);
      program.begin();
      numbers.begin();
      hits = [];
      shown = undefined;
      stoppedAtHit = false;
      audit = undefined;
      scene.begin(frame);
      assumed.draw(frame);
      chatter.begin();
      element("chatter-colouring").hidden = true;
      element("designed-label").hidden = true;
      if (first && arriving) scene.view = arriving.view;
      else if (first) scene.fit();
      first = false;
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
      if (shown) numbers.show(shown, history.rowAt(shown.time));
      break;
    case "sound":
      history.addPieces(frame.pieces);
      lanes.addPieces(frame.pieces);
      break;
    case "bending":
      history.bends = true;
      chatter.open();
      element("chatter-colouring").hidden = false;
      if (!chatterOffered && colours.now === "plain") colours.choose("chatter");
      chatterOffered = true;
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
      collisions.add(frame, frame.what);
      hits.push(frame);
      lanes.addDamage(frame.time);
      break;
    case "finger":
      element("felt-row").hidden = !frame.present;
      element("felt").textContent = `${Math.hypot(...frame.force).toFixed(2)} N`;
      if (frame.present) scene.overlays.showFinger(frame);
      else scene.overlays.hideFinger();
      finger.rumble(Math.hypot(...frame.force), forceLimit);
      if (frame.contact && !felt) {
        felt = true;
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
      show(frame);
      if (arriving) colours.choose(arriving.colouring);
      arriving = undefined;
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

// Changes the source. The picture restarts with its first frames.
function change(to: () => Source): void {
  film.skip();
  source?.close();
  begun = false;
  first = true;
  chatterOffered = false;
  invitation = FEEL_IT;
  asWritten = undefined;
  finger.enabled = false;
  feel.hide();
  scene.overlays.hideFinger();
  parameters.clear();
  card.show(undefined);
  source = to();
  // A link is of the job that it opened.
  setFragment("");
  element("keep-link").hidden = element("compare").hidden = !(source instanceof Workshop);
  element("link-box").hidden = true;
  transport.beginSource();
}

async function mill(wanted: Order): Promise<boolean> {
  say("");
  advise(t("Reading ..."));
  question.close();
  const next = new Workshop(listener);
  const refusal = await next.open(wanted);
  advise("");
  if (refusal) {
    next.close();
    if (refusal.lacksMachine) question.ask(wanted, refusal.lacksMachine);
    else say(refusal.why);
    return false;
  }
  order = wanted;
  change(() => next);
  if (!element("panel").hidden) void showSetUp();
  return true;
}

// ---- Set-up, of what the page mills itself
const handles = new StockHandles(scene, (box, done) => card.stretch(box, done));
const card: SetUpCard = new SetUpCard(
  (text) => (order ? mill(withJob(order, text, setUpShown())) : Promise.resolve(false)),
  (box) => handles.show(element("panel").hidden ? undefined : box),
  (name) => {
    turnedTo = name;
    void showSetUp();
  },
);
// One of a chain of set-ups that the user turned to; undefined: the last one.
let turnedTo: string | undefined;
const setUpShown = () => order && chainOf(order).find(({ name }) => name === turnedTo)?.name;
const question = new MachineQuestion((answered) => void mill(answered));
async function showSetUp(): Promise<void> {
  if (!(source instanceof Workshop) || !order) return card.show(undefined);
  const setUp = await source.setUp();
  const chain = chainOf(order);
  const shownJob = chain.find(({ name }) => name === turnedTo);
  const own = shownJob && { text: textOf(shownJob) };
  const names = chain.map(({ name }) => name);
  card.show(setUp && { name: shownJob?.name ?? jobNameOf(order), ...setUp, ...own, chain: names });
}

// ---- Moments
function momentNow(): Moment | undefined {
  if (!(source instanceof Workshop) || !order || !asWritten || !settings) return undefined;
  const changes = changesOf(asWritten, settings);
  return { order, t_s: history.time, changes, view: scene.view, colouring: colours.now };
}
listenToCompare({ now: momentNow, pause: () => transport.pause(), say });
const reopen = new Reopen({
  now: momentNow,
  comesAgain: () => source === engine,
  async open(moment) {
    if (!(await mill(moment.order))) return false;
    arriving = moment;
    for (const { key, value } of moment.changes)
      source?.send(key === "material" ? { op: key, value } : { op: "set", key, value });
    source?.send({ op: "seek", t_s: moment.t_s });
    return true;
  },
  say,
});

function replay(file: JobFile): void {
  try {
    const frames = readRecording(file.bytes);
    change(() => new Replay(listener, frames, file.name));
    say("");
  } catch (error) {
    say(`${file.name}: ${wordsOf(error)}`);
  }
}

async function open(files: { name: string; file: File }[]): Promise<void> {
  const large = drop.tooLarge(files.map(({ name, file }) => ({ name, size: file.size })));
  if (large) return say(large);
  const wanted = drop.sort(await drop.read(files), order);
  if ("refused" in wanted) say(wanted.refused);
  else if ("recording" in wanted) replay(wanted.recording);
  else if ("moment" in wanted) await reopen.openPacked(wanted.moment.bytes, wanted.moment.name);
  else await mill(wanted.order);
}

// ---- The film
const film = new Film(
  {
    scene,
    get state() {
      return shown;
    },
    get duration() {
      return duration;
    },
    get rows() {
      return history.rows;
    },
    send,
    colour: (by) => colours.choose(by),
    glow(on) {
      program.glow(on ? (verdict.worst?.line ?? 0) : 0);
      element("verdict").classList.toggle("glowing", on);
    },
  },
  {
    hear,
    direct(on) {
      transport.directed = on;
      if (!on) transport.tell();
    },
    rewind() {
      seek(0);
      scene.fit();
    },
    invite() {
      felt = false;
      invitation = word("Rub it, or drop a job of your own here");
      advise(t(invitation));
    },
    say,
  },
);

// ---- Begin, problems
begin.addEventListener("click", () => transport.toggle());
function goToProblem(): void {
  const next = lanes.problemAfter(history.time);
  if (next) seek(next.time);
}
element("next-problem").addEventListener("click", goToProblem);

// ---- Sound
async function hear(): Promise<void> {
  if (!Sound.possible || !soundsHere) return;
  try {
    await sound.wake();
  } catch (error) {
    say(t("There is no sound: {why}", { why: wordsOf(error) }));
  }
  element("sound").setAttribute("aria-pressed", String(sound.running && !sound.muted));
}
element("sound").addEventListener("click", () => {
  sound.muted = sound.running && !sound.muted;
  remember("muted", String(sound.muted));
  void hear();
});
sound.muted = recall("muted") === "true";
if (!Sound.possible) element("sound").hidden = true;

// ---- Look
listenToLook(scene, (to) => void reopen.changeLanguage(to));
listenToMeasure(scene);
setInterval(() => {
  chips.show(colours.now === "chip" ? scene.heatMap.chipMarks() : []);
  element("next-problem").hidden = lanes.problemAfter(history.time) === undefined;
  verdict.show({
    collisions: hits,
    chips: scene.heatMap.chipMarks(),
    strongest: history.strongest,
    wildest: history.wildest,
    audit,
    whole: milled >= duration - 1e-3,
  });
}, 500);

// ---- Panels
toggles("show-panel", "panel", () => void showSetUp());
element("show-panel").addEventListener("click", () => card.tellStock());
listenToProgramSheet();
listenToMoreLanes((all) => lanes.showAll(all));
// Panels leave the rest of the window to the part.
scene.keepFree(() => {
  const { x, y, width, height } = element("stage").getBoundingClientRect();
  // Before the film the panels are away, and its buttons lie below the part.
  if (document.body.dataset.film !== "prelude") return { x, y, width, height };
  return { x: 0, y, width: innerWidth, height: element("film-buttons").getBoundingClientRect().top - y };
});
new ResizeObserver(() => scene.centre()).observe(element("stage"));
toggles("show-plots", "plots", async () => {
  const loaded = await import("./panels/plots.js");
  plots ??= new loaded.Plots(element("plots"), history, sound, seek);
  plots.changed();
});

// ---- Keep
listenToKeep(scene, history, say, momentNow);
listenToVideo(scene, sound, { wake: hear, name: () => fileName(history, "webm"), say });

listenToQuiz({ mill, pause: () => transport.pause(), say });
listenToGallery({ mill, say });

listenToFiles(open);

listenToHeadset(scene, finger, { hear, play: () => transport.toggle() });

listenToKeys(scene, finger, {
  play: () => transport.toggle(),
  mute: () => element("sound").click(),
  seek: (by) => transport.seekBy(by),
  nextProblem: goToProblem,
  loop: () => element("loop").click(),
});

function eachPicture(): void {
  finger.pollGamepad();
  plots?.update();
  requestAnimationFrame(eachPicture);
}
requestAnimationFrame(eachPicture);

engine?.listen(listener);

// ---- Without an engine the page mills
if (!hasEngine) {
  element("learn-begin").hidden = element("examples").hidden = false;
  void reopen.followLink().then(async (opened) => {
    if (opened) return;
    const why = notice.textContent;
    if (await mill(await orderOf(EXAMPLES[0]!))) film.begin();
    if (why) say(why);
  });
  addEventListener("hashchange", () => void reopen.followLink());
}

// SPDX-License-Identifier: MIT
// The page of the mill, what goes out: where its jobs come from, and what its buttons send to the current source. What
// comes in is in incoming.ts.

import * as drop from "./sources/drop.js";
import { canvas, context, hasEngine, line } from "./early.js";
import { EXAMPLES } from "./gallery/list.js";
import { order as orderOf } from "./sources/examples.js";
import { Finger } from "./touch/finger.js";
import { listenToCompare } from "./compare/compare.js";
import { ChatterPanel } from "./panels/chatter.js";
import { Film } from "./film/film.js";
import { hidePoster } from "./film/first_visit.js";
import { History } from "./panels/history.js";
import { listenToKeys } from "./panels/keys.js";
import { fileName, listenToKeep } from "./keep/keep.js";
import { changesOf, type Moment } from "./keep/moment.js";
import { Reopen, setFragment } from "./keep/reopen.js";
import { listenToVideo } from "./keep/video.js";
import { FeelPanel } from "./panels/feel.js";
import { listenToFiles } from "./sources/file_input.js";
import { Incoming } from "./incoming.js";
import { freeOf, OVER_STAGE } from "./panels/free.js";
import { recall, remember } from "./page.js";
import { advise, say } from "./panels/notice.js";
import { listenToLook } from "./panels/look.js";
import { listenToMeasure } from "./panels/measure.js";
import { listenToGallery, listenToMoreLanes, listenToProgramSheet, listenToQuiz, toggles } from "./panels/openers.js";
import { Parameters } from "./panels/parameters.js";
import { Lanes } from "./lanes/lanes.js";
import { Now } from "./panels/now.js";
import { Program } from "./panels/program.js";
import { Verdict } from "./panels/verdict.js";
import { Colours } from "./panels/colours.js";
import { ChipList } from "./panels/readout.js";
import { readRecording } from "@tribo/protocol/recording";
import { element, wordsOf } from "@tribo/ui/dom";
import { Replay } from "./sources/replay.js";
import { t } from "./texts/texts.js";
import { Scene } from "./sight/scene.js";
import { Sound } from "./sound/sound.js";
import { listenToHeadset } from "./touch/headset.js";
import { Transport } from "./transport/transport.js";
import type { Command } from "@tribo/protocol/messages";
import type { Source } from "./sources/source.js";
import { Workshop, type JobFile, type Order } from "./sources/workshop.js";
import { SetUpCard } from "./setup/card.js";
import { StockHandles } from "./setup/stock_handles.js";
import { chainOf, textOf } from "./setup/chain.js";
import { MachineQuestion } from "./setup/machine_question.js";
import { jobNameOf, withJob } from "./setup/with_job.js";

const engine = hasEngine ? line() : undefined;
let source: Source | undefined = engine;

const scene = new Scene(canvas, context);
const history = new History();
const sound = new Sound();
const transport = new Transport(
  (command) => source?.send(command),
  () => {
    if (!Sound.possible) element("sound").hidden = true;
    void hear();
  },
  () => history.rows,
);
const seek = (t_s: number) => transport.seek(t_s);
const lanes = new Lanes(element<HTMLCanvasElement>("lanes"), element("time"), (time) => history.rowAt(time));
const program = new Program(seek);
const numbers = new Now();
const verdict = new Verdict(({ kind, time: at, line: of }) => {
  const hit = incoming.hits.find(({ time }) => kind === "damage" && time === at);
  if (hit) incoming.mark(hit);
  if (at === undefined) program.choose(of);
  else seek(at);
});
const colours = new Colours(scene, say);
const chips = new ChipList((mark) => seek(mark.time));
const finger = new Finger(scene, () => source);
const send = (command: Command) => source?.send(command);
const parameters = new Parameters(send);
const feel = new FeelPanel(send, (on) => (finger.atOnce = on));
// In the limits of the command.
const chatter = new ChatterPanel((rpm) => {
  const { programmedRpm } = incoming;
  if (!(programmedRpm > 0)) return;
  const percent = Math.min(Math.max((100 * rpm) / programmedRpm, 10), 300);
  source?.send({ op: "set", key: "spindle_percent", value: Number(percent.toPrecision(5)) });
});
const incoming = new Incoming(
  { scene, sound, history, lanes, program, numbers, colours, transport, finger, parameters, feel, chatter },
  () => engine !== undefined && source === engine,
);
// What the page mills now.
let order: Order | undefined;

element("dismiss").addEventListener("click", () => say(""));
// Changes the source. The picture restarts with its first frames.
function change(to: () => Source): void {
  film.skip();
  source?.close();
  incoming.begin();
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
  const next = new Workshop(incoming);
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
  const { asWritten, settingsNow } = incoming;
  if (!(source instanceof Workshop) || !order || !asWritten || !settingsNow) return undefined;
  const changes = changesOf(asWritten, settingsNow);
  return { order, t_s: history.time, changes, view: scene.view, colouring: colours.now };
}
listenToCompare({ now: momentNow, pause: () => transport.pause(), say });
const reopen = new Reopen({
  now: momentNow,
  comesAgain: () => source === engine,
  async open(moment) {
    if (!(await mill(moment.order))) return false;
    incoming.arriving = moment;
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
    change(() => new Replay(incoming, frames, file.name));
    say("");
  } catch (error) {
    say(`${file.name}: ${wordsOf(error)}`);
  }
}

async function open(files: { name: string; file: File }[]): Promise<void> {
  const sizes = files.map(({ name, file }) => ({ name, size: file.size }));
  const large = drop.tooLarge(sizes, engine !== undefined);
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
      return incoming.shown;
    },
    get duration() {
      return incoming.duration;
    },
    get rows() {
      return history.rows;
    },
    send,
    colour: (by) => colours.choose(by),
    reveal: () => hidePoster(true),
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
    invite: () => incoming.invite(),
    say,
  },
);

// ---- Begin, problems
element("begin").addEventListener("click", () => transport.toggle());
function goToProblem(): void {
  const next = lanes.problemAfter(history.time);
  if (next) seek(next.time);
}
element("next-problem").addEventListener("click", goToProblem);

// ---- Sound
async function hear(): Promise<void> {
  if (!Sound.possible || !incoming.soundsHere) return;
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
  const { hits: collisions, told: audit, milled, duration } = incoming;
  verdict.show({
    collisions,
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
scene.keepFree(() => freeOf(document.body.dataset.film === "prelude"));
const shapes = new ResizeObserver(() => scene.centre());
for (const id of ["stage", ...OVER_STAGE]) shapes.observe(element(id));
toggles("show-plots", "plots", async () => {
  const loaded = await import("./panels/plots.js");
  incoming.plots ??= new loaded.Plots(element("plots"), history, sound, seek);
  incoming.plots.changed();
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
  feel: () => element("press-feels").click(),
  seek: (by) => transport.seekBy(by),
  nextProblem: goToProblem,
  loop: () => element("loop").click(),
});

function eachPicture(): void {
  finger.pollGamepad();
  incoming.plots?.update();
  requestAnimationFrame(eachPicture);
}
requestAnimationFrame(eachPicture);

engine?.listen(incoming);

// ---- Without an engine the page mills
if (!hasEngine) {
  element("learn-begin").hidden = element("examples").hidden = false;
  void reopen.followLink().then(async (opened) => {
    if (opened) return;
    const why = element("notice").textContent;
    if (await mill(await orderOf(EXAMPLES[0]!))) film.begin();
    else film.giveUp();
    if (why) say(why);
  });
  addEventListener("hashchange", () => void reopen.followLink());
}

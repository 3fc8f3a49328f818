// SPDX-License-Identifier: MIT
// "Make your own": collects a picture and recordings, learns a material from them, and returns the material file.
import { download, element, wordsOf } from "@tribo/ui/dom";
import type { Answer, Learned, Lesson } from "./learner.js";
import { record } from "./microphone.js";
import { readSound, type Sound } from "./sound.js";

/** Shows a material in the page; `file` is an address that can be loaded at once. */
export interface Show {
  (made: { file: string; name: string }): void;
}

interface Recording {
  name: string;
  sound: Sound;
  speed: HTMLInputElement;
}

const kUsualSpeeds = [50, 100, 200, 400];
const kRecordS = 4;
const kWaitS = 1;

const recordings: Recording[] = [];
let picture: File | undefined;
let worker: Worker | undefined;

function say(text: string, wrong = false): void {
  element("make-said").textContent = text;
  element("make-said").classList.toggle("wrong", wrong);
}

async function takePicture(file: File): Promise<void> {
  if (file.type !== "image/png" && file.type !== "image/jpeg")
    throw new Error(`${file.name}: is neither PNG nor JPEG; convert it to one of them`);
  try {
    (await createImageBitmap(file)).close();
  } catch {
    throw new Error(`${file.name}: is no picture that this browser can show; save it anew`);
  }
  picture = file;
}

/** Returns the number in a file name, for example in paper-120.wav, or the next default. */
function guessedSpeed(name: string): number {
  const number = Number(/(\d+(?:\.\d+)?)(?!.*\d)/.exec(name.replace(/\.\w+$/, ""))?.[1] ?? 0);
  if (number >= 5 && number <= 2000) return number;
  return kUsualSpeeds.find((speed) => recordings.every((r) => Number(r.speed.value) !== speed)) ?? 100;
}

function add(name: string, sound: Sound, speed = guessedSpeed(name)): void {
  const item = document.createElement("li");
  const label = document.createElement("label");
  const input = document.createElement("input");
  const away = document.createElement("button");
  input.type = "number";
  input.min = "1";
  input.max = "10000";
  input.step = "any";
  input.value = String(speed);
  label.append(`${name}, ${(sound.samples.length / sound.rate).toFixed(1)} s at `, input, " mm/s ");
  away.type = "button";
  away.textContent = "Remove";
  away.setAttribute("aria-label", `Remove ${name}`);
  const recording = { name, sound, speed: input };
  away.addEventListener("click", () => {
    recordings.splice(recordings.indexOf(recording), 1);
    item.remove();
  });
  item.append(label, away);
  element("make-list").append(item);
  recordings.push(recording);
}

async function take(files: Iterable<File>): Promise<void> {
  const wrong: string[] = [];
  for (const file of files) {
    try {
      if (file.type.startsWith("image/")) await takePicture(file);
      else {
        say(`reading ${file.name} ...`);
        add(
          file.name,
          await readSound(file).catch((error: unknown) => {
            throw new Error(`${file.name}: ${wordsOf(error)}`);
          }),
        );
      }
    } catch (error) {
      wrong.push(wordsOf(error));
    }
  }
  const have = `${picture === undefined ? "no picture" : picture.name}, ${recordings.length} recording${recordings.length === 1 ? "" : "s"}`;
  say(wrong.length > 0 ? wrong.join("\n") : have, wrong.length > 0);
}

async function fromMicrophone(): Promise<void> {
  const speed = Number(element<HTMLInputElement>("make-speed").value);
  const button = element<HTMLButtonElement>("make-record");
  const pace = element("make-pace");
  if (!(speed > 0)) return say("give the speed at which you are going to rub, in mm/s", true);
  button.disabled = true;
  pace.style.setProperty("--pace", `${100 / speed}s`);
  pace.hidden = false;
  say(`rub to and fro with the mark, as firmly as you would feel a cloth: ${kRecordS} seconds`);
  try {
    const sound = await record(kRecordS, kWaitS);
    add(`microphone ${recordings.length + 1}`, sound, speed);
    say("recorded; rub at another speed, or learn");
  } catch (error) {
    say(`no recording: ${wordsOf(error)}`, true);
  }
  pace.hidden = true;
  button.disabled = false;
}

function learn(lessons: Lesson[]): Promise<Answer> {
  worker ??= new Worker(new URL("./learner.js", import.meta.url), { type: "module" });
  const at = worker;
  return new Promise((done, failed) => {
    at.onmessage = (event: MessageEvent<Answer>) => done(event.data);
    at.onerror = (event) => {
      worker = undefined;
      failed(new Error(event.message || "learner.js did not load"));
    };
    at.postMessage(lessons);
  });
}

/** A material file as written by `tribo learn`. */
function material(name: string, image: string, width: number, k: number, nu: number, learned: Learned): object {
  const { schema, method, highpass_hz, level_law, voices } = learned;
  return {
    schema,
    name,
    stiffness_n_per_mm: k,
    viscosity_n_s_per_mm: nu,
    width_mm: width,
    image,
    method,
    highpass_hz,
    level_law,
    voices,
  };
}

const fileOf = (content: object) => new Blob([JSON.stringify(content, null, 2), "\n"], { type: "application/json" });

async function make(show: Show, present: () => { stiffness: number; damping: number }): Promise<void> {
  if (picture === undefined) return say("choose a picture first: a PNG or a JPEG, seen from straight above", true);
  if (recordings.length === 0) return say("choose at least one recording, or record one", true);
  const width = Number(element<HTMLInputElement>("make-width").value);
  if (!(width > 0 && width <= 1e4)) return say("give the width of the picture in mm of the surface: 1 to 10000", true);
  const submit = element<HTMLFormElement>("make").querySelector<HTMLButtonElement>("[type=submit]")!;
  submit.disabled = true;
  say("learning ...");
  try {
    const image = picture;
    const begin = performance.now();
    const said = await learn(
      recordings.map(({ name, sound, speed }) => ({ name, sound, speed: Number(speed.value), force: 1 })),
    );
    if ("wrong" in said) return say(said.wrong, true);
    const name = element<HTMLInputElement>("make-name").value.trim() || image.name.replace(/\.\w+$/, "");
    const { learned, warnings } = said;
    const count = learned.voices.length;
    const here = material(
      name,
      URL.createObjectURL(image),
      width,
      learned.stiffness_n_per_mm,
      learned.viscosity_n_s_per_mm,
      learned,
    );
    show({ file: URL.createObjectURL(fileOf(here)), name });
    say(
      `learned ${count} voice${count === 1 ? "" : "s"} of order ${learned.voices[0]!.reflection.length} in ${((performance.now() - begin) / 1000).toFixed(1)} s; ` +
        `rub the picture below, set K and ν above, then download. Keep the file beside ${image.name}.\n${warnings}`,
    );
    const button = element<HTMLButtonElement>("make-download");
    button.hidden = false;
    button.onclick = () => {
      const { stiffness, damping } = present();
      const digits = (value: number) => Number(value.toPrecision(3));
      download(fileOf(material(name, image.name, width, digits(stiffness), digits(damping), learned)), `${name}.json`);
    };
  } catch (error) {
    say(wordsOf(error), true);
  } finally {
    submit.disabled = false;
  }
}

/** Starts the form. `present` returns the stiffness and viscosity set in the page. */
export function start(show: Show, present: () => { stiffness: number; damping: number }): void {
  const own = element("own");
  const form = element<HTMLFormElement>("make");
  for (const id of ["make-image", "make-sounds"]) {
    const input = element<HTMLInputElement>(id);
    input.addEventListener("change", () => void take([...(input.files ?? [])]));
    // Files that were chosen before this script ran.
    if (input.files?.length) void take([...input.files]);
  }
  own.addEventListener("dragover", (event) => {
    event.preventDefault();
    own.classList.add("dropping");
  });
  own.addEventListener("dragleave", () => own.classList.remove("dropping"));
  own.addEventListener("drop", (event) => {
    event.preventDefault();
    own.classList.remove("dropping");
    void take([...(event.dataTransfer?.files ?? [])]);
  });
  element("make-record").addEventListener("click", () => void fromMicrophone());
  form.noValidate = true;
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    void make(show, present);
  });
}

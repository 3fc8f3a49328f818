// SPDX-License-Identifier: MIT
// The examples that lie beside the page, with their files from the folder examples/.

import { word } from "../texts/texts.js";

export interface Example {
  name: string;
  about: string;
  folder: string;
  job: string;
  files: string[];
}

/** The page opens with the first one. */
export const EXAMPLES: Example[] = [
  {
    name: word("Bowl"),
    about: word("Five axes, a freeform surface, wide passes"),
    folder: "bowl",
    job: "bowl.toml",
    files: ["bowl.toml", "bowl.csv", "bowl.wrl"],
  },
  {
    name: word("Plate"),
    about: word("Three axes: faces, a pocket, arcs, holes"),
    folder: "plate",
    job: "plate.toml",
    files: ["plate.toml", "plate.nc"],
  },
  {
    name: word("Pocket"),
    about: word("Three wrong feeds to find"),
    folder: "pocket",
    job: "pocket.toml",
    files: ["pocket.toml", "pocket.nc"],
  },
  {
    name: word("Dome"),
    about: word("A table that tilts and turns, tool tip control"),
    folder: "dome",
    job: "dome.toml",
    files: ["dome.toml", "dome.nc"],
  },
  {
    name: word("Bracket"),
    about: word("Sub-programs, cycles, three tools"),
    folder: "bracket",
    job: "bracket.toml",
    files: ["bracket.toml", "bracket.nc"],
  },
  {
    name: word("Rose"),
    about: word("Petals engraved along rational splines"),
    folder: "rose",
    job: "rose.toml",
    files: ["rose.toml", "rose.nc"],
  },
  {
    name: word("Blade"),
    about: word("Five axes from APT around a twisted forging"),
    folder: "blade",
    job: "blade.toml",
    files: ["blade.toml", "blade.apt", "blade.wrl", "blank.wrl"],
  },
  {
    name: word("Housing"),
    about: word("Milled from both sides: the second set-up"),
    folder: "housing",
    job: "bottom.toml",
    files: ["bottom.toml", "bottom.nc", "top.toml", "top.nc"],
  },
  {
    name: word("Howl"),
    about: word("A slot that chatters at 8000 rpm"),
    folder: "howl",
    job: "howl.toml",
    files: ["howl.toml", "slot.nc"],
  },
  {
    name: word("Hum"),
    about: word("The same slot, quiet at 9000 rpm"),
    folder: "howl",
    job: "hum.toml",
    files: ["hum.toml", "slot.nc"],
  },
  {
    name: word("Wall"),
    about: word("A thin wall that bends"),
    folder: "howl",
    job: "wall.toml",
    files: ["wall.toml", "wall.nc"],
  },
  {
    name: word("Tapped"),
    about: word("A tool measured with a hammer, three depths"),
    folder: "howl",
    job: "tapped.toml",
    files: ["tapped.toml", "steps.nc", "tap_x.csv", "tap_y.csv"],
  },
];

/** Where the page finds a file of an example. The engine's server has no folders. */
export const besideAs = (file: string) => `example-${file}`;
/** The picture of an example, WIDE by HIGH pixels. */
export const pictureOf = ({ job }: Pick<Example, "job">) => job.replace(/\.toml$/, ".webp");
export const WIDE = 320;
export const HIGH = 200;

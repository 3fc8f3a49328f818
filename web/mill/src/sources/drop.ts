// SPDX-License-Identifier: MIT
// Dropped or chosen files: returns what to mill, or the reason why nothing can be milled.

import { ENDING } from "../keep/moment.js";
import { fixed } from "../texts/figures.js";
import { t } from "../texts/texts.js";
import { isToolLibrary, unpacked } from "./tools.js";
import type { JobFile, Order } from "./workshop.js";

// A page holds its input several times in memory; the program accepts longer files.
export const LARGEST_FILE = 64 << 20;

const MODELS = /\.(wrl|vrml|stl|obj|ply)(\.gz)?$/i;
const PROGRAMS = /\.(ngc|nc|gcode|gc|tap|cnc|mpf|eia|min|h|spf|hnc|apt|cls|cldata|cl|aptsource|nci|xpi|csv|txt)$/i;

export type Wanted = { order: Order } | { recording: JobFile } | { moment: JobFile } | { refused: string };

function megabytes(bytes: number): string {
  return `${fixed(bytes / 1e6, 0)} MB`;
}

const namesOf = (files: JobFile[]) => files.map(({ name }) => name).join(", ");

function lastName(path: string): string {
  return path.slice(path.lastIndexOf("/") + 1);
}

// With several jobs, returns those whose stock no other job begins with (`[stock] from`): the last of a chain of
// set-ups.
function lastJobs(jobs: JobFile[]): JobFile[] {
  const earlier = new Set<string>();
  for (const job of jobs) {
    const text = new TextDecoder().decode(job.bytes);
    for (const [, , name = ""] of text.matchAll(/\bfrom\s*=\s*(["'])(.*?)\1/g)) earlier.add(lastName(name));
  }
  return jobs.filter((job) => !earlier.has(lastName(job.name)));
}

// A library that comes alone: the program that is milled now takes its tools from it.
function withLibrary(library: JobFile, before: Order | undefined): Wanted {
  if (!before) return { refused: t("a tool library alone says no path: drop it together with a program") };
  if (/\.toml$/i.test(before.job)) {
    return {
      refused: t("a job says its tools itself: write tools = '{name}' under [path], and drop both", {
        name: library.name,
      }),
    };
  }
  return { order: { ...before, files: [...before.files.filter((file) => !isToolLibrary(file)), library] } };
}

// The files of one drop or choice, with folders in their names ("bowl/bowl.toml").
export function sort(files: JobFile[], before: Order | undefined): Wanted {
  const [first] = files;
  if (!first) return { refused: t("there was no file in it") };
  const recording = files.find((f) => f.name.endsWith(".tribo"));
  if (recording) return { recording };
  const moment = files.find((f) => f.name.endsWith(ENDING));
  if (moment) return { moment };
  const tables = files.filter((f) => f.name.endsWith(".toml"));
  const jobs = tables.length > 1 ? lastJobs(tables) : tables;
  const libraries = files.filter(isToolLibrary);
  const programs = files.filter((f) => PROGRAMS.test(f.name) && !libraries.includes(f));
  const models = files.filter((f) => MODELS.test(f.name));
  if (jobs.length === 0 && tables.length > 0) {
    return {
      refused: t("each of the {count} jobs begins with the stock of another; let the first begin with box_mm or mesh", {
        count: tables.length,
      }),
    };
  }
  if (jobs.length > 1) {
    return {
      refused: t("there are {count} jobs ({names}); drop one, with the files that it names", {
        count: jobs.length,
        names: namesOf(jobs),
      }),
    };
  }
  const cell = 0;
  const [job] = jobs;
  const [program] = programs;
  const [model] = models;
  const [library] = libraries;
  if (libraries.length > 1 && !job) {
    return {
      refused: t("there are {count} tool libraries ({names}); drop one", {
        count: libraries.length,
        names: namesOf(libraries),
      }),
    };
  }
  if (job) return { order: { files, job: job.name, part: "", cell } };
  if (programs.length > 1) {
    return {
      refused: t("there are {count} programs ({names}); drop one, or a job that names it", {
        count: programs.length,
        names: namesOf(programs),
      }),
    };
  }
  if (program) return { order: { files, job: program.name, part: model?.name ?? "", cell } };
  const rest = files.filter((f) => !libraries.includes(f));
  if (library && rest.length === 0) return withLibrary(library, before);
  if (model && models.length === 1 && before) {
    return { order: { ...before, files: [...before.files, model], part: model.name } };
  }
  if (model) return { refused: t("a model alone says no path: drop it together with a program") };
  // Unknown extension: the module examines the contents.
  return { order: { files, job: (rest[0] ?? first).name, part: "", cell } };
}

/** Why a file cannot be dropped, or nothing. `besideEngine`: the page is that of a running engine. */
export function tooLarge(files: { name: string; size: number }[], besideEngine: boolean): string {
  const large = files.find((f) => f.size > LARGEST_FILE);
  if (!large) return "";
  const facts = { name: large.name, size: megabytes(large.size), most: megabytes(LARGEST_FILE) };
  return besideEngine
    ? t(
        "{name}: {size} are more than a page can hold ({most}); start the engine anew with this file: tribo live {name}",
        facts,
      )
    : t(
        "{name}: {size} are more than a page can hold ({most}); try: tribo render, or tribo live, which take it",
        facts,
      );
}

export async function read(files: { name: string; file: File }[]): Promise<JobFile[]> {
  return Promise.all(files.map(async ({ name, file }) => unpacked({ name, bytes: await file.arrayBuffer() })));
}

// Returns the files of a drop, including those in folders.
export async function dropped(data: DataTransfer): Promise<{ name: string; file: File }[]> {
  const entries = [...data.items].flatMap((item) => item.webkitGetAsEntry?.() ?? []);
  if (entries.length === 0) return [...data.files].map((file) => ({ name: file.name, file }));
  const all: { name: string; file: File }[] = [];
  const walk = async (entry: FileSystemEntry): Promise<void> => {
    if (entry.isFile) {
      const file = await new Promise<File>((resolve, reject) => (entry as FileSystemFileEntry).file(resolve, reject));
      all.push({ name: entry.fullPath.replace(/^\//, ""), file });
      return;
    }
    const reader = (entry as FileSystemDirectoryEntry).createReader();
    for (;;) {
      const some = await new Promise<FileSystemEntry[]>((resolve, reject) => reader.readEntries(resolve, reject));
      if (some.length === 0) return;
      for (const inner of some) await walk(inner);
    }
  };
  for (const entry of entries) await walk(entry);
  return all;
}

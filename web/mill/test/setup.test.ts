// SPDX-License-Identifier: MIT
// Values in the text of a job are read and changed where they stand, and nothing else is.
import { describe, expect, it } from "vitest";

import { entriesOf, quoted, unquoted, withKey, withoutLine, withValue } from "../src/setup/job_text.js";
import { withJob } from "../src/setup/with_job.js";

const JOB = `# A job
[stock]   # of it
box_mm = [[0, 0, -6], [30, 16, 0]]  # mm
[[cutter]]
number = 1
diameter_mm = 6.35# "half" [an] inch
pitch_deg = [
  80, # first
  100,
]
flutes=2
[[cutter]]
diameter_mm = 3

[material]
name = "a # no comment \\" in it"   # but this is
[path]
gcode = 'p[1].nc'
`;

describe("an order with another job", () => {
  const from = (job: string) => ({ files: [{ name: job, bytes: new ArrayBuffer(3) }], job, part: "", cell: 0 });
  it("keeps the program beside the job that stands for it, and a job in its place", () => {
    const program = withJob(from("folder/p 1.nc"), "x = 1");
    expect(program.job).toBe("p 1.toml");
    expect(program.files.map(({ name }) => name)).toEqual(["folder/p 1.nc", "p 1.toml"]);
    expect(new TextDecoder().decode(program.files[1]!.bytes)).toBe("x = 1");
    const job = withJob(withJob(from("a/job.TOML"), "y = 2"), "z = 3");
    expect(job.files.map(({ name, bytes }) => [name, bytes.byteLength])).toEqual([["a/job.TOML", 5]]);
  });
});

describe("the text of a job", () => {
  it("has the values that stand in one line, with their tables", () => {
    expect(entriesOf(JOB).map(({ table, nth, key, raw }) => [table, nth, key, raw])).toEqual([
      ["stock", 0, "box_mm", "[[0, 0, -6], [30, 16, 0]]"],
      ["cutter", 0, "number", "1"],
      ["cutter", 0, "diameter_mm", "6.35"],
      ["cutter", 0, "flutes", "2"],
      ["cutter", 1, "diameter_mm", "3"],
      ["material", 0, "name", '"a # no comment \\" in it"'],
      ["path", 0, "gcode", "'p[1].nc'"],
    ]);
    expect(entriesOf(JOB.replaceAll("\n", "\r\n")).map(({ raw }) => raw)).toEqual(entriesOf(JOB).map(({ raw }) => raw));
  });
  it("changes a value alone: each one for itself, and back", () => {
    for (const entry of entriesOf(JOB)) {
      const other = withValue(JOB, entry.line, "42");
      expect(entriesOf(other).map(({ raw }) => raw)).toEqual(
        entriesOf(JOB).map(({ raw, line }) => (line === entry.line ? "42" : raw)),
      );
      expect(withValue(other, entry.line, entry.raw)).toBe(JOB);
    }
  });
  it("takes a key that it has not yet, in its table or a new one", () => {
    const milled = withKey(JOB, "path", "machine", quoted("xyzac-trt"));
    expect(milled).toBe(JOB.replace("[path]\n", '[path]\nmachine = "xyzac-trt"\n'));
    expect(withKey(milled, "path", "machine", quoted("head-head"))).toBe(milled.replace("xyzac-trt", "head-head"));
    const { line } = entriesOf(milled).find(({ key }) => key === "machine")!;
    expect(withoutLine(milled, line)).toBe(JOB);
    expect(entriesOf(withKey(JOB, "process", "spindle_rpm", "9000")).at(-1)).toMatchObject({
      table: "process",
      raw: "9000",
    });
  });
  it("has strings in both kinds of quotes", () => {
    expect(["'a\"b'", '"a\\u00e9\\n"', "3", "[1]"].map(unquoted)).toEqual(['a"b', "a\u00e9\n", undefined, undefined]);
  });
});

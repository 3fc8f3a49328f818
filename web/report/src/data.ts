// SPDX-License-Identifier: MIT
// The data that the program writes into the page (src/report/report_html.cpp): JSON, and the bytes of the part.

import { element } from "@tribo/ui/dom";

export type Triple = [number, number, number];

/** Each list has one number per piece of the cut. Units: mm, N, s, degrees, rpm, mm/min. */
export interface Rows {
  t: number[];
  dt: number[];
  line: number[];
  x: number[];
  y: number[];
  z: number[];
  mean: number[];
  peak: number[];
  /** The largest force as it may be in truth. */
  low: number[];
  high: number[];
  entry: number[];
  exit: number[];
  depth: number[];
  rpm: number[];
  feed: number[];
  /** Of a job with modes: growth of a vibration (0: unknown) and largest displacement. */
  mu?: number[];
  move?: number[];
}

/** The vibration of the cut that chatters most, from rest, along the feed and across it, mm. */
export interface Vibration {
  label: string;
  rate: number;
  x: number[];
  y: number[];
}

/** The turn with the largest force, and its spectrum. */
export interface Turn {
  t: number;
  rpm: number;
  line: number;
  x: number[];
  y: number[];
  z: number[];
  hz: number[];
  amplitude: number[];
}

/** Smallest and largest sound pressure in equal steps over the whole sound; `heard`: start of the played part, s. */
export interface Envelope {
  seconds: number;
  heard: number;
  low: number[];
  high: number[];
}

export interface Wave {
  label: string;
  rate: number;
  samples: number[];
}

/** Layout of the bytes of the part. */
export interface Part {
  vertices: number;
  triangles: number;
  origin: Triple;
  step: number;
  deviation_step?: number;
  deviation_range?: number;
}

interface ReportData {
  schema: "tribo.report/1";
  rows: Rows;
  turn?: Turn;
  vibration?: Vibration;
  envelope?: Envelope;
  waves?: Wave[];
  part?: Part;
}

export const data = JSON.parse(element("data").textContent ?? "") as ReportData;
export const { rows } = data;
export const count = rows.t.length;

// SPDX-License-Identifier: MIT
// Frames put together byte by byte as docs/live-protocol.md has them.
import { describe, expect, it } from "vitest";

import { decodeFrame } from "../src/frames.js";

class Bytes {
  private readonly view = new DataView(new ArrayBuffer(4096));
  private at = 0;
  header(kind: number, time: number, version = 1): this {
    this.view.setUint8(0, kind);
    this.view.setUint8(1, version);
    this.view.setFloat64(8, time, true);
    this.at = 16;
    return this;
  }
  f32(...values: number[]): this {
    for (const v of values) this.view.setFloat32((this.at += 4) - 4, v, true);
    return this;
  }
  f64(v: number): this {
    this.view.setFloat64((this.at += 8) - 8, v, true);
    return this;
  }
  u32(...values: number[]): this {
    for (const v of values) this.view.setUint32((this.at += 4) - 4, v, true);
    return this;
  }
  u16(...values: number[]): this {
    for (const v of values) this.view.setUint16((this.at += 2) - 2, v, true);
    return this;
  }
  u8(...values: number[]): this {
    for (const v of values) this.view.setUint8(this.at++, v);
    return this;
  }
  pad(): this {
    this.at = 4 * Math.ceil(this.at / 4);
    return this;
  }
  done(): ArrayBuffer {
    return this.view.buffer.slice(0, this.at);
  }
}

describe("decodeFrame", () => {
  it("reads a job", () => {
    const bytes = new Bytes()
      .header(1, 0)
      .f64(12.5)
      .f32(0.25, 0, 0, -10, 40, 30, 0)
      .u32(1)
      .u32(7, 4)
      .f32(6, 1, 40)
      .u32(1)
      .f32(10, 30);
    const job = decodeFrame(bytes.done());
    expect(job).toMatchObject({
      kind: "job",
      duration: 12.5,
      cell: 0.25,
      blank: { min: [0, 0, -10], max: [40, 30, 0] },
      cutters: [{ number: 7, flutes: 4, radius: 6, corner: 1, length: 40, holder: [{ radius: 10, length: 30 }] }],
      chipLimits: undefined,
    });
    expect(decodeFrame(bytes.f32(0.25, 0.5).done())).toMatchObject({
      chipLimits: { rubbing: 0.25, overloadShare: 0.5 },
    });
  });

  it("reads a path", () => {
    const bytes = new Bytes().header(12, 0).u32(2).f32(0, 1, 2, 3).u32(1).f32(0.5, 4, 5, 6).u32(0);
    const path = decodeFrame(bytes.done());
    if (path.kind !== "path") throw new Error();
    expect([...path.times]).toEqual([0, 0.5]);
    expect([...path.points]).toEqual([1, 2, 3, 4, 5, 6]);
    expect([...path.rapid]).toEqual([1, 0]);
  });

  it("reads a chunk with padding after an odd number of vertices", () => {
    const bytes = new Bytes()
      .header(2, 3)
      .u32(1, 2, 3)
      .u32(3, 1)
      .f32(10, 20, 30, 0.5)
      .u16(0, 0, 0, 2, 0, 0, 0, 4, 65535)
      .pad()
      .u16(0, 1, 2)
      .pad();
    const chunk = decodeFrame(bytes.done());
    if (chunk.kind !== "chunk") throw new Error();
    expect(chunk.chunk).toEqual([1, 2, 3]);
    expect([...chunk.positions]).toEqual([10, 20, 30, 11, 20, 30, 10, 22, 30 + 65535 * 0.5]);
    expect([...chunk.indices]).toEqual([0, 1, 2]);
    expect(chunk.deviations).toHaveLength(0);
    const compared = decodeFrame(bytes.u32(3).f32(0.25, Number.NaN, -0.5).done());
    if (compared.kind !== "chunk") throw new Error();
    expect([...compared.indices]).toEqual([0, 1, 2]);
    expect([...compared.deviations]).toEqual([0.25, Number.NaN, -0.5]);
    expect(compared.onBlank).toBeUndefined();
    expect(decodeFrame(bytes.u32(2).done())).toMatchObject({ onBlank: 2, rough: false });
    expect(decodeFrame(bytes.u32(1).done())).toMatchObject({ onBlank: 2, rough: true });
  });

  it("reads a program in UTF-8 and in Latin-1, and refuses one that is cut off", () => {
    const text = (...bytes: number[]) =>
      new Bytes()
        .header(16, 0)
        .u32(4)
        .u8(...Buffer.from("p.nc"))
        .u32(bytes.length)
        .u8(...bytes);
    expect(decodeFrame(text(0x47, 0xc3, 0xa4).pad().done())).toEqual({ kind: "program", name: "p.nc", text: "Gä" });
    expect(decodeFrame(text(0x47, 0xe4).pad().done())).toEqual({ kind: "program", name: "p.nc", text: "Gä" });
    expect(() => decodeFrame(new Bytes().header(16, 0).u32(4000).done())).toThrow(RangeError);
  });

  it("reads a state", () => {
    const bytes = new Bytes().header(3, 1.25).f32(1, 2, 3, 0, 0, 1, 4, 5, 6);
    bytes.f32(100, 2, 6000, 900, 0.5, 7, 1.5, 10).u32(42, 1, 3);
    expect(decodeFrame(bytes.done())).toEqual({
      kind: "state",
      time: 1.25,
      tip: [1, 2, 3],
      axis: [0, 0, 1],
      force: [4, 5, 6],
      peakForce: 100,
      torque: 2,
      rpm: 6000,
      feed: 900,
      angle: 0.5,
      removed: 7,
      milled: 1.5,
      speed: 10,
      line: 42,
      cutter: 1,
      cutting: true,
      playing: true,
      rapid: false,
    });
  });

  it("reads rows and collisions", () => {
    const bytes = new Bytes().header(4, 2).u32(1).f64(2).f32(0.5, 1, 2, 3, 10, 20, 0.25, 1, 2, 5, 0.125).u32(9);
    const rows = decodeFrame(bytes.done());
    expect(rows).toEqual({
      kind: "rows",
      anew: false,
      rows: [
        {
          time: 2,
          duration: 0.5,
          tip: [1, 2, 3],
          meanForce: 10,
          peakForce: 20,
          torque: 0.25,
          entry: 1,
          exit: 2,
          depth: 5,
          feedPerTooth: 0.125,
          line: 9,
          chip: 0,
          chipVerdict: "",
          multiplier: 0,
          rpm: 0,
          axis: [0, 0, 1],
          cutter: 0,
          peakLow: 0,
          peakHigh: 0,
        },
      ],
    });
    if (rows.kind !== "rows") throw new Error();
    const judged = { ...rows.rows[0], chip: 0.125, chipVerdict: "overload" };
    expect(decodeFrame(bytes.f32(0.125).u32(2).done())).toEqual({ ...rows, rows: [judged] });
    const cut = { ...judged, rpm: 6000, axis: [0, 1, 0], cutter: 3 };
    bytes.f32(0.75, 1.5, 6000, 0, 1, 0).u32(3);
    expect(decodeFrame(bytes.done())).toEqual({ ...rows, rows: [{ ...cut, peakLow: 15, peakHigh: 30 }] });
    // A band of its own, from cases.
    bytes.u32(1).f32(0.5, 2);
    expect(decodeFrame(bytes.done())).toEqual({ ...rows, rows: [{ ...cut, peakLow: 10, peakHigh: 40 }] });
    expect(decodeFrame(new Bytes().header(5, 4).u32(2, 17).f32(1, 2, 3).done())).toEqual({
      kind: "collision",
      time: 4,
      what: "holder in stock",
      line: 17,
      tip: [1, 2, 3],
    });
  });

  it("reads sound, finger, servo, texture and the designed surface", () => {
    const sound = new Bytes().header(6, 2).u32(1).f64(2).f32(0.5, 1, 2, 3, 0.25, 628, 1, 40).u32(2, 2);
    sound.f32(1, 0, 2, 0, 3, 0, 4, 5, 6, 7, 8, 9);
    expect(decodeFrame(sound.done())).toEqual({
      kind: "sound",
      pieces: [
        {
          time: 2,
          duration: 0.5,
          tip: [1, 2, 3],
          angle: 0.25,
          radPerS: 628,
          pace: 1,
          chips: 40,
          orderStep: 2,
          harmonics: new Float32Array([1, 0, 2, 0, 3, 0, 4, 5, 6, 7, 8, 9]),
        },
      ],
    });
    expect(
      decodeFrame(
        new Bytes()
          .header(7, 1)
          .f32(1, 2, 3, 4, 5, 6, 7, 8, 9, 10)
          .u32(1 + 4 + 16)
          .done(),
      ),
    ).toEqual({
      kind: "finger",
      hand: [1, 2, 3],
      proxy: [4, 5, 6],
      force: [7, 8, 9],
      slip: 10,
      contact: true,
      on: false,
      cutMode: true,
      stopped: false,
      present: true,
    });
    const servo = new Bytes().header(8, 1).u32(1000, 2, 4).f32(1000, 3, 1.5, 1, 2, 3, 4, 5, 6, 7, 8);
    expect(decodeFrame(servo.done())).toEqual({
      kind: "servo",
      ticks: 1000,
      late: 2,
      fault: "a force was no number",
      rate: 1000,
      limit: 3,
      largest: 1.5,
      lateness: [1, 2, 3, 4],
      cpu: [5, 6, 7, 8],
    });
    const texture = new Bytes().header(9, 1);
    for (let n = 0; n < 8; ++n) texture.f32(n, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0.5);
    const near = decodeFrame(texture.done());
    if (near.kind !== "texture") throw new Error();
    expect(near.triangles.length).toBe(8);
    expect(near.triangles[3]).toEqual({
      corners: [
        [3, 0, 0],
        [1, 0, 0],
        [0, 1, 0],
      ],
      force: [0, 0, 0.5],
    });
    expect(decodeFrame(new Bytes().header(9, 1).done())).toEqual({ kind: "texture", triangles: [] });
    const designed = new Bytes()
      .header(11, 0)
      .u32(3, 1)
      .f32(0, 0, 0, 0.5)
      .u16(0, 0, 0, 2, 0, 0, 0, 2, 0)
      .pad()
      .u16(0, 1, 2)
      .pad();
    const surface = decodeFrame(designed.done());
    if (surface.kind !== "designed") throw new Error();
    expect([...surface.positions]).toEqual([0, 0, 0, 1, 0, 0, 0, 1, 0]);
  });

  it("refuses what it does not know or what is cut off", () => {
    expect(decodeFrame(new Bytes().header(99, 0).done())).toEqual({ kind: "other" });
    expect(() => decodeFrame(new Bytes().header(3, 0, 2).done())).toThrow("version 2");
    expect(() => decodeFrame(new Bytes().header(3, 0).f32(1, 2).done())).toThrow(RangeError);
    expect(() => decodeFrame(new ArrayBuffer(0))).toThrow(RangeError);
  });
});

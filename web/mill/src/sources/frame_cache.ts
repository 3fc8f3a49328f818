// SPDX-License-Identifier: MIT
// The frames that a new viewer needs. A recording begins with them.

import type { Frame } from "@tribo/protocol/frames";

/** Number of sound frames kept, as in the engine. */
export const KEPT_SOUNDS = 64;

export class FrameCache {
  private job: ArrayBuffer | undefined;
  private chunks = new Map<string, ArrayBuffer>();
  private rows: ArrayBuffer[] = [];
  private others: ArrayBuffer[] = [];
  private sounds: ArrayBuffer[] = [];
  private newest = new Map<string, ArrayBuffer>();

  take(frame: Frame, bytes: ArrayBuffer): void {
    switch (frame.kind) {
      case "job":
        Object.assign(this, new FrameCache());
        this.job = bytes;
        break;
      case "chunk":
        this.chunks.set(frame.chunk.join(), bytes);
        break;
      case "rows":
        if (frame.anew) this.rows = [];
        this.rows.push(bytes);
        break;
      // They are of the rows before them.
      case "multipliers":
        this.rows.push(bytes);
        break;
      case "collision":
      case "designed":
        this.others.push(bytes);
        break;
      case "sound":
        this.sounds.push(bytes);
        if (this.sounds.length > KEPT_SOUNDS) this.sounds.shift();
        break;
      default:
        this.newest.set(frame.kind, bytes);
    }
  }

  *replay(): Generator<ArrayBuffer> {
    if (!this.job) return;
    yield this.job;
    yield* this.others;
    yield* this.chunks.values();
    yield* this.rows;
    yield* this.sounds;
    yield* this.newest.values();
  }
}

// SPDX-License-Identifier: MIT
// States that can be gone back to, and forward again.

export class Undo<State> {
  private past: State[] = [];
  private future: State[] = [];

  constructor(private now: State) {}

  get canUndo(): boolean {
    return this.past.length > 0;
  }
  get canRedo(): boolean {
    return this.future.length > 0;
  }

  /** A new state; what was undone is forgotten. The same state again is none. */
  commit(state: State): void {
    if (state === this.now) return;
    this.past.push(this.now);
    this.future = [];
    this.now = state;
  }
  /** Returns the state then; the same one where there is none before. */
  undo(): State {
    return this.step(this.past, this.future);
  }
  redo(): State {
    return this.step(this.future, this.past);
  }

  private step(from: State[], to: State[]): State {
    if (from.length === 0) return this.now;
    to.push(this.now);
    return (this.now = from.pop()!);
  }
}

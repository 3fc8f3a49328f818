// SPDX-License-Identifier: MIT
// One round of the quiz: each wrong cut once, in an order that nobody knows.

import type { Cut } from "./cuts.js";

/** Every order is as likely as any other (Fisher and Yates). `random` gives numbers from 0 to below 1. */
export function shuffled<Item>(items: readonly Item[], random: () => number): Item[] {
  const all = [...items];
  for (let n = all.length - 1; n > 0; --n) {
    const k = Math.floor(random() * (n + 1));
    [all[n], all[k]] = [all[k]!, all[n]!];
  }
  return all;
}

export class Round {
  readonly cuts: readonly Cut[];
  /** One for each cut that was asked: the id of what was said. */
  readonly answers: string[] = [];
  private at = 0;

  constructor(cuts: readonly Cut[], random: () => number = Math.random) {
    this.cuts = shuffled(cuts, random);
  }

  /** Undefined: the round is over. */
  get cut(): Cut | undefined {
    return this.cuts[this.at];
  }
  /** From 1. */
  get number(): number {
    return this.at + 1;
  }
  get answered(): boolean {
    return this.answers.length > this.at;
  }
  get score(): number {
    return this.answers.filter((id, n) => id === this.cuts[n]!.id).length;
  }

  /** Returns whether it is right. The first answer counts. */
  answer(id: string): boolean {
    if (this.cut && !this.answered) this.answers.push(id);
    return this.answers[this.at] === this.cut?.id;
  }
  next(): void {
    if (this.answered) ++this.at;
  }
}

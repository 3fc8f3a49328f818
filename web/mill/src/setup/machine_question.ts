// SPDX-License-Identifier: MIT
// The one question of a program that turns axes: which machine it is for.

import { element } from "@tribo/ui/dom";
import { recall, remember } from "../page.js";
import type { Order, SetUp } from "../sources/workshop.js";
import { choice } from "./card.js";
import { quoted, withKey } from "./job_text.js";
import { withJob } from "./with_job.js";

export class MachineQuestion {
  private about: { order: Order; setUp: SetUp } | undefined;
  private machine = "";

  /** `answered` gets the order with its machine. */
  constructor(answered: (order: Order) => void) {
    element("ask-machine").addEventListener("submit", (event) => {
      event.preventDefault();
      if (!this.about) return;
      remember("machine", this.machine);
      const { order, setUp } = this.about;
      answered(withJob(order, withKey(setUp.text, "path", "machine", quoted(this.machine))));
    });
  }

  ask(order: Order, setUp: SetUp): void {
    this.about = { order, setUp };
    const before = recall("machine");
    this.machine = setUp.machines.includes(before) ? before : setUp.machines[0]!;
    const select = choice(setUp.machines, this.machine, (name) => (this.machine = name));
    element("machine-choice").replaceChildren(select);
    element("ask-machine").hidden = false;
  }
  close(): void {
    this.about = undefined;
    element("ask-machine").hidden = true;
  }
}

// SPDX-License-Identifier: MIT
// What the user sets of the feel: force on or off, its stop, its mode, and whether every press on the part feels.

import { element } from "@tribo/ui/dom";
import type { Command, Settings } from "@tribo/protocol/messages";
import { t } from "../texts/texts.js";

export class FeelPanel {
  private readonly on = element("force-on");
  private readonly stop = element("stop");
  private readonly mode = element<HTMLSelectElement>("mode");
  private readonly pressFeels = element("press-feels");
  private stopped = false;

  constructor(send: (command: Command) => void, setAtOnce: (on: boolean) => void) {
    this.pressFeels.addEventListener("click", () => {
      const on = this.pressFeels.getAttribute("aria-pressed") !== "true";
      this.pressFeels.setAttribute("aria-pressed", String(on));
      setAtOnce(on);
    });
    this.on.addEventListener("click", () => {
      send({ op: "force", value: this.on.getAttribute("aria-pressed") !== "true" });
    });
    this.stop.addEventListener("click", () => send({ op: this.stopped ? "release" : "stop" }));
    this.mode.addEventListener("change", () => send({ op: "mode", value: this.mode.value as Settings["mode"] }));
  }

  show({ force, mode, stopped }: Settings): void {
    element("feel").hidden = this.pressFeels.hidden = false;
    this.on.setAttribute("aria-pressed", String(force));
    this.mode.value = mode;
    this.stopped = stopped;
    this.stop.textContent = stopped ? t("Release") : t("Stop");
    this.stop.setAttribute("aria-pressed", String(stopped));
  }
  hide(): void {
    element("feel").hidden = this.pressFeels.hidden = true;
    element("servo").hidden = true;
  }
}

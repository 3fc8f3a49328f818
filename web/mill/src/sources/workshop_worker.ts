// SPDX-License-Identifier: MIT
// The worker of workshop.ts: the module, its clock, and its frames, which are passed on at once.

import { auditOf } from "@tribo/wasm/audit";
import type { MillExports } from "@tribo/wasm/exports";
import { lendText, textAt } from "@tribo/wasm/memory";
import { openMill, putFile, tickMill } from "@tribo/wasm/mill";
import { obey } from "@tribo/wasm/mill_command";
import { compile, instantiate, type Compiled } from "@tribo/wasm/module";
import type { Command, Settings } from "@tribo/protocol/messages";
import { unpacked } from "./unpacked.js";
import type { FromWorker, Order, SetUp, ToWorker } from "./workshop.js";

const TICK_MS = 1000 / 60;
// Largest part of a tick for milling.
const MILLING_MS = 12;
// If a tick takes longer, the next one waits: half the number of pictures needs half the time.
const BUSY_TICK_MS = 30;
const MOST_LOOKS = 4096;
// Least time between two audits, ms, and as a multiple of what the last one took.
const AUDIT_MS = 1000;
const AUDIT_REST = 20;
// How the reader says that rotary words have no machine.
const LACKS_MACHINE = "without a machine";
// If the clock stood still for longer (a sleeping laptop), it advances by this only, s.
const LONGEST_STEP_S = 0.1;

function post(message: FromWorker, transfer: Transferable[] = []): void {
  (self as unknown as { postMessage(m: unknown, t: Transferable[]): void }).postMessage(message, transfer);
}

class Mill {
  private looks = 64;
  private took = 0; // ms, in the last tick
  private before = performance.now();
  private told = ""; // settings sent last
  private changed = false; // since the last audit
  private auditAt = 0; // the next one, ms
  private order: Order | undefined;

  constructor(private readonly x: MillExports) {}

  get version(): string {
    return textAt(this.x, this.x.tribo_version());
  }

  async open(order: Order): Promise<void> {
    const { x } = this;
    x.mill_forget_files();
    for (const file of order.files) {
      putFile(x, file.name, await unpacked(file));
    }
    const opened = openMill(x, order.job, order.part, order.cell);
    const said = textAt(x, x.mill_text());
    this.order = order;
    if (!opened) {
      const lacksMachine = said.includes(LACKS_MACHINE) ? await this.setUp() : undefined;
      return post({ kind: "refused", why: said, lacksMachine });
    }
    const warnings = said.split("\n").filter(Boolean);
    const { materials } = this;
    post({ kind: "opened", job: order.job, version: this.version, warnings, materials });
    this.tellSettings();
    this.before = performance.now();
  }

  private get materials(): string[] {
    return textAt(this.x, this.x.mill_materials()).split("\n");
  }

  // The file of a job, or the job that stands for a program.
  async setUp(): Promise<SetUp | undefined> {
    const { x, order } = this;
    const job = order?.files.find(({ name }) => name === order.job);
    if (!order || !job) return undefined;
    let text: string | undefined;
    if (/\.toml$/i.test(order.job)) text = new TextDecoder().decode(await unpacked(job));
    else if (lendText(x, order.job, (...name) => x.mill_job_text(...name))) text = textAt(x, x.mill_text());
    if (text === undefined) return undefined;
    return { text, machines: textAt(x, x.mill_machines()).split(", "), materials: this.materials };
  }

  obey(command: Command): void {
    const { x } = this;
    if (!obey(x, command)) return post({ kind: "no", why: textAt(x, x.mill_text()) });
    this.tellSettings();
  }

  private tellSettings(): void {
    const settings = textAt(this.x, this.x.mill_settings());
    if (settings === this.told) return;
    this.told = settings;
    post({ kind: "settings", settings: JSON.parse(settings) as Settings });
  }

  tick(): void {
    const now = performance.now();
    if (this.took > MILLING_MS && now - this.before < BUSY_TICK_MS) return;
    const seconds = Math.min((now - this.before) / 1000, LONGEST_STEP_S);
    this.before = now;
    const frames = tickMill(this.x, seconds, this.looks);
    const took = (this.took = performance.now() - now);
    if (took > MILLING_MS) this.looks = Math.max(1, Math.floor(this.looks * Math.max(0.5, MILLING_MS / took)));
    else this.looks = Math.min(MOST_LOOKS, Math.ceil(1.25 * this.looks));
    if (frames.length > 0) post({ kind: "frames", frames }, frames);
    this.changed ||= frames.length > 0;
    if (this.changed && performance.now() >= this.auditAt) this.audit();
  }

  private audit(): void {
    const began = performance.now();
    const { audit, lines } = auditOf(this.x);
    post({ kind: "audit", audit, lines }, [lines.buffer]);
    this.changed = false;
    const now = performance.now();
    this.auditAt = now + Math.max(AUDIT_MS, AUDIT_REST * (now - began));
  }
}

let compiled: Promise<Compiled<MillExports>> | undefined;
let mill: Mill | undefined;

async function fresh(): Promise<Mill> {
  compiled ??= compile<MillExports>("tribo.wasm", self.location.href);
  return new Mill(await instantiate(await compiled));
}

// After a trap (usually out of memory) the module cannot be used any more.
function broken(error: unknown): void {
  mill = undefined;
  post({
    kind: "failed",
    why:
      error instanceof WebAssembly.RuntimeError || error instanceof RangeError
        ? "the part needs more memory than this page has; try the program, or a coarser grid"
        : `the page's own mill failed: ${String(error)}`,
  });
}

self.onmessage = async ({ data }: MessageEvent<ToWorker>) => {
  try {
    if (data.kind === "open") {
      // Start a new one: memory never shrinks.
      const next = await fresh();
      mill = undefined;
      await next.open(data.order);
      mill = next;
    } else if (data.kind === "set-up") {
      post({ kind: "set-up", setUp: await mill?.setUp() });
    } else {
      mill?.obey(data.command);
    }
  } catch (error) {
    broken(error);
  }
};

setInterval(() => {
  try {
    mill?.tick();
  } catch (error) {
    broken(error);
  }
}, TICK_MS);

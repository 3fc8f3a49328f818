// SPDX-License-Identifier: MIT
// The page of the mill without an engine, from static files, in headless Chromium.
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Browser, Page } from "playwright-core";

import { SITE } from "../tools/places.js";
import { type file, hasBrowser, launch, PATIENCE_MS } from "./browser.js";
import { jobText } from "./job.js";
import { serveFolder, type Server } from "./server.js";

const PICTURES = process.env.TRIBO_PICTURES;

export const hasMillPage = hasBrowser && existsSync(join(SITE, "mill/index.html"));

export const JOB = jobText("[[0, 0, -6], [30, 16, 0]]");
/** A slot, then a rapid through what is left beside it. */
export const PROGRAM = "G21 G90\nG0 X-5 Y5 Z5\nG1 Z-2\nG1 X35\nG0 Z5\nG0 Y9 X-5\nG1 Z-2\nG1 X35\nG0 Y14 X20\n";

/** Presses at a place of the page and rests, until the part is felt. */
export async function feelAt(page: Page, x: number, y: number): Promise<void> {
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.waitForSelector("#scene.touching", { timeout: PATIENCE_MS });
}

export class MillPage {
  /** Faults of scripts, and what the content security policy refused. */
  readonly problems: string[] = [];
  /** Addresses of other sites that were asked. */
  readonly foreign: string[] = [];
  readonly loaded: { url: string; bytes: number }[] = [];
  /** For downloads; gone after close(). */
  readonly folder = mkdtempSync(join(tmpdir(), "tribo-page-"));

  private constructor(
    readonly server: Server,
    readonly browser: Browser,
    readonly page: Page,
  ) {}

  /**
   * With the first example, ready to be milled; `lang`: in another language than English; `look`: with another light
   * than the plain one, unless pictures are made. Drawn in software, the fine light takes most of the processor.
   */
  static async open({ lang = "en", look = PICTURES ? "auto" : "plain" } = {}): Promise<MillPage> {
    const server = await serveFolder(SITE);
    const browser = await launch();
    const page = await browser.newPage({ viewport: { width: 1000, height: 700 } });
    const opened = new MillPage(server, browser, page);
    opened.watch(page);
    page.on("response", async (response) => {
      const length = Number((await response.allHeaders())["content-length"] ?? 0);
      opened.loaded.push({
        url: response.url(),
        bytes:
          length ||
          (
            await response
              .request()
              .sizes()
              .catch(() => ({ responseBodySize: 0 }))
          ).responseBodySize,
      });
    });
    // Not the first visit, which begins with the film.
    await page.addInitScript((light) => {
      localStorage.setItem("tribo.film", "seen");
      localStorage.setItem("tribo.look", light);
    }, look);
    // What goes to the loudspeaker also goes to a meter.
    await page.addInitScript(() => {
      const nodes = AudioNode.prototype as unknown as { connect(this: AudioNode, to: AudioNode): AudioNode };
      const { connect } = nodes;
      nodes.connect = function (to) {
        if (to === this.context.destination) {
          const meter = new AnalyserNode(this.context, { fftSize: 16384, smoothingTimeConstant: 0 });
          (window as unknown as { meter: AnalyserNode }).meter = meter;
          connect.call(this, meter);
        }
        return connect.call(this, to);
      };
    });
    await page.goto(`${server.root}/mill/${lang === "en" ? "" : `?lang=${lang}`}`);
    await page.waitForSelector("#begin:not([hidden])", { timeout: PATIENCE_MS });
    return opened;
  }

  async close(): Promise<void> {
    await this.browser.close();
    await this.server.close();
    rmSync(this.folder, { recursive: true, force: true });
  }

  watch(on: Page): void {
    on.on("pageerror", (error) => this.problems.push(error.message));
    on.on("console", (said) => {
      if (said.text().includes("Content Security Policy")) this.problems.push(said.text());
    });
    on.on("request", (request) => {
      const asked = new URL(request.url());
      if (!["data:", "blob:"].includes(asked.protocol) && asked.host !== new URL(this.server.root).host)
        this.foreign.push(request.url());
    });
  }

  readonly text = async (id: string): Promise<string> => (await this.page.textContent(`#${id}`)) ?? "";
  /** Waits for a text in an element. */
  readonly until = async (want: string, id: string): Promise<void> => {
    await this.page.waitForFunction(
      ([w, where]) => document.getElementById(where)?.textContent?.includes(w),
      [want, id] as const,
      { timeout: PATIENCE_MS },
    );
  };
  /** Waits for a removed volume, cm3. */
  readonly removed = async (least: number): Promise<void> => {
    await this.page.waitForFunction(
      (n) => parseFloat(document.getElementById("removed")?.textContent ?? "0") >= n,
      least,
      { timeout: PATIENCE_MS },
    );
  };
  /** Into the folder TRIBO_PICTURES, if there is one. */
  readonly picture = async (name: string): Promise<void> => {
    if (PICTURES) await this.page.screenshot({ path: join(PICTURES, `${name}.png`) });
  };
  /** The job on the page may have run to its end: it begins anew. */
  readonly choose = async (...files: ReturnType<typeof file>[]): Promise<void> => {
    await this.page.setInputFiles("#files", files);
  };
  /** Chooses a job that the engine takes, and waits until it stands at its start: what the page said of another one is gone. */
  readonly load = async (...files: ReturnType<typeof file>[]): Promise<void> => {
    await this.page.evaluate(() => {
      for (const id of ["job", "clock"]) document.getElementById(id)!.textContent = "";
    });
    await this.choose(...files);
    await this.page.waitForFunction(
      () =>
        document.getElementById("job")!.textContent &&
        document.getElementById("clock")!.textContent.startsWith("0:00 /"),
      null,
      { timeout: PATIENCE_MS },
    );
  };
}

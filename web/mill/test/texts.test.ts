// SPDX-License-Identifier: MIT
// The texts of the page: the same ones in both languages, and none outside of the table.
import type { Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";

import { violations } from "../../testing/axe.js";
import { file, PATIENCE_MS } from "../../testing/browser.js";
import { hasMillPage, JOB, MillPage, PROGRAM } from "../../testing/mill_page.js";
import { textsOfMillPage } from "../../testing/texts.js";
import { TABLE } from "../src/texts/de.js";
import {
  chooseUnit,
  distance,
  feed,
  fixed,
  fromField,
  length,
  lengthWords,
  toField,
  volume,
} from "../src/texts/figures.js";
import { languageOf, t } from "../src/texts/texts.js";

describe("the table of texts", () => {
  const english = textsOfMillPage();
  it("has each text of the page in German, and no other", () => {
    expect(english.size).toBeGreaterThan(300);
    expect([...english].filter((text) => !(text in TABLE))).toEqual([]);
    expect(Object.keys(TABLE).filter((text) => !english.has(text))).toEqual([]);
  });
  it("fills the same values into both", () => {
    const values = (text: string) => [...text.matchAll(/\{\w+\}/g)].map(([value]) => value).sort();
    for (const [text, german] of Object.entries(TABLE)) expect(values(german), text).toEqual(values(text));
  });
  it("puts values where they belong, and leaves what it does not know", () => {
    expect(t("line {line}: {what}", { line: 7, what: "a {line} in it" })).toBe("line 7: a {line} in it");
    expect(t("{nothing} here")).toBe("{nothing} here");
  });
  it("is that of the address, else of the last choice, else of the browser", () => {
    expect(languageOf("?lang=de", "en", ["fr"])).toBe("de");
    expect(languageOf("?lang=xx&token=1", "de", ["en"])).toBe("de");
    expect(languageOf("", "", ["fr-FR", "de-AT", "en"])).toBe("de");
    expect(languageOf("", "", ["fr"])).toBe("en");
    expect(languageOf("?lang=constructor", "", [])).toBe("en");
  });
});

describe("a length", () => {
  it("is in inches what it is in millimetres, with one more decimal", () => {
    chooseUnit("in");
    // 25.4 mm by definition (ISO 31-1).
    expect([length(25.4, 2), lengthWords(0.0508, 3), feed(1524)]).toEqual(["1.00", "0.0020 in", "60.0"]);
    // 1 in3 is 16.387064 cm3.
    expect(volume(16387.064)).toBe("1.00");
    chooseUnit("mm");
    expect([length(25.4, 2), lengthWords(0.0508, 3), feed(1524), volume(16387.064)]).toEqual([
      "25.4",
      "0.051 mm",
      "1524",
      "16.4",
    ]);
    expect(distance(1234.567)).toBe("1234.57");
  });
  it("has no more than three digits where it was worked out", () => {
    const said = [229.82, 1234.5, 9.996, 0.278, 0].map((value) => fixed(value, 2));
    expect(said).toEqual(["230", "1230", "10.0", "0.28", "0.00"]);
  });
  it("is the same after it went through a field, in both units", () => {
    for (const unit of ["in", "mm"] as const) {
      chooseUnit(unit);
      for (let mm = 0.001; mm < 1e4; mm *= 1.37)
        expect(Math.abs(fromField(Number(toField(mm))) / mm - 1)).toBeLessThan(6e-6);
      for (const mm of [6, 12.7, 6.35, -25, 0, 0.5]) expect(fromField(Number(toField(mm)))).toBe(mm);
    }
    chooseUnit("mm");
  });
});

/** What stands in the page, in all elements but those of the program and of the engine. */
function saidIn(page: Page): Promise<string[]> {
  return page.evaluate(() => {
    const foreign =
      "#program-lines, #program-name, #job, #warnings, #job-text, #verdict-sentence, #verdict-rest, #verdict-places, #material, #machine-choice, select#language, script, style, kbd, .u-legend";
    const said: string[] = [];
    const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    for (let node = walker.nextNode(); node; node = walker.nextNode())
      if (!node.parentElement!.closest(foreign)) said.push(node.nodeValue!.trim().replace(/\s+/g, " "));
    for (const element of document.querySelectorAll("[title], [aria-label], [placeholder]"))
      for (const name of ["title", "aria-label", "placeholder"]) said.push(element.getAttribute(name) ?? "");
    return [...new Set(said)].filter((text) => /\p{L}{2}/u.test(text));
  });
}

describe.runIf(hasMillPage)("the page in German", () => {
  let mill: MillPage;
  let page: Page;
  beforeAll(async () => {
    mill = await MillPage.open({ lang: "de" });
    ({ page } = mill);
  }, PATIENCE_MS);
  afterAll(() => mill?.close());

  // English function words that no German text has, and the English side of the table where the German one differs.
  const ENGLISH =
    /\b(the|and|of|with|is|are|it|this|that|to|not|from|for|cut|tool|line|speed|feed|stock|part|depth)\b/i;
  const english = new Set(Object.entries(TABLE).flatMap(([text, german]) => (text === german ? [] : [text])));
  // Names of files and programs, and what the module says.
  const FOREIGN = /\S*\.(toml|csv|nc)|tribo live|rapid through stock/g;
  const leftovers = async () =>
    (await saidIn(page)).filter((text) => english.has(text) || ENGLISH.test(text.replace(FOREIGN, "")));

  it("says nothing in English before a cut", async () => {
    expect(await page.getAttribute("html", "lang")).toBe("de");
    expect(await mill.text("begin")).toBe("Fräsen");
    expect(await leftovers()).toEqual([]);
    expect(await violations(page)).toEqual([]);
  });

  it(
    "says nothing in English with all panels open, after a cut with a collision",
    async () => {
      await page.setViewportSize({ width: 1280, height: 800 });
      await mill.load(file("job.toml", JOB), file("p.nc", PROGRAM));
      await page.fill("#time", "1000");
      await page.waitForSelector('#verdict[data-damage="true"]', { timeout: PATIENCE_MS });
      await page.click("#show-panel");
      await page.waitForSelector("#setup-card:not([hidden])", { timeout: PATIENCE_MS });
      await page.click("#show-plots");
      for (const tab of await page.locator("[role=tab]").all()) {
        if (!(await tab.isVisible())) continue;
        await tab.click();
        expect(await leftovers()).toEqual([]);
      }
      await page.click("#show-plots");
      await page.selectOption("#colouring", "chip");
      await mill.until("reibt", "legend-marks");
      expect(await leftovers()).toEqual([]);
      await page.selectOption("#colouring", "plain");
      await mill.picture("german");
      // A decimal comma, and no point.
      expect(await mill.text("depth")).toMatch(/^(0|\d+,\d\d) mm$/);
      expect(await mill.text("removed")).toMatch(/^\d+,\d\d cm³$/);
      expect(await violations(page)).toEqual([]);
    },
    PATIENCE_MS,
  );

  it(
    "says nothing in English in the quiz",
    async () => {
      await page.click("#learn");
      await page.waitForSelector("#quiz[open]");
      await page.waitForSelector("#quiz-answers button:not([disabled])", { timeout: 2 * PATIENCE_MS });
      expect(await leftovers()).toEqual([]);
      await page.locator("#quiz-answers button").first().click();
      await page.waitForSelector("#quiz-heard table");
      expect(await leftovers()).toEqual([]);
      await mill.picture("german-quiz");
      await page.click("#quiz-close");
    },
    3 * PATIENCE_MS,
  );

  it(
    "shows lengths in inches",
    async () => {
      await page.selectOption("#units", "in");
      await expect.poll(() => mill.text("depth"), { timeout: PATIENCE_MS }).toMatch(/^(0|\d+,\d{3}) in$/);
      expect(await mill.text("feed")).toMatch(/^(\d+,\d in\/min|Eilgang)$/);
      const diameter = page.locator("#setup-form label", { hasText: "Durchmesser" }).locator("input");
      // 6 mm
      expect(Number(await diameter.inputValue())).toBeCloseTo(6 / 25.4, 6);
      await diameter.fill("0.25");
      await diameter.blur();
      expect(await page.inputValue("#job-text")).toContain("diameter_mm = 6.35");
      expect(await page.inputValue("#scale")).toBe("0.003937008");
      await mill.picture("german-inch");
      await page.selectOption("#units", "mm");
      expect(await page.inputValue("#scale")).toBe("0.1");
    },
    PATIENCE_MS,
  );

  it(
    "fits on a phone, although its words are longer",
    async () => {
      await page.setViewportSize({ width: 390, height: 844 });
      await page.waitForTimeout(300);
      await mill.picture("german-phone");
      expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(390);
      const box = (await page.locator("#show-panel").boundingBox())!;
      expect(box.x + box.width).toBeLessThanOrEqual(390);
    },
    PATIENCE_MS,
  );

  it(
    "changes its language at the same moment, and remembers it",
    async () => {
      const before = await mill.text("clock");
      await page.selectOption("#language", "en");
      await mill.until("Set-up", "show-panel");
      await mill.until("job.toml", "job");
      await expect.poll(() => mill.text("clock"), { timeout: PATIENCE_MS }).toBe(before);
      expect(new URL(page.url()).search).toBe("");
      expect(await page.getAttribute("html", "lang")).toBe("en");
    },
    PATIENCE_MS,
  );

  it("makes no error", () => expect(mill.problems).toEqual([]));
});

// SPDX-License-Identifier: MIT
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { expect, test } from "vitest";
import { bundleReport, KEPT, SCRIPTS } from "../bundle.js";

test("the scripts that the program embeds are made of these sources: npm run write -w report", async () => {
  const folder = mkdtempSync(join(tmpdir(), "tribo-report-script-"));
  try {
    await bundleReport(folder);
    for (const name of SCRIPTS) {
      const made = readFileSync(join(folder, name), "utf8");
      expect(readFileSync(join(KEPT, name), "utf8") === made, `${name} is as its sources say`).toBe(true);
      // It stands inside a script element and inside a raw string of C++.
      expect(made).not.toMatch(/<\/script|<!--|\)report"/);
    }
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
});

// SPDX-License-Identifier: MIT
// Moments that are opened: from a link, from a file, and after the page has changed its language.

import { wordsOf } from "@tribo/ui/dom";
import { fileBeside } from "../sources/examples.js";
import { chooseLanguage, t } from "../texts/texts.js";
import { fragmentOf, pack, packedIn, unpack, type Moment } from "./moment.js";

export interface Reopening {
  /** What is shown now; undefined: the source here is no mill of the page. */
  now(): Moment | undefined;
  /** What is shown now comes again by itself when the page is loaded. */
  comesAgain(): boolean;
  /** Returns whether it was taken. */
  open(moment: Moment): Promise<boolean>;
  say(text: string): void;
}

export function setFragment(fragment: string): void {
  window.history.replaceState(null, "", location.pathname + location.search + fragment);
}

export class Reopen {
  constructor(private readonly page: Reopening) {}

  /** `what`: its name, for users. Returns whether it was opened. */
  async openPacked(packed: BlobPart, what: string): Promise<boolean> {
    try {
      return await this.page.open(await unpack(packed, fileBeside));
    } catch (error) {
      this.page.say(t("{what} cannot be opened: {why}.", { what, why: wordsOf(error) }));
      return false;
    }
  }

  async followLink(): Promise<boolean> {
    const { hash } = location;
    const packed = packedIn(hash);
    if (packed === undefined || !(await this.openPacked(packed, t("The link")))) return false;
    setFragment(hash);
    return true;
  }

  /** The page is loaded again in another language, at the same moment. */
  async changeLanguage(to: string): Promise<void> {
    chooseLanguage(to);
    const moment = this.page.now();
    const fragment = moment ? fragmentOf(await pack(moment, false)) : this.page.comesAgain() ? "" : undefined;
    if (fragment === undefined) {
      this.page.say(t("The language changes when the page is opened the next time: this job is too long to be kept."));
      return;
    }
    const address = new URL(location.href);
    address.searchParams.delete("lang");
    window.history.replaceState(null, "", address.pathname + address.search + fragment);
    location.reload();
  }
}

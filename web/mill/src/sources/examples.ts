// SPDX-License-Identifier: MIT
// The examples beside the page.

import { besideAs, type Example } from "../gallery/list.js";
import { t } from "../texts/texts.js";
import type { JobFile, Order } from "./workshop.js";

export const addressOf = (file: string): string => new URL(encodeURIComponent(besideAs(file)), document.baseURI).href;

export async function fileBeside(name: string): Promise<JobFile> {
  const answer = await fetch(addressOf(name));
  if (!answer.ok) throw new Error(t("the example {name} is not here ({status})", { name, status: answer.status }));
  return { name, bytes: await answer.arrayBuffer(), beside: true };
}

export async function order(example: Example): Promise<Order> {
  const files = await Promise.all(example.files.map(fileBeside));
  return { files, job: example.job, part: "", cell: 0 };
}

// SPDX-License-Identifier: MIT
// The examples beside a static page.

import { element } from "@tribo/ui/dom";
import { t } from "../texts/texts.js";
import type { JobFile, Order } from "./workshop.js";

export interface Example {
  name: string; // for display
  job: string;
  files: string[]; // beside the page, under examples/
}

async function listed(): Promise<Example[]> {
  const answer = await fetch(new URL("examples/examples.json", document.baseURI));
  return answer.ok ? ((await answer.json()) as Example[]) : [];
}

export async function fileBeside(name: string): Promise<JobFile> {
  const answer = await fetch(new URL(`examples/${encodeURIComponent(name)}`, document.baseURI));
  if (!answer.ok) throw new Error(t("the example {name} is not here ({status})", { name, status: answer.status }));
  return { name, bytes: await answer.arrayBuffer(), beside: true };
}

export async function order(example: Example): Promise<Order> {
  const files = await Promise.all(example.files.map(fileBeside));
  return { files, job: example.job, part: "", cell: 0 };
}

/** Buttons for all examples. Returns the first one, which the page opens with. */
export async function offerExamples(mill: (order: Order) => Promise<unknown>): Promise<Example | undefined> {
  const examples = await listed();
  const box = element("examples");
  for (const example of examples) {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = example.name;
    button.addEventListener("click", async () => mill(await order(example)));
    box.append(button);
  }
  box.hidden = examples.length < 2;
  return examples[0];
}

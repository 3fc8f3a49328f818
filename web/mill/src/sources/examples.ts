// SPDX-License-Identifier: MIT
// The examples beside a static page.

import type { JobFile, Order } from "./workshop.js";

export interface Example {
  name: string; // for display
  job: string;
  files: string[]; // beside the page, under examples/
}

export async function listed(): Promise<Example[]> {
  const answer = await fetch(new URL("examples/examples.json", document.baseURI));
  return answer.ok ? ((await answer.json()) as Example[]) : [];
}

export async function fileBeside(name: string): Promise<JobFile> {
  const answer = await fetch(new URL(`examples/${encodeURIComponent(name)}`, document.baseURI));
  if (!answer.ok) throw new Error(`the example ${name} is not here (${answer.status})`);
  return { name, bytes: await answer.arrayBuffer(), beside: true };
}

export async function order(example: Example): Promise<Order> {
  const files = await Promise.all(example.files.map(fileBeside));
  return { files, job: example.job, part: "", cell: 0 };
}

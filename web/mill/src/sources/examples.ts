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

export async function order(example: Example): Promise<Order> {
  const files = await Promise.all(
    example.files.map(async (name): Promise<JobFile> => {
      const answer = await fetch(new URL(`examples/${name}`, document.baseURI));
      if (!answer.ok) throw new Error(`examples/${name} is not there (${answer.status})`);
      return { name, bytes: await answer.arrayBuffer() };
    }),
  );
  return { files, job: example.job, part: "", cell: 0 };
}

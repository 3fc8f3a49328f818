// SPDX-License-Identifier: MIT
// An order of the mill whose job is another text.

import type { Order } from "../sources/workshop.js";

/** The name of the job file of an order: its own, or that which stands for its program. */
export function jobNameOf({ job }: Pick<Order, "job">): string {
  return /\.toml$/i.test(job) ? job : `${job.replace(/^.*\//, "").replace(/\.\w+$/, "")}.toml`;
}

export function withJob(order: Order, text: string): Order {
  const name = jobNameOf(order);
  const job = { name, bytes: new TextEncoder().encode(text).buffer };
  return { ...order, files: [...order.files.filter((file) => file.name !== name), job], job: name };
}

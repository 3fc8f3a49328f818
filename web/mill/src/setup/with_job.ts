// SPDX-License-Identifier: MIT
// An order of the mill whose job is another text.

import type { Order } from "../sources/workshop.js";

/** The name of the job file of an order: its own, or that which stands for its program. */
export function jobNameOf({ job }: Pick<Order, "job">): string {
  return /\.toml$/i.test(job) ? job : `${job.replace(/^.*\//, "").replace(/\.\w+$/, "")}.toml`;
}

/** `name`: of an earlier job of the chain, whose text it is; else it is that of the order. */
export function withJob(order: Order, text: string, name = jobNameOf(order)): Order {
  const file = { name, bytes: new TextEncoder().encode(text).buffer };
  const files = [...order.files.filter((other) => other.name !== name), file];
  return { ...order, files, job: name === jobNameOf(order) ? name : order.job };
}

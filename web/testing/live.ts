// SPDX-License-Identifier: MIT
// `tribo live` as a child of a test.
import { spawn, type ChildProcess } from "node:child_process";
import { PROGRAM } from "../tools/places.js";

export interface Live {
  engine: ChildProcess;
  /** The address that it says, with its token. */
  url: string;
}

export async function startLive(job: string, ...flags: string[]): Promise<Live> {
  const engine = spawn(PROGRAM, ["live", job, ...flags]);
  let said = "";
  const url = await new Promise<string>((resolve, reject) => {
    const take = (data: Buffer) => {
      said += data.toString();
      const [address] = /https?:\/\/\S+/.exec(said) ?? [];
      if (address !== undefined) resolve(address);
    };
    engine.stdout.on("data", take);
    engine.stderr.on("data", take);
    engine.on("exit", (code) => reject(new Error(`tribo live ended with ${code}: ${said}`)));
  });
  return { engine, url };
}

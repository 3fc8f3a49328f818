// SPDX-License-Identifier: MIT
// The line to the engine: frames in, commands out; found again when it is lost.

import { decodeFrame, type Frame } from "./frames.js";

export const SUBPROTOCOL = "tribo.live.1";

export type Command =
  | { op: "play" | "pause" | "resync" }
  | { op: "speed"; value: number }
  | { op: "seek"; t_s: number };

export interface ServerInfo {
  op: "serverInfo";
  version: string;
  job: string;
  warnings: string[];
}

export interface Listener {
  frame(frame: Frame): void;
  info(info: ServerInfo): void;
  // Whether there is a line; `why` is for people.
  line(open: boolean, why: string): void;
}

const RETRY_MS = [250, 500, 1000, 2000];

export class Connection {
  private socket: WebSocket | undefined;
  private tries = 0;

  constructor(
    private readonly listener: Listener,
    private readonly url = liveUrl(location),
  ) {
    this.open();
  }

  send(command: Command): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(command));
  }

  private open(): void {
    const socket = new WebSocket(this.url, SUBPROTOCOL);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      this.tries = 0;
      this.listener.line(true, "");
    };
    socket.onmessage = ({ data }) => {
      if (data instanceof ArrayBuffer) this.listener.frame(decodeFrame(data));
      else this.take(JSON.parse(data as string));
    };
    socket.onclose = ({ reason }) => {
      this.listener.line(false, reason || "the engine does not answer");
      setTimeout(() => this.open(), RETRY_MS[Math.min(this.tries++, RETRY_MS.length - 1)]);
    };
    this.socket = socket;
  }

  private take(message: { op: string }): void {
    if (message.op === "serverInfo") this.listener.info(message as ServerInfo);
    else if (message.op === "lost") this.send({ op: "resync" });
  }
}

// Beside the page, with the page's token.
export function liveUrl(page: { protocol: string; host: string; search: string }): string {
  const token = new URLSearchParams(page.search).get("token");
  const scheme = page.protocol === "https:" ? "wss:" : "ws:";
  return `${scheme}//${page.host}/live${token ? `?token=${encodeURIComponent(token)}` : ""}`;
}

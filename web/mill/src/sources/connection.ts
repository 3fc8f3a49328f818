// SPDX-License-Identifier: MIT
// The connection to the engine: frames in, commands out. It reconnects after a loss.

import { decodeFrame } from "@tribo/protocol/frames";
import { SUBPROTOCOL, type Command, type EngineMessage } from "@tribo/protocol/messages";
import { t } from "../texts/texts.js";
import type { Listener, Source } from "./source.js";

const RETRY_MS = [250, 500, 1000, 2000];

export class Connection implements Source {
  private socket: WebSocket | undefined;
  private tries = 0;
  private closed = false;
  private resume: string | undefined;
  private listener: Listener | undefined;
  // Messages received before there was a listener.
  private waiting: ((to: Listener) => void)[] = [];

  constructor(private readonly url = liveUrl(location)) {
    this.open();
  }

  listen(listener: Listener): void {
    this.listener = listener;
    for (const tell of this.waiting.splice(0)) tell(listener);
  }

  send(command: Command): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(command));
  }

  close(): void {
    this.closed = true;
    this.socket?.close();
  }

  private open(): void {
    if (this.closed) return;
    const url = new URL(this.url);
    // Valid once, instead of the token of the page.
    if (this.resume) {
      url.searchParams.delete("token");
      url.searchParams.set("resume", this.resume);
    }
    this.resume = undefined;
    const socket = new WebSocket(url, SUBPROTOCOL);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      this.tries = 0;
      this.tell((to) => to.line(true, ""));
    };
    socket.onmessage = ({ data }) => {
      if (data instanceof ArrayBuffer) this.tell((to) => to.frame(decodeFrame(data), data));
      else this.take(JSON.parse(data as string) as EngineMessage);
    };
    socket.onclose = ({ reason }) => {
      if (this.closed) return;
      this.tell((to) => to.line(false, reason || t("the engine does not answer")));
      setTimeout(() => this.open(), RETRY_MS[Math.min(this.tries++, RETRY_MS.length - 1)]);
    };
    this.socket = socket;
  }

  private tell(what: (to: Listener) => void): void {
    if (this.listener) what(this.listener);
    else this.waiting.push(what);
  }

  private take(message: EngineMessage): void {
    if (message.op === "serverInfo") {
      this.resume = message.resume;
      this.tell((to) => to.info(message));
    } else if (message.op === "settings") {
      this.tell((to) => to.settings(message));
    } else if (message.op === "lost") {
      this.send({ op: "resync" });
    } else if (message.op === "files") {
      this.tell((to) => to.files(message));
    } else if (message.op === "refused") {
      this.tell((to) => to.refused([message.why, message.remedy].filter(Boolean).join("; ")));
    }
  }
}

// At the address of the page, with its token.
export function liveUrl(page: { protocol: string; host: string; search: string }): string {
  const token = new URLSearchParams(page.search).get("token");
  const scheme = page.protocol === "https:" ? "wss:" : "ws:";
  return `${scheme}//${page.host}/live${token ? `?token=${encodeURIComponent(token)}` : ""}`;
}

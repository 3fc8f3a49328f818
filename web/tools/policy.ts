// SPDX-License-Identifier: MIT
// The content security policy of the static pages. Their host may send none, so each page brings it along; the
// engine's server sends its own (src/net/server.cpp).

/** Nothing comes from other sites, and text that gets into a page never runs. */
const POLICY = [
  "default-src 'self'",
  // The touch page's recorder comes as a blob. Only a script that already runs can make one.
  "script-src 'self' 'wasm-unsafe-eval' blob:",
  "style-src 'self' 'unsafe-inline'",
  "img-src 'self' data: blob:",
  "media-src 'self' blob:",
  "connect-src 'self' blob:",
  "worker-src 'self' blob:",
  "object-src 'none'",
  "base-uri 'none'",
  "form-action 'none'",
].join("; ");

const CHARSET = '<meta charset="utf-8" />';

/** Returns the page with the policy, before anything that it rules. */
export function withPolicy(html: string): string {
  if (!html.includes(CHARSET)) throw new Error("the page does not say its character set");
  return html.replace(CHARSET, `${CHARSET}\n<meta http-equiv="Content-Security-Policy" content="${POLICY}" />`);
}

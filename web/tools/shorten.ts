// SPDX-License-Identifier: MIT
// Style sheets and shaders lie in the sources with comments and indentation; a page needs neither.

export function shortStyle(text: string): string {
  return text
    .replace(/\/\*[^]*?\*\//g, "")
    .replace(/\s*\n\s*/g, " ")
    .replace(/ *([{};,>]) */g, "$1")
    .replace(/;}/g, "}")
    .replace(/: /g, ":")
    .trim();
}

/** Keeps the lines of the preprocessor. */
export function shortShader(text: string): string {
  return text
    .replace(/\/\/.*/g, "")
    .replace(/\s*\n\s*/g, "\n")
    .replace(/ *([{};,=*+<>?/()-]) */g, "$1")
    .replace(/([{};,])\n/g, "$1");
}

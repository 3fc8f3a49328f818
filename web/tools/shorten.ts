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

/** Names of a shader that nobody else knows become one letter; inputs, outputs and uniforms keep theirs. */
function shortNames(text: string): string {
  const words = (pattern: RegExp) => [...text.matchAll(pattern)].map(([, word = ""]) => word);
  const shared = words(/\b(?:in|out|uniform) \w+ ([\w,]+)/g).flatMap((list) => list.split(","));
  const own = new Set([...words(/\b(?:float|int|vec\d) (\w+)/g), ...words(/[ ,](\w+)=(?!=)/g)]);
  for (const word of ["main", ...shared]) own.delete(word);
  const taken = new Set(words(/\b(\w)\b/g));
  const free = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ".split("").filter((letter) => !taken.has(letter));
  const letters = new Map<string, string>();
  for (const word of own) if (word.length > 1) letters.set(word, free.shift() ?? word);
  return text.replace(/(?<!\.)\b[a-z]\w+/gi, (word) => letters.get(word) ?? word);
}

/** Keeps the lines of the preprocessor. */
export function shortShader(text: string): string {
  return shortNames(
    text
      .replace(/\/\/.*/g, "")
      .replace(/\s*\n\s*/g, "\n")
      .replace(/ *([{};,=*+<>?/()-]) */g, "$1")
      .replace(/([{};,])\n/g, "$1")
      .replace(/\b0(\.\d)|(\d\.)0\b/g, "$1$2")
      .replace(/((?:uniform|const) \w+) ([^;]*;)(?:\1 [^;]*;)+/g, (all, kind: string) =>
        all.replaceAll(`;${kind} `, ","),
      ),
  );
}

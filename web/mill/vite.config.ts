import { copyFileSync, existsSync, mkdirSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { brotliCompressSync, gzipSync } from "node:zlib";
import { defineConfig, type Plugin } from "vite";
import { COMPACT } from "../tools/bundle.js";
import { MILL_PAGE, MODULES, ROOT } from "../tools/places.js";
import { notices } from "./notices.js";
import { besideAs, EXAMPLES, pictureOf } from "./src/gallery/list.js";

// The modules, the examples and the licences beside the page, and of everything that is text or code packed forms for the engine's server.
function modules(): Plugin {
  return {
    name: "tribo-modules",
    closeBundle() {
      mkdirSync(MILL_PAGE, { recursive: true });
      for (const name of ["tribo.wasm", "mill_sound.wasm"]) {
        if (!existsSync(join(MODULES, name))) throw new Error(`${join(MODULES, name)} is not built: make build`);
        copyFileSync(join(MODULES, name), join(MILL_PAGE, name));
      }
      writeFileSync(join(MILL_PAGE, "notices.txt"), notices());
      for (const example of EXAMPLES) {
        for (const name of example.files)
          copyFileSync(join(ROOT, "examples", example.folder, name), join(MILL_PAGE, besideAs(name)));
        // A new example has none until `npm run pictures` makes it.
        const picture = pictureOf(example);
        const from = join(import.meta.dirname, "pictures", picture);
        if (existsSync(from)) copyFileSync(from, join(MILL_PAGE, besideAs(picture)));
      }
      const poster = "poster.webp";
      copyFileSync(join(import.meta.dirname, "pictures", poster), join(MILL_PAGE, poster));
      for (const name of readdirSync(MILL_PAGE)) {
        if (!/\.(html|js|css|wasm|txt)$/.test(name)) continue;
        const bytes = readFileSync(join(MILL_PAGE, name));
        writeFileSync(join(MILL_PAGE, `${name}.gz`), gzipSync(bytes, { level: 9 }));
        writeFileSync(join(MILL_PAGE, `${name}.br`), brotliCompressSync(bytes));
      }
    },
  };
}

// The page's own script comes with its first piece, not after it.
function preload(): Plugin {
  return {
    name: "tribo-preload",
    transformIndexHtml: {
      order: "post",
      handler(_html, { bundle }) {
        const main = Object.values(bundle ?? {}).find(
          (chunk) => chunk.type === "chunk" && chunk.facadeModuleId?.endsWith("/src/main.ts"),
        );
        if (!main) throw new Error("the page's script is not in the bundle");
        return [{ tag: "link", attrs: { rel: "modulepreload", href: `./${main.fileName}` }, injectTo: "head" }];
      },
    },
  };
}

export default defineConfig({
  base: "./",
  plugins: [modules(), preload()],
  worker: { format: "es", rolldownOptions: COMPACT },
  build: {
    target: "es2022",
    outDir: MILL_PAGE,
    emptyOutDir: true,
    assetsDir: ".",
    modulePreload: { polyfill: false },
    chunkSizeWarningLimit: 700,
    rolldownOptions: COMPACT,
  },
});

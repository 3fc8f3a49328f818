import { copyFileSync, existsSync, mkdirSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { brotliCompressSync, gzipSync } from "node:zlib";
import { defineConfig, type Plugin } from "vite";

const ROOT = join(import.meta.dirname, "../..");
const OUT = join(ROOT, "build/web/viewer");
const WASM = process.env.TRIBO_WASM_DIR ?? join(ROOT, "build/wasm");

// The modules beside the page, and of everything that is text or code packed forms for the engine's server.
function modules(): Plugin {
  return {
    name: "tribo-modules",
    closeBundle() {
      mkdirSync(OUT, { recursive: true });
      for (const name of ["tribo.wasm", "mill_sound.wasm"]) {
        if (!existsSync(join(WASM, name))) throw new Error(`${join(WASM, name)} is not built: make build`);
        copyFileSync(join(WASM, name), join(OUT, name));
      }
      for (const name of readdirSync(OUT)) {
        if (!/\.(html|js|css|wasm)$/.test(name)) continue;
        const bytes = readFileSync(join(OUT, name));
        writeFileSync(join(OUT, `${name}.gz`), gzipSync(bytes, { level: 9 }));
        writeFileSync(join(OUT, `${name}.br`), brotliCompressSync(bytes));
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
        const main = Object.values(bundle ?? {}).find((chunk) => chunk.type === "chunk" && chunk.facadeModuleId?.endsWith("/src/main.ts"));
        if (!main) throw new Error("the page's script is not in the bundle");
        return [{ tag: "link", attrs: { rel: "modulepreload", href: `./${main.fileName}` }, injectTo: "head" }];
      },
    },
  };
}

export default defineConfig({
  base: "./",
  plugins: [modules(), preload()],
  worker: { format: "es" },
  build: {
    target: "es2022",
    outDir: OUT,
    emptyOutDir: true,
    assetsDir: ".",
    modulePreload: { polyfill: false },
    chunkSizeWarningLimit: 700,
  },
});

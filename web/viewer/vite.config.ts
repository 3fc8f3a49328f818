import { copyFileSync, existsSync, mkdirSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { gzipSync } from "node:zlib";
import { defineConfig, type Plugin } from "vite";

const ROOT = join(import.meta.dirname, "../..");
const OUT = join(ROOT, "build/web/viewer");
const WASM = process.env.TRIBO_WASM_DIR ?? join(ROOT, "build/wasm");

// The modules beside the page, and of everything that is text or code a packed form for the engine's server.
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
        writeFileSync(join(OUT, `${name}.gz`), gzipSync(readFileSync(join(OUT, name)), { level: 9 }));
      }
    },
  };
}

export default defineConfig({
  base: "./",
  plugins: [modules()],
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

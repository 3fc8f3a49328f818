import { defineConfig } from "vite";

export default defineConfig({
  base: "./",
  build: {
    target: "es2022",
    outDir: "../../build/web/viewer",
    emptyOutDir: true,
    assetsDir: ".",
    modulePreload: { polyfill: false },
    chunkSizeWarningLimit: 700,
  },
});

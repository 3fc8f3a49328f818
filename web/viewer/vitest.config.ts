import { defineConfig } from "vitest/config";

// One browser at a time: two starve each other on a small machine.
export default defineConfig({ test: { fileParallelism: false } });

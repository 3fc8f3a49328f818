// SPDX-License-Identifier: MIT
// Where the builds and the tests find things and put them. The environment may say otherwise.
import { join } from "node:path";

/** The repository. */
export const ROOT = join(import.meta.dirname, "../..");
/** The built modules, *.wasm. */
export const MODULES = process.env.TRIBO_WASM_DIR ?? join(ROOT, "build/wasm");
/** The page of `tribo live`. */
export const MILL_PAGE = join(ROOT, "build/web/viewer");
/** The static site of `tribo site`. */
export const SITE = process.env.TRIBO_SITE_DIR ?? join(ROOT, "build/web/site");
export const PROGRAM = process.env.TRIBO_PROGRAM ?? join(ROOT, "build/release/tribo");
/** The packed component. */
export const COMPONENT = join(import.meta.dirname, "../touch/dist");

// SPDX-License-Identifier: MIT
// npm run write -w report: brings the kept scripts up to date with their sources.
import { bundleReport, KEPT } from "./bundle.js";

await bundleReport(KEPT);

// SPDX-License-Identifier: MIT
// The page of the report: makes plots of the results. The part in 3D has its own script (part_view.ts), which a page
// without a part does not contain.

import { element } from "@tribo/ui/dom";
import { chatterPlot, vibrationPlot } from "./chatter_plots.js";
import { count, data, rows } from "./data.js";
import { forcePlot } from "./force_plot.js";
import { largest } from "./numbers.js";
import { pathPlot } from "./path_plot.js";
import { listenToSlider, select } from "./selection.js";
import { envelopePlot, wavePlots } from "./sound_plots.js";
import { turnPlots } from "./turn_plots.js";

export * from "./shared.js";
export * from "./state.js";

// The date of the file, not in it: a report of the same files has the same bytes.
element("written").textContent = `Written ${new Date(document.lastModified).toLocaleString()}.`;

const remove = (id: string) => element(id).remove();

if (count) {
  listenToSlider();
  forcePlot();
  pathPlot();
  if (rows.mu) chatterPlot(rows.mu);
  select(rows.peak.indexOf(largest(rows.peak)));
} else {
  remove("forces");
  remove("path");
}
if (data.turn) turnPlots(data.turn);
else remove("turn");
if (data.vibration) vibrationPlot(data.vibration);
if (data.envelope) {
  envelopePlot(data.envelope);
  wavePlots(data.waves ?? []);
} else {
  remove("sound");
}

// SPDX-License-Identifier: MIT
// Two sounds over their frequencies: the right one as a surface, the other one as a line.

import { fitToScreen } from "@tribo/ui/canvas";

const LOWEST_HZ = 60;
const HIGHEST_HZ = 12_000;
const TOP_DB = -20;
const BOTTOM_DB = -75;
const MARKS_HZ = [100, 300, 1000, 3000, 10_000];
const FOOT = 16;

/** `powers` as powersOf() gives them. */
export function drawSpectra(canvas: HTMLCanvasElement, right: Float64Array, other: Float64Array, rate: number): void {
  const c = canvas.getContext("2d");
  const { clientWidth: width, clientHeight: height } = canvas;
  if (!c || width === 0) return;
  const ratio = fitToScreen(canvas, 2);
  c.setTransform(ratio, 0, 0, ratio, 0, 0);
  c.clearRect(0, 0, width, height);
  const style = getComputedStyle(canvas);
  const bin = rate / (2 * right.length);
  const octaves = Math.log2(HIGHEST_HZ / LOWEST_HZ);
  const hzAt = (x: number) => LOWEST_HZ * 2 ** ((octaves * x) / width);
  const xAt = (hz: number) => (width * Math.log2(hz / LOWEST_HZ)) / octaves;
  const foot = height - FOOT;
  // The largest bin of a column: no tone is lost.
  const trace = (powers: Float64Array) => {
    c.beginPath();
    for (let x = 0; x < width; ++x) {
      let most = 0;
      const last = Math.max(Math.floor(hzAt(x + 1) / bin), Math.round(hzAt(x) / bin));
      for (let k = Math.round(hzAt(x) / bin); k <= last; ++k) most = Math.max(most, powers[k] ?? 0);
      const share = (10 * Math.log10(most + 1e-12) - BOTTOM_DB) / (TOP_DB - BOTTOM_DB);
      c.lineTo(x, foot * (1 - Math.min(Math.max(share, 0), 1)));
    }
  };
  trace(right);
  c.lineTo(width, foot);
  c.lineTo(0, foot);
  c.fillStyle = style.getPropertyValue("--line");
  c.fill();
  trace(other);
  c.strokeStyle = style.getPropertyValue("--overload");
  c.lineWidth = 1.2;
  c.stroke();
  c.fillStyle = style.getPropertyValue("--quiet");
  c.font = "11px system-ui, sans-serif";
  c.textAlign = "center";
  for (const hz of MARKS_HZ) {
    c.fillRect(xAt(hz), foot, 1, 3);
    c.fillText(hz < 1000 ? `${hz} Hz` : `${hz / 1000} kHz`, Math.min(xAt(hz), width - 20), height - 3);
  }
}

'use strict';
const data = JSON.parse(document.getElementById('data').textContent);
const rows = data.rows;
const count = rows.t.length;

const css = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const clamp = (v, low, high) => Math.min(Math.max(v, low), high);
const largest = list => list.reduce((m, v) => Math.max(m, v), 0);
// Three significant digits, without exponents where a person would not use one.
const short = v => {
  const size = Math.abs(v);
  if (size >= 1e6 || (size > 0 && size < 1e-3)) return v.toExponential(2);
  return String(Number(v.toPrecision(size >= 1000 ? 4 : 3)));
};

// Round steps, so that between four and nine ticks cover the range.
function ticks(low, high, wanted) {
  const raw = (high - low) / wanted;
  if (!(raw > 0)) return [low];
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = power * [1, 2, 5, 10].find(m => m * power >= raw);
  const found = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i) found.push(i * step);
  return found;
}

// A canvas with axes. `paint` draws inside the frame; the picture is kept, so that cursors cost nothing.
class Plot {
  constructor(id, options) {
    Object.assign(this, { margin: [14, 16, 34, 58], xLabel: '', yLabel: '', paint() {}, cursor() {} }, options);
    this.canvas = document.getElementById(id);
    this.context = this.canvas.getContext('2d');
    this.kept = document.createElement('canvas');
    new ResizeObserver(() => this.draw()).observe(this.canvas.parentElement);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.draw());
  }
  get width() { return this.canvas.clientWidth - this.margin[1] - this.margin[3]; }
  get height() { return this.canvas.clientHeight - this.margin[0] - this.margin[2]; }
  x(v) { return this.margin[3] + (v - this.range.x[0]) / (this.range.x[1] - this.range.x[0]) * this.width; }
  y(v) { return this.margin[0] + (1 - (v - this.range.y[0]) / (this.range.y[1] - this.range.y[0])) * this.height; }
  fromX(px) { return this.range.x[0] + (px - this.margin[3]) / this.width * (this.range.x[1] - this.range.x[0]); }

  draw() {
    const ratio = window.devicePixelRatio || 1;
    const w = this.canvas.clientWidth, h = this.canvas.clientHeight;
    if (w < 80 || h < 60) return;
    this.canvas.width = w * ratio;
    this.canvas.height = h * ratio;
    this.range = this.extent(this.width / this.height);
    const c = this.context;
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    c.clearRect(0, 0, w, h);
    this.axes(c);
    c.save();
    c.beginPath();
    c.rect(this.margin[3], this.margin[0], this.width, this.height);
    c.clip();
    this.paint(c);
    c.restore();
    this.kept.width = this.canvas.width;
    this.kept.height = this.canvas.height;
    this.kept.getContext('2d').drawImage(this.canvas, 0, 0);
    this.overlay();
  }
  overlay() {
    const c = this.context;
    if (!this.range) return;
    c.save();
    c.setTransform(1, 0, 0, 1, 0, 0);
    c.clearRect(0, 0, this.kept.width, this.kept.height);
    c.drawImage(this.kept, 0, 0);
    c.restore();
    this.cursor(c);
  }
  axes(c) {
    const [top, , , left] = this.margin, right = left + this.width, bottom = top + this.height;
    c.font = '12px system-ui, sans-serif';
    c.lineWidth = 1;
    c.strokeStyle = css('--grid');
    c.fillStyle = css('--soft');
    c.textAlign = 'center';
    c.textBaseline = 'top';
    for (const v of ticks(...this.range.x, clamp(this.width / 90, 2, 9))) {
      line(c, this.x(v), top, this.x(v), bottom);
      c.fillText(short(v), this.x(v), bottom + 5);
    }
    c.textAlign = 'right';
    c.textBaseline = 'middle';
    for (const v of ticks(...this.range.y, clamp(this.height / 44, 2, 8))) {
      line(c, left, this.y(v), right, this.y(v));
      c.fillText(short(v), left - 7, this.y(v));
    }
    c.textBaseline = 'bottom';
    c.fillText(this.xLabel, right, bottom + 33);
    c.save();
    c.translate(13, top);
    c.rotate(-Math.PI / 2);
    c.textBaseline = 'middle';
    c.fillText(this.yLabel, 0, 0);
    c.restore();
  }
}

function line(c, x0, y0, x1, y1) {
  c.beginPath();
  c.moveTo(x0, y0);
  c.lineTo(x1, y1);
  c.stroke();
}

function curve(c, plot, xs, ys, colour, width = 1.4) {
  c.strokeStyle = colour;
  c.lineWidth = width;
  c.lineJoin = 'round';
  c.beginPath();
  for (let i = 0; i < ys.length; ++i) c.lineTo(plot.x(xs(i)), plot.y(ys[i]));
  c.stroke();
}

function legend(c, plot, entries) {
  c.textAlign = 'left';
  c.textBaseline = 'middle';
  let x = plot.margin[3] + 10;
  for (const [text, colour] of entries) {
    c.fillStyle = colour;
    c.fillRect(x, plot.margin[0] + 9, 14, 3);
    c.fillStyle = css('--soft');
    c.fillText(text, x + 19, plot.margin[0] + 11);
    x += 34 + c.measureText(text).width;
  }
}

// Runs of rows that follow each other without a gap: [first, end) pairs.
const runs = [];
for (let i = 0, first = 0; i < count; ++i) {
  if (i + 1 === count || rows.t[i + 1] > rows.t[i] + 1.5 * rows.dt[i] + 1e-6) {
    runs.push([first, i + 1]);
    first = i + 1;
  }
}

// ---- the row that everything points at
let current = -1;
const slider = document.getElementById('row');
const linked = [];
function point(i) {
  if (i === current || i < 0 || i >= count) return;
  current = i;
  slider.value = i;
  const where = ['x', 'y', 'z'].map(k => short(rows[k][i])).join(', ');
  document.getElementById('readout').innerHTML =
    `line <b>${rows.line[i]}</b> at <b>${short(rows.t[i])} s</b>, tip (${where}) mm: peak <b>${short(rows.peak[i])} N</b>` +
    ` (${short(rows.peak[i] * data.band[0])} to ${short(rows.peak[i] * data.band[1])}), mean <b>${short(rows.mean[i])} N</b>;` +
    ` engaged ${short(rows.entry[i])}° to ${short(rows.exit[i])}°, ${short(rows.depth[i])} mm deep,` +
    ` ${short(rows.rpm[i])} rpm, ${short(rows.feed[i])} mm/min`;
  for (const plot of linked) plot.overlay();
}
function rowAt(t) {
  let low = 0, high = count - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (rows.t[middle] <= t) low = middle; else high = middle - 1;
  }
  return low;
}

// ---- force over time
function forcePlot() {
  const all = [rows.t[0], rows.t[count - 1] + rows.dt[count - 1]];
  let shown = all, drag = null;
  const plot = new Plot('force-plot', {
    xLabel: 'time, s', yLabel: 'force, N',
    extent() {
      let top = 0;
      for (let i = 0; i < count; ++i) if (rows.t[i] >= shown[0] && rows.t[i] <= shown[1]) top = Math.max(top, rows.peak[i]);
      return { x: shown, y: [0, 1.06 * top * data.band[1] || 1] };
    },
    paint(c) {
      for (const [first, end] of runs) {
        c.fillStyle = css('--peak');
        c.globalAlpha = 0.14;
        c.beginPath();
        for (let i = first; i < end; ++i) c.lineTo(plot.x(rows.t[i]), plot.y(rows.peak[i] * data.band[1]));
        for (let i = end; i-- > first;) c.lineTo(plot.x(rows.t[i]), plot.y(rows.peak[i] * data.band[0]));
        c.fill();
        c.globalAlpha = 1;
        const xs = i => rows.t[first + i];
        curve(c, plot, xs, rows.peak.slice(first, end), css('--peak'));
        curve(c, plot, xs, rows.mean.slice(first, end), css('--mean'));
      }
      legend(c, plot, [['largest in a turn', css('--peak')], ['mean over a turn', css('--mean')]]);
    },
    cursor(c) {
      c.strokeStyle = css('--cursor');
      if (current >= 0) line(c, plot.x(rows.t[current]), plot.margin[0], plot.x(rows.t[current]), plot.margin[0] + plot.height);
      if (drag) {
        c.fillStyle = css('--accent');
        c.globalAlpha = 0.18;
        c.fillRect(drag[0], plot.margin[0], drag[1] - drag[0], plot.height);
        c.globalAlpha = 1;
      }
    },
  });
  const canvas = plot.canvas;
  canvas.addEventListener('pointermove', e => {
    if (drag) drag[1] = e.offsetX;
    point(rowAt(plot.fromX(e.offsetX)));
    if (drag) plot.overlay();
  });
  canvas.addEventListener('pointerdown', e => { if (e.pointerType === 'mouse') drag = [e.offsetX, e.offsetX]; });
  window.addEventListener('pointerup', () => {
    if (!drag) return;
    const [a, b] = drag.map(px => clamp(plot.fromX(px), ...all)).sort((p, q) => p - q);
    const wide = Math.abs(drag[1] - drag[0]) > 6;
    drag = null;
    if (wide) { shown = [a, b]; plot.draw(); } else plot.overlay();
  });
  canvas.addEventListener('dblclick', () => { shown = all; plot.draw(); });
  linked.push(plot);
}

// ---- path from above
const scale = [[37, 99, 180], [32, 150, 140], [226, 160, 30], [200, 45, 30]];
function colour(share) {
  const at = clamp(share, 0, 1) * (scale.length - 1), i = Math.min(Math.floor(at), scale.length - 2);
  const mix = scale[i].map((v, k) => Math.round(v + (at - i) * (scale[i + 1][k] - v)));
  return `rgb(${mix})`;
}
function pathPlot() {
  const units = { peak: 'N', mean: 'N', depth: 'mm', feed: 'mm/min' };
  let by = 'peak';
  const box = key => [rows[key].reduce((m, v) => Math.min(m, v), Infinity), rows[key].reduce((m, v) => Math.max(m, v), -Infinity)];
  const bx = box('x'), by0 = box('y');
  const plot = new Plot('path-plot', {
    xLabel: 'x, mm', yLabel: 'y, mm', margin: [14, 92, 34, 58],
    extent(aspect) {  // as many pixels to a millimetre both ways
      const middle = b => 0.5 * (b[0] + b[1]);
      const half = 0.54 * Math.max(by0[1] - by0[0], (bx[1] - bx[0]) / aspect, 1e-3);
      return { x: [middle(bx) - half * aspect, middle(bx) + half * aspect], y: [middle(by0) - half, middle(by0) + half] };
    },
    paint(c) {
      const top = largest(rows[by]) || 1;
      c.lineCap = 'round';
      c.lineWidth = 2;
      for (const [first, end] of runs) {
        for (let i = first; i < end; ++i) {
          const next = i + 1 < end ? i + 1 : i;
          c.strokeStyle = colour(rows[by][i] / top);
          line(c, plot.x(rows.x[i]), plot.y(rows.y[i]), plot.x(rows.x[next]), plot.y(rows.y[next]));
        }
      }
    },
    cursor(c) {
      const left = plot.margin[3] + plot.width + 14, h = Math.min(plot.height, 220), top = plot.margin[0];
      const most = largest(rows[by]) || 1;
      for (let i = 0; i < h; ++i) {
        c.fillStyle = colour(1 - i / h);
        c.fillRect(left, top + i, 12, 1.5);
      }
      c.fillStyle = css('--soft');
      c.textAlign = 'left';
      c.textBaseline = 'middle';
      for (const share of [0, 0.5, 1]) c.fillText(short(share * most), left + 17, top + 6 + (1 - share) * (h - 12));
      c.fillText(units[by], left, top + h + 14);
      if (current < 0) return;
      c.strokeStyle = css('--cursor');
      c.lineWidth = 2;
      c.beginPath();
      c.arc(plot.x(rows.x[current]), plot.y(rows.y[current]), 6, 0, 2 * Math.PI);
      c.stroke();
    },
  });
  plot.canvas.addEventListener('pointermove', e => {
    let best = -1, least = 30 * 30;
    for (let i = 0; i < count; ++i) {
      const d = (plot.x(rows.x[i]) - e.offsetX) ** 2 + (plot.y(rows.y[i]) - e.offsetY) ** 2;
      if (d < least) { least = d; best = i; }
    }
    point(best);
  });
  document.getElementById('colouring').addEventListener('change', e => { by = e.target.value; plot.draw(); });
  linked.push(plot);
}

// ---- one turn
function turnPlots(turn) {
  document.getElementById('turn-hint').textContent =
    `Line ${turn.line} at ${short(turn.t)} s, ${short(turn.rpm)} rpm: one turn takes ${short(60000 / turn.rpm)} ms.`;
  const all = [...turn.x, ...turn.y, ...turn.z];
  const span = [Math.min(0, ...all), Math.max(0, ...all)], room = 0.08 * (span[1] - span[0] || 1);
  const plot = new Plot('turn-plot', {
    xLabel: 'spindle angle, degrees', yLabel: 'force, N',
    extent: () => ({ x: [0, 360], y: [span[0] - room, span[1] + 2 * room] }),
    paint(c) {
      const angle = i => 360 * i / turn.x.length;
      for (const key of ['x', 'y', 'z']) curve(c, plot, angle, turn[key].concat(turn[key][0]), css('--' + key), 1.8);
      legend(c, plot, ['x', 'y', 'z'].map(k => ['F' + k, css('--' + k)]));
    },
  });
  const highest = turn.hz[turn.hz.length - 1] || 1;
  const spectrum = new Plot('spectrum-plot', {
    xLabel: 'frequency, Hz', yLabel: 'amplitude, N',
    extent: () => ({ x: [-0.03 * highest, 1.05 * highest], y: [0, 1.1 * largest(turn.amplitude) || 1] }),
    paint(c) {
      c.strokeStyle = css('--accent');
      c.lineWidth = clamp(0.5 * spectrum.width / turn.hz.length, 1.5, 14);
      turn.hz.forEach((hz, i) => line(c, spectrum.x(hz), spectrum.y(0), spectrum.x(hz), spectrum.y(turn.amplitude[i])));
    },
  });
}

// ---- sound
function envelopePlot(envelope) {
  const audio = document.querySelector('audio');
  const top = Math.max(largest(envelope.high), largest(envelope.low.map(v => -v))) || 1;
  const plot = new Plot('envelope-plot', {
    xLabel: 'time, s', yLabel: 'Pa',
    extent: () => ({ x: [0, envelope.seconds], y: [-1.05 * top, 1.05 * top] }),
    paint(c) {
      const n = envelope.low.length, t = i => (i + 0.5) / n * envelope.seconds;
      c.fillStyle = css('--accent');
      c.beginPath();
      for (let i = 0; i < n; ++i) c.lineTo(plot.x(t(i)), plot.y(envelope.high[i]) - 0.5);
      for (let i = n; i-- > 0;) c.lineTo(plot.x(t(i)), plot.y(envelope.low[i]) + 0.5);
      c.fill();
    },
    cursor(c) {
      if (!audio) return;
      const x = plot.x(envelope.heard + audio.currentTime);
      c.strokeStyle = css('--cursor');
      line(c, x, plot.margin[0], x, plot.margin[0] + plot.height);
    },
  });
  if (!audio) return;
  plot.canvas.addEventListener('pointerdown', e => {
    audio.currentTime = clamp(plot.fromX(e.offsetX) - envelope.heard, 0, audio.duration || 0);
    plot.overlay();
  });
  const follow = () => {
    plot.overlay();
    if (count) point(rowAt(envelope.heard + audio.currentTime));
    if (!audio.paused) requestAnimationFrame(follow);
  };
  audio.addEventListener('play', follow);
  audio.addEventListener('seeked', () => plot.overlay());
}
function wavePlot(wave, index) {
  const figure = document.createElement('figure');
  const id = 'wave-' + index;
  figure.innerHTML = `<div class="plot"><canvas id="${id}" role="img"></canvas></div><figcaption></figcaption>`;
  figure.querySelector('canvas').setAttribute('aria-label', wave.label);
  figure.querySelector('figcaption').textContent = wave.label;
  document.getElementById('waves').append(figure);
  const span = Math.max(...data.waves.map(w => largest(w.samples.map(Math.abs)))) || 1;
  const plot = new Plot(id, {
    xLabel: 'time, ms', yLabel: 'Pa',
    extent: () => ({ x: [0, 1000 * wave.samples.length / wave.rate], y: [-1.08 * span, 1.08 * span] }),
    paint(c) { curve(c, plot, i => 1000 * i / wave.rate, wave.samples, css('--accent')); },
  });
}

const remove = id => document.getElementById(id).remove();
if (count) {
  slider.max = count - 1;
  slider.addEventListener('input', () => point(Number(slider.value)));
  forcePlot();
  pathPlot();
  point(rows.peak.indexOf(largest(rows.peak)));
} else {
  remove('forces');
  remove('path');
}
if (data.turn) turnPlots(data.turn); else remove('turn');
if (data.envelope) {
  envelopePlot(data.envelope);
  data.waves.forEach(wavePlot);
} else {
  remove('sound');
}

// The part in 3D: WebGL 2 by hand, drawn only when something changes. Without it the picture stays.
{
  const figure = document.getElementById('part-view');
  const store = document.getElementById('part');
  if (figure && store && data.part) showPart(figure, store.textContent);
}

function showPart(figure, coded) {
  const part = data.part;
  const canvas = figure.querySelector('canvas'), picture = figure.querySelector('img');
  const gl = canvas.getContext('webgl2', { antialias: true, premultipliedAlpha: true, preserveDrawingBuffer: true });
  if (!gl) return;

  const vertexShader = `#version 300 es
    in vec3 place; in float untouched; in float deviation;
    uniform mat4 view; uniform vec3 origin; uniform vec3 scales;
    out vec3 world; out float blank; out float off;
    void main() {
      world = origin + scales.x * place;
      blank = untouched;
      off = scales.y * deviation / max(scales.z, 1e-9);
      gl_Position = view * vec4(world, 1.0);
    }`;
  const fragmentShader = `#version 300 es
    precision highp float;
    in vec3 world; in float blank; in float off;
    uniform vec3 eye; uniform bool deviations;
    out vec4 colour;
    void main() {
      vec3 n = normalize(cross(dFdx(world), dFdy(world))), to = normalize(eye - world);
      n = faceforward(n, -to, n);
      vec3 machined = vec3(0.31, 0.53, 0.78), stock = vec3(0.66, 0.68, 0.71);
      if (deviations) {
        float t = clamp(off, -1.0, 1.0);
        vec3 end = t < 0.0 ? vec3(0.85, 0.37, 0.01) : vec3(0.33, 0.22, 0.62);
        machined = mix(vec3(0.96), end, abs(t));
      }
      vec3 base = blank > 0.99 ? stock : machined;
      float lamp = max(dot(n, normalize(to + vec3(-0.3, -0.35, 0.6))), 0.0);
      float sky = 0.5 + 0.5 * n.z;
      colour = vec4(base * (0.34 + 0.2 * sky + 0.58 * lamp) + 0.08 * pow(lamp, 40.0), 1.0);
    }`;
  const markShader = [`#version 300 es
    uniform mat4 view; uniform vec3 tip; uniform float size;
    void main() { gl_Position = view * vec4(tip, 1.0); gl_Position.z -= 1e-3 * gl_Position.w; gl_PointSize = size; }`,
  `#version 300 es
    precision mediump float;
    out vec4 colour;
    void main() {
      float r = 2.0 * length(gl_PointCoord - 0.5);
      if (r > 1.0) discard;
      colour = r > 0.72 ? vec4(0.1, 0.1, 0.1, 1.0) : vec4(0.95, 0.78, 0.0, 1.0);
    }`];
  const program = link(vertexShader, fragmentShader), mark = link(...markShader);
  if (!program || !mark) return;
  function link(...sources) {
    const made = gl.createProgram();
    [gl.VERTEX_SHADER, gl.FRAGMENT_SHADER].forEach((kind, i) => {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, sources[i]);
      gl.compileShader(shader);
      gl.attachShader(made, shader);
    });
    gl.linkProgram(made);
    return gl.getProgramParameter(made, gl.LINK_STATUS) ? made : null;
  }

  // ---- the mesh (report_part.hpp says how its bytes lie)
  const bytes = Uint8Array.from(atob(coded.trim()), c => c.charCodeAt(0));
  const withDeviation = part.deviation_step !== undefined;
  const sizes = [6 * part.vertices, withDeviation ? 2 * part.vertices : 0, 6 * part.triangles, part.vertices];
  let at = 0;
  const [places, deviations, indices, untouched] = sizes.map(size => bytes.subarray(at, at += size));
  const corners = new Uint16Array(places.buffer, places.byteOffset, 3 * part.vertices);
  gl.useProgram(program);
  const attribute = (name, list, count, type) => {
    const where = gl.getAttribLocation(program, name);
    if (where < 0 || !list.length) return;
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, list, gl.STATIC_DRAW);
    gl.enableVertexAttribArray(where);
    gl.vertexAttribPointer(where, count, type, false, 0, 0);
  };
  attribute('place', places, 3, gl.UNSIGNED_SHORT);
  attribute('deviation', deviations, 1, gl.SHORT);
  attribute('untouched', untouched, 1, gl.UNSIGNED_BYTE);
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.STATIC_DRAW);
  const uniform = (of, name) => gl.getUniformLocation(of, name);

  // ---- where it is seen from
  const top = [0, 1, 2].map(k => corners.reduce((m, v, i) => (i % 3 === k ? Math.max(m, v) : m), 0));
  const centre = part.origin.map((o, k) => o + 0.5 * part.step * top[k]);
  const radius = Math.max(0.5 * part.step * Math.hypot(...top), 1e-6);
  const halfView = Math.tan(0.5 * 27 * Math.PI / 180);
  const start = { turn: Math.atan2(-1, 0.55), rise: Math.atan2(0.9, Math.hypot(0.55, 1)), near: 1, target: centre };
  let eye = { ...start }, byDeviation = false, wanted = false;

  const add = (a, b, s = 1) => a.map((v, k) => v + s * b[k]);
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  function axes({ turn, rise }) {
    const back = [Math.cos(rise) * Math.cos(turn), Math.cos(rise) * Math.sin(turn), Math.sin(rise)];
    const right = [-Math.sin(turn), Math.cos(turn), 0];
    return { back, right, up: cross(back, right) };
  }
  // So far away that the whole part is seen at the start.
  const half = top.map(v => 0.5 * part.step * v);
  function distance(aspect) {
    const { back, right, up } = axes(start);
    let far = 0;
    for (let n = 0; n < 8; ++n) {
      const c = half.map((v, k) => (n >> k & 1 ? v : -v));
      far = Math.max(far, dot(back, c) + Math.max(Math.abs(dot(right, c)) / aspect, Math.abs(dot(up, c))) / halfView);
    }
    return 1.06 * far / eye.near;
  }

  function draw() {
    wanted = false;
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    const w = Math.round(canvas.clientWidth * ratio), h = Math.round(canvas.clientHeight * ratio);
    if (w < 1 || h < 1 || gl.isContextLost()) return;
    if (canvas.width !== w || canvas.height !== h) { canvas.width = w; canvas.height = h; }
    const aspect = w / h, far = distance(aspect), { back, right, up } = axes(eye);
    const from = add(eye.target, back, far);
    // Everything of the part lies between these, from wherever it is seen.
    const deep = radius + Math.hypot(...add(centre, eye.target, -1));
    const n = Math.max(far - deep, 1e-3 * radius), f = far + deep;
    const fy = 1 / halfView, fx = fy / aspect, a = (f + n) / (n - f), b = 2 * f * n / (n - f);
    const rows = [right, up, back].map(axis => [...axis, -dot(axis, from)]);
    const view = new Float32Array(16);
    for (let k = 0; k < 4; ++k) {
      view[4 * k] = fx * rows[0][k];
      view[4 * k + 1] = fy * rows[1][k];
      view[4 * k + 2] = a * rows[2][k] + (k === 3 ? b : 0);
      view[4 * k + 3] = -rows[2][k];
    }
    gl.viewport(0, 0, w, h);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.useProgram(program);
    gl.uniformMatrix4fv(uniform(program, 'view'), false, view);
    gl.uniform3fv(uniform(program, 'origin'), part.origin);
    gl.uniform3f(uniform(program, 'scales'), part.step, part.deviation_step || 0, part.deviation_range || 1);
    gl.uniform3fv(uniform(program, 'eye'), from);
    gl.uniform1i(uniform(program, 'deviations'), byDeviation ? 1 : 0);
    gl.drawElements(gl.TRIANGLES, 3 * part.triangles, gl.UNSIGNED_SHORT, 0);
    if (current >= 0) {
      gl.useProgram(mark);
      gl.uniformMatrix4fv(uniform(mark, 'view'), false, view);
      gl.uniform3f(uniform(mark, 'tip'), tipOf('x'), tipOf('y'), tipOf('z'));
      gl.uniform1f(uniform(mark, 'size'), 13 * ratio);
      gl.drawArrays(gl.POINTS, 0, 1);
    }
  }
  const tipOf = key => data.rows[key][current];
  const redraw = () => { if (!wanted) { wanted = true; requestAnimationFrame(draw); } };

  const turnBy = (dx, dy) => {
    eye.turn -= dx;
    eye.rise = clamp(eye.rise + dy, -1.55, 1.55);
    redraw();
  };
  const nearer = factor => { eye.near = clamp(eye.near * factor, 0.3, 60); redraw(); };
  const shift = (dx, dy) => {  // in pixels of the canvas
    const aspect = canvas.clientWidth / canvas.clientHeight, { right, up } = axes(eye);
    const mm = 2 * halfView * distance(aspect) / canvas.clientHeight;
    eye.target = add(add(eye.target, right, -dx * mm), up, dy * mm);
    redraw();
  };

  // ---- mouse, touch, pen: one turns, two shift and come nearer
  const down = new Map();
  const spread = () => {
    const [a, b] = [...down.values()];
    return { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, apart: Math.hypot(a.x - b.x, a.y - b.y) };
  };
  canvas.addEventListener('pointerdown', e => {
    down.set(e.pointerId, { x: e.offsetX, y: e.offsetY });
    canvas.setPointerCapture(e.pointerId);
  });
  canvas.addEventListener('pointermove', e => {
    const before = down.get(e.pointerId);
    if (!before) return;
    const two = down.size === 2 ? spread() : null;
    const dx = e.offsetX - before.x, dy = e.offsetY - before.y;
    down.set(e.pointerId, { x: e.offsetX, y: e.offsetY });
    if (two) {
      const now = spread();
      shift(now.x - two.x, now.y - two.y);
      if (two.apart > 0) nearer(now.apart / two.apart);
    } else if (e.shiftKey || e.buttons === 2 || e.buttons === 4) {
      shift(dx, dy);
    } else if (down.size === 1) {
      turnBy(0.008 * dx, 0.008 * dy);
    }
  });
  for (const end of ['pointerup', 'pointercancel', 'lostpointercapture'])
    canvas.addEventListener(end, e => down.delete(e.pointerId));
  canvas.addEventListener('contextmenu', e => e.preventDefault());
  // The wheel scrolls the page until the view was clicked.
  canvas.addEventListener('wheel', e => {
    if (document.activeElement !== canvas && !e.ctrlKey) return;
    e.preventDefault();
    nearer(Math.exp(-0.0015 * e.deltaY));
  }, { passive: false });
  canvas.addEventListener('dblclick', () => { eye = { ...start }; redraw(); });
  canvas.addEventListener('keydown', e => {
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[e.key];
    if (step) {
      if (e.shiftKey) shift(30 * step[0], 30 * step[1]); else turnBy(0.12 * step[0], 0.12 * step[1]);
    } else if (e.key === '+' || e.key === '=') nearer(1.2);
    else if (e.key === '-') nearer(1 / 1.2);
    else if (e.key === 'Home') { eye = { ...start }; redraw(); }
    else return;
    e.preventDefault();
  });

  // ---- colours
  if (withDeviation) {
    const choice = figure.querySelector('.choices');
    const range = short(part.deviation_range);
    choice.hidden = false;
    choice.addEventListener('change', e => {
      byDeviation = e.target.value === 'deviation';
      figure.querySelector('.scale').hidden = !byDeviation;
      redraw();
    });
    figure.querySelectorAll('.scale span').forEach((s, i) => { s.textContent = [`−${range} mm gouge`, '0', `+${range} mm left`][i]; });
  }

  const show = on => {
    picture.hidden = on;
    for (const shown of figure.querySelectorAll('.live')) shown.hidden = !on;
  };
  canvas.addEventListener('webglcontextlost', () => show(false));
  show(true);
  new ResizeObserver(redraw).observe(canvas);
  linked.push({ overlay: redraw });
  redraw();
}

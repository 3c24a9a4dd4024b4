// Plays the flow: particles coloured by pressure or speed, the solid as it is bent, walls, a scale. In three dimensions
// seen from far away, particles behind first; dragging turns the view.
"use strict";
(function () {
  const flow = reportData.flow;
  if (!flow) return;
  const canvas = document.getElementById("flow"), pen = canvas.getContext("2d");
  const play = document.getElementById("play"), moment = document.getElementById("moment"), clock = document.getElementById("clock");
  const field = document.getElementById("field"), pace = document.getElementById("pace");
  const side = document.getElementById("side");
  const D = flow.view.length / 2, low = flow.view.slice(0, D), high = flow.view.slice(D);
  const middle = low.map((l, d) => (l + high[d]) / 2);
  const end = flow.frames[flow.frames.length - 1].t, begin = flow.frames[0].t;

  // Viridis, at nine places: even in lightness, readable in grey and for colour-blind eyes.
  const stops = [[68, 1, 84], [71, 44, 122], [59, 81, 139], [44, 113, 142], [33, 144, 141], [39, 173, 129], [92, 200, 99], [170, 220, 50], [253, 231, 37]];
  const palette = Array.from({ length: 256 }, (_, i) => {
    const at = (i / 255) * (stops.length - 1), k = Math.min(stops.length - 2, Math.floor(at)), w = at - k;
    return "rgb(" + stops[k].map((c, d) => Math.round(c + w * (stops[k + 1][d] - c))).join(",") + ")";
  });

  const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  // Decoded when first shown; a frame that was seen stays decoded.
  function unpacked(frame) {
    if (!frame.places) {
      const raw = bytes(frame.at);
      frame.places = new Uint16Array(raw.length / 2);
      for (let i = 0; i < frame.places.length; ++i) frame.places[i] = raw[2 * i] | (raw[2 * i + 1] << 8);
      frame.colours = frame.values.map(bytes);
    }
    return frame;
  }

  let shown = Math.floor((flow.frames.length - 1) / 2), playing = false, scale = 1, width = 1, height = 1;

  // Where the viewer stands: turned by azimuth about the upward axis, raised by elevation [degrees].
  let azimuth = 0, elevation = 0, ca = 1, sa = 0, ce = 1, se = 0;
  function turn(a, e) {
    azimuth = a; elevation = e;
    ca = Math.cos((a * Math.PI) / 180); sa = Math.sin((a * Math.PI) / 180);
    ce = Math.cos((e * Math.PI) / 180); se = Math.sin((e * Math.PI) / 180);
  }
  // To the right and upwards as seen by the viewer, and how far away, from the middle of the view [m].
  function seen(at) {
    const x = at[0] - middle[0], y = at[1] - middle[1];
    if (D === 2) return [x, y, 0];
    const z = at[2] - middle[2], away = y * ca - x * sa;
    return [x * ca + y * sa, z * ce + away * se, away * ce - z * se];
  }
  const X = (u) => width / 2 + u * scale, Y = (v) => height / 2 - v * scale;

  function extent() {
    let across = 0, up = 0;
    for (let corner = 0; corner < 1 << D; ++corner) {
      const [u, v] = seen(low.map((l, d) => (corner & (1 << d) ? high[d] : l)));
      across = Math.max(across, 2 * u); up = Math.max(up, 2 * v);
    }
    return [across, up];
  }

  function fit() {
    const ratio = window.devicePixelRatio || 1, [across, up] = extent();
    width = canvas.clientWidth;
    height = Math.max(220, Math.min((width * up) / across, window.innerHeight * 0.72));
    canvas.style.height = height + "px";
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    scale = Math.min(width / across, height / up);
    paint();
  }

  function path(flat, closed, dimension) {
    pen.beginPath();
    addLine(flat, closed, dimension);
  }
  function addLine(flat, closed, dimension) {
    for (let i = 0; i + dimension <= flat.length; i += dimension) {
      const [u, v] = seen(flat.slice(i, i + dimension));
      if (i === 0) pen.moveTo(X(u), Y(v)); else pen.lineTo(X(u), Y(v));
    }
    if (closed) pen.closePath();
  }

  function particles(frame) {
    const size = Math.max(1, flow.spacing * Math.pow(frame.every, 1 / D) * scale), colours = frame.colours[field.selectedIndex];
    const round = size > 5, unit = low.map((l, d) => (high[d] - l) / 65534), at = new Array(D);
    const dot = (u, v) => {
      const x = X(u), y = Y(v);
      if (round) { pen.moveTo(x + 0.53 * size, y); pen.arc(x, y, 0.53 * size, 0, 2 * Math.PI); } else pen.rect(x - size / 2, y - size / 2, 1.04 * size, 1.04 * size);
    };
    const across = new Float32Array(frame.n), upwards = new Float32Array(frame.n), away = new Float32Array(frame.n), there = [];
    for (let i = 0; i < frame.n; ++i) {
      let drawn = true;
      for (let d = 0; d < D; ++d) {
        const q = frame.places[D * i + d];
        drawn = drawn && q !== 65535;
        at[d] = low[d] + q * unit[d];
      }
      if (!drawn) continue;
      [across[i], upwards[i], away[i]] = seen(at);
      there.push(i);
    }
    if (D === 3) {
      there.sort((i, j) => away[j] - away[i]);
      pen.strokeStyle = "rgba(0, 0, 0, 0.3)";  // a rim, so that equal colours do not melt into one
      pen.lineWidth = 0.7;
      for (const i of there) {
        pen.fillStyle = palette[colours ? colours[i] : 100];
        pen.beginPath();
        dot(across[i], upwards[i]);
        pen.fill();
        if (round) pen.stroke();
      }
      return;
    }
    // By colour, so that the pen changes 256 times and not once a particle.
    const order = Array.from({ length: 256 }, () => []);
    for (const i of there) order[colours ? colours[i] : 100].push(i);
    order.forEach((list, colour) => {
      if (!list.length) return;
      pen.fillStyle = palette[colour];
      pen.beginPath();
      for (const i of list) dot(across[i], upwards[i]);
      pen.fill();
    });
  }

  const nice = (length) => { const p = 10 ** Math.floor(Math.log10(length)); return [5, 2, 1].map((k) => k * p).find((l) => l <= length) || p; };
  const lengthText = (l) => (l < 0.001 ? +(l * 1e6).toPrecision(3) + " µm" : l < 1 ? +(l * 1000).toPrecision(3) + " mm" : +l.toPrecision(3) + " m");

  // Written on whatever is behind it.
  function label(text, x, y, align) {
    pen.textAlign = align;
    pen.lineWidth = 4; pen.strokeStyle = css("--canvas"); pen.strokeText(text, x, y);
    pen.fillStyle = css("--ink"); pen.fillText(text, x, y);
  }

  function legend() {
    const f = flow.fields[field.selectedIndex];
    pen.font = "12px " + getComputedStyle(document.body).fontFamily;
    pen.textBaseline = "alphabetic";
    if (f) {
      const w = Math.min(190, width / 3), x = width - w - 16, y = 30, s = prefixed(f.unit, Math.max(Math.abs(f.low), Math.abs(f.high)));
      for (let i = 0; i < w; ++i) { pen.fillStyle = palette[Math.round((255 * i) / (w - 1))]; pen.fillRect(x + i, y, 1.5, 9); }
      label(+(f.low / s.factor).toPrecision(3), x, y + 23, "left");
      label(+(f.high / s.factor).toPrecision(3), x + w, y + 23, "right");
      label(f.name + " [" + s.unit + "]", x + w / 2, y - 7, "center");
    }
    const bar = nice((0.22 * width) / scale), y = height - 16;
    pen.strokeStyle = css("--ink");
    pen.lineWidth = 2;
    pen.beginPath(); pen.moveTo(16, y - 4); pen.lineTo(16, y); pen.lineTo(16 + bar * scale, y); pen.lineTo(16 + bar * scale, y - 4); pen.stroke();
    label(lengthText(bar), 16 + (bar * scale) / 2, y - 7, "center");
    pen.font = "600 14px " + getComputedStyle(document.body).fontFamily;
    label("t = " + flow.frames[shown].t.toFixed(4) + " s", 16, 28, "left");
  }

  function walls(opacity) {
    pen.strokeStyle = css("--wall");
    pen.lineWidth = D === 3 ? 1.2 : 2.5;
    pen.globalAlpha = opacity;
    for (const wall of flow.walls) { path(wall.points, wall.closed, D); pen.stroke(); }
    for (const panel of flow.frames[shown].walls || []) { path(panel, D === 3, D); pen.stroke(); }
    pen.globalAlpha = 1;
  }

  function paint() {
    const frame = unpacked(flow.frames[shown]);
    pen.clearRect(0, 0, width, height);
    if (D === 3) walls(1);
    particles(frame);
    pen.lineJoin = "round";
    pen.beginPath();
    for (const outline of frame.outlines) addLine(outline, true, 2);
    pen.fillStyle = css("--solid-fill"); pen.fill("evenodd");  // holes stay open
    pen.strokeStyle = css("--solid-line"); pen.lineWidth = 1.4; pen.stroke();
    walls(D === 3 ? 0.25 : 1);  // in space the water stands before them, and they before the water
    legend();
    moment.value = shown;
    clock.textContent = frame.t.toFixed(4) + " s";
  }

  // The film keeps the simulated time even where frames are not evenly spaced.
  let started = 0, from = 0;
  function tick(now) {
    if (!playing) return;
    const span = Math.max(end - begin, 1e-30), t = begin + ((from - begin + ((now - started) / 1000 / Number(pace.value)) * span) % (span * 1.08));
    let next = 0;
    while (next + 1 < flow.frames.length && flow.frames[next + 1].t <= t) ++next;
    if (next !== shown) { shown = next; paint(); }
    requestAnimationFrame(tick);
  }
  function run(on) {
    playing = on && flow.frames.length > 1;
    play.textContent = playing ? "❚❚" : "▶";
    play.setAttribute("aria-label", playing ? "pause" : "play");
    if (!playing) return;
    from = shown === flow.frames.length - 1 ? begin : flow.frames[shown].t;
    started = performance.now();
    requestAnimationFrame(tick);
  }
  const show = (i) => { run(false); shown = Math.max(0, Math.min(flow.frames.length - 1, i)); paint(); };

  for (const f of flow.fields) field.add(new Option(f.name));
  field.hidden = flow.fields.length < 2;
  moment.max = flow.frames.length - 1;
  play.addEventListener("click", () => run(!playing));
  moment.addEventListener("input", () => show(Number(moment.value)));
  field.addEventListener("change", paint);
  pace.addEventListener("change", () => run(playing));
  let dragged = false;
  canvas.addEventListener("click", () => { if (!dragged) run(!playing); dragged = false; });
  if (D === 3) {
    const stand = () => turn(...side.value.split(",").map(Number));
    side.hidden = false;
    stand();
    side.addEventListener("change", () => { stand(); fit(); });
    canvas.style.touchAction = "none";
    canvas.addEventListener("pointerdown", (event) => { dragged = false; canvas.setPointerCapture(event.pointerId); });
    canvas.addEventListener("pointermove", (event) => {
      if (!event.buttons || (!event.movementX && !event.movementY)) return;
      dragged = true;
      turn(azimuth - 0.4 * event.movementX, Math.max(-90, Math.min(90, elevation + 0.4 * event.movementY)));
      paint();
    });
  }
  canvas.addEventListener("keydown", (event) => {
    if (event.key === " ") run(!playing);
    else if (event.key === "ArrowRight") show(shown + 1);
    else if (event.key === "ArrowLeft") show(shown - 1);
    else return;
    event.preventDefault();
  });
  addEventListener("resize", fit);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", paint);
  fit();
})();

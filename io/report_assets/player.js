// Plays the flow: particles coloured by pressure or speed, the solid as it is bent, walls, a scale.
"use strict";
(function () {
  const flow = reportData.flow;
  if (!flow) return;
  const canvas = document.getElementById("flow"), pen = canvas.getContext("2d");
  const play = document.getElementById("play"), moment = document.getElementById("moment"), clock = document.getElementById("clock");
  const field = document.getElementById("field"), pace = document.getElementById("pace");
  const [x0, y0, x1, y1] = flow.view;
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

  let shown = Math.floor((flow.frames.length - 1) / 2), playing = false, scale = 1, width = 1, height = 1, left = 0, top = 0;
  const X = (x) => left + (x - x0) * scale, Y = (y) => top + (y1 - y) * scale;

  function fit() {
    const ratio = window.devicePixelRatio || 1;
    width = canvas.clientWidth;
    height = Math.max(220, Math.min((width * (y1 - y0)) / (x1 - x0), window.innerHeight * 0.72));
    canvas.style.height = height + "px";
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    scale = Math.min(width / (x1 - x0), height / (y1 - y0));
    left = (width - scale * (x1 - x0)) / 2;
    top = (height - scale * (y1 - y0)) / 2;
    paint();
  }

  function path(flat, closed) {
    pen.beginPath();
    for (let i = 0; i + 1 < flat.length; i += 2) pen.lineTo(X(flat[i]), Y(flat[i + 1]));
    if (closed) pen.closePath();
  }

  function particles(frame) {
    const size = Math.max(1, flow.spacing * Math.sqrt(frame.every) * scale), colours = frame.colours[field.selectedIndex];
    const unit = { x: (x1 - x0) / 65534, y: (y1 - y0) / 65534 }, round = size > 5;
    // By colour, so that the pen changes 256 times and not once a particle.
    const order = Array.from({ length: 256 }, () => []);
    for (let i = 0; i < frame.n; ++i) order[colours ? colours[i] : 100].push(i);
    order.forEach((list, colour) => {
      if (!list.length) return;
      pen.fillStyle = palette[colour];
      pen.beginPath();
      for (const i of list) {
        const qx = frame.places[2 * i], qy = frame.places[2 * i + 1];
        if (qx === 65535 || qy === 65535) continue;
        const x = X(x0 + qx * unit.x), y = Y(y0 + qy * unit.y);
        if (round) { pen.moveTo(x + size / 2, y); pen.arc(x, y, 0.53 * size, 0, 2 * Math.PI); } else pen.rect(x - size / 2, y - size / 2, 1.04 * size, 1.04 * size);
      }
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

  function paint() {
    const frame = unpacked(flow.frames[shown]);
    pen.clearRect(0, 0, width, height);
    particles(frame);
    pen.lineJoin = "round";
    for (const outline of frame.outlines) {
      path(outline, true);
      pen.fillStyle = css("--solid-fill"); pen.fill();
      pen.strokeStyle = css("--solid-line"); pen.lineWidth = 1.4; pen.stroke();
    }
    pen.strokeStyle = css("--wall");
    pen.lineWidth = 2.5;
    for (const wall of flow.walls) { path(wall.points, wall.closed); pen.stroke(); }
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
  canvas.addEventListener("click", () => run(!playing));
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

// Plots of the history with its references (Chart.js), in the colours of the page.
"use strict";
const reportData = JSON.parse(document.getElementById("data").textContent);
const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

// SI prefix for a unit that takes one: {factor, unit}.
function prefixed(unit, largest) {
  if (!/^(m|s|Pa|N|J|W)(\/|$)/.test(unit) || !(largest > 0)) return { factor: 1, unit: unit };
  for (const [factor, prefix] of [[1e9, "G"], [1e6, "M"], [1e3, "k"], [1, ""], [1e-3, "m"], [1e-6, "µ"], [1e-9, "n"]])
    if (largest >= 0.9995 * factor) return { factor: factor, unit: prefix + unit };
  return { factor: 1, unit: unit };
}

// [t0, v0, t1, v1, …] -> points of Chart.js; null is a gap.
function unflatten(flat, factor) {
  const points = [];
  for (let i = 0; i + 1 < flat.length; i += 2) points.push({ x: flat[i], y: flat[i + 1] === null ? NaN : flat[i + 1] / factor });
  return points;
}

function lookOf(series, index, plot) {
  const colours = [1, 2, 3, 4, 5, 6, 7, 8].map((i) => css("--s" + i));
  if (series.kind === "computed") {
    const colour = plot.compared ? colours[0] : colours[index % colours.length];
    return { borderColor: colour, backgroundColor: colour, borderWidth: plot.compared ? 2.6 : 1.6, pointRadius: 0, order: 1 };
  }
  const few = series.points.length <= 40;
  const drawn = plot.series.filter((s) => s.kind === "drawn").indexOf(series);
  const colour = series.kind === "measured" ? css("--ink") : [colours[7], colours[1], colours[2], colours[3], colours[4], colours[6]][drawn % 6];
  return {
    borderColor: colour, backgroundColor: series.kind === "measured" ? colour : "transparent", order: series.kind === "measured" ? 0 : 2,
    borderWidth: 1.4, borderDash: few ? [] : [6, 4], showLine: !few, pointRadius: few ? 4.5 : 0, pointStyle: series.kind === "measured" ? "circle" : "rectRot",
    pointBorderWidth: 1.5,
  };
}

// The time in which errors are measured, as a band behind the curves.
const windowBand = {
  id: "windowBand",
  beforeDatasetsDraw(chart, _, options) {
    const { ctx, chartArea: area, scales: { x } } = chart;
    ctx.save();
    ctx.fillStyle = css("--window");
    for (const [from, to] of options.windows || []) {
      const left = Math.max(area.left, x.getPixelForValue(from)), right = Math.min(area.right, x.getPixelForValue(to));
      if (right > left) ctx.fillRect(left, area.top, right - left, area.height);
    }
    ctx.restore();
  },
};

function draw(plot, parent) {
  const computed = plot.series.filter((s) => s.kind === "computed");
  const reach = (list) => list.reduce((m, s) => s.points.reduce((k, v, i) => (i % 2 && v !== null ? Math.max(k, Math.abs(v)) : k), m), 0);
  const scale = prefixed(plot.unit, reach(plot.series));
  const unitText = scale.unit || "–";
  const box = document.createElement("div");
  box.className = "plot";
  box.innerHTML = "<h3></h3><div class='frame'><canvas></canvas></div>";
  box.querySelector("h3").textContent = (plot.title || computed.map((s) => s.label).slice(0, 4).join(", ") + (computed.length > 4 ? ", …" : "")) + "  [" + unitText + "]";
  parent.appendChild(box);
  const grid = { color: css("--rule"), borderColor: css("--soft") }, ticks = { color: css("--soft") };
  const title = (text) => ({ display: true, text: text, color: css("--soft") });
  const last = Math.max(...computed.map((s) => (s.points.length ? s.points[s.points.length - 2] : 0)), ...plot.windows.map((w) => w[1]));
  return new Chart(box.querySelector("canvas"), {
    type: "line",
    data: { datasets: plot.series.map((s, i) => ({ label: s.label, data: unflatten(s.points, scale.factor), ...lookOf(s, i, plot) })) },
    plugins: [windowBand],
    options: {
      animation: false, parsing: false, normalized: true, maintainAspectRatio: false, spanGaps: false, interaction: { mode: "nearest", axis: "x", intersect: false },
      scales: {
        x: { type: "linear", min: 0, max: last > 0 ? last : undefined, title: title("time [s]"), grid: grid, ticks: ticks },
        y: { grid: grid, ticks: ticks },
      },
      plugins: {
        windowBand: { windows: plot.windows },
        legend: {
          display: plot.series.length > 1, position: "bottom", align: "start",
          labels: { color: css("--ink"), usePointStyle: true, boxWidth: 22, boxHeight: 7, padding: 10,
            sort: (a, b) => (plot.compared ? b.datasetIndex - a.datasetIndex : a.datasetIndex - b.datasetIndex),
            generateLabels: (chart) => Chart.defaults.plugins.legend.labels.generateLabels(chart).map((l) => {
              const set = chart.data.datasets[l.datasetIndex];
              return { ...l, pointStyle: set.pointRadius ? set.pointStyle : "line", lineWidth: set.borderWidth, lineDash: set.borderDash };
            }) },
        },
        tooltip: { callbacks: { title: (items) => "t = " + items[0].parsed.x.toPrecision(4) + " s",
          label: (item) => item.dataset.label + ": " + item.parsed.y.toPrecision(4) + " " + scale.unit } },
      },
    },
  });
}

let charts = [];
function drawAll() {
  charts.forEach((chart) => chart.destroy());
  charts = [];
  for (const id of ["compared-plots", "other-plots"]) {
    const parent = document.getElementById(id);
    if (!parent) continue;
    parent.textContent = "";
    for (const plot of reportData.plots) if (plot.compared === (id === "compared-plots")) charts.push(draw(plot, parent));
  }
}
if (window.Chart) {
  Chart.defaults.font.family = getComputedStyle(document.body).fontFamily;
  drawAll();
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", drawAll);
  addEventListener("beforeprint", () => charts.forEach((chart) => chart.resize()));
}

// --- plots of lines: zoom by dragging, values under the pointer or by keys ---

const DASHES = [null, [9, 4], [2, 3], [10, 3, 2, 3], [5, 2], [14, 3]];
const MARKERS = [
  (c, x, y, r) => c.arc(x, y, r, 0, 7),
  (c, x, y, r) => c.rect(x - r, y - r, 2 * r, 2 * r),
  (c, x, y, r) => { c.moveTo(x, y - 1.3 * r); c.lineTo(x + 1.2 * r, y + r); c.lineTo(x - 1.2 * r, y + r); c.closePath(); },
  (c, x, y, r) => { c.moveTo(x, y - 1.4 * r); c.lineTo(x + 1.4 * r, y); c.lineTo(x, y + 1.4 * r); c.lineTo(x - 1.4 * r, y); c.closePath(); },
  (c, x, y, r) => { c.moveTo(x - r, y - r); c.lineTo(x + r, y + r); c.moveTo(x - r, y + r); c.lineTo(x + r, y - r); },
  (c, x, y, r) => { c.moveTo(x - 1.3 * r, y); c.lineTo(x + 1.3 * r, y); c.moveTo(x, y - 1.3 * r); c.lineTo(x, y + 1.3 * r); },
];
const dash = (k) => DASHES[Math.floor(k / 6 + k) % 6];  // another with each colour, once all colours are used
const colour = (k) => getComputedStyle(document.documentElement).getPropertyValue(`--series-${k % 6}`).trim();
const ink = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
const dark = window.matchMedia("(prefers-color-scheme: dark)");

function sample(k, points) {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  for (const [key, value] of Object.entries({width: 34, height: 12, "aria-hidden": "true"})) svg.setAttribute(key, value);
  const line = document.createElementNS("http://www.w3.org/2000/svg", "path");
  const marks = ["M17 2a4 4 0 1 0 .1 0z", "M13 2h8v8h-8z", "M17 1l5 9h-10z", "M17 1l5 5-5 5-5-5z", "M13 2l8 8m-8 0l8-8", "M12 6h10m-5-5v10"];
  line.setAttribute("d", `M0 6H34${points ? marks[k % 6] : ""}`);
  line.setAttribute("style", `stroke:var(--series-${k % 6});stroke-width:2;fill:none;` + (dash(k) && !points ? `stroke-dasharray:${dash(k)}` : ""));
  svg.append(line);
  return svg;
}

// At powers of ten, or, where there are hardly any, also at 2 and 5 of them.
function logTicks(from, to, pixels, apart) {
  const low = Math.log10(from), high = Math.log10(to), most = Math.max(2, pixels / apart), ticks = [];
  if (high - low < 1e-3) return [{v: from, label: short(from)}];
  const factors = 3 * (high - low) < most ? [1, 2, 5] : [1], step = Math.max(1, Math.ceil((high - low) / most));
  for (let power = Math.floor(low); power <= high; ++power) {
    if (power % step !== 0) continue;
    for (const factor of factors) {
      const v = factor * 10 ** power;
      if (v >= from * (1 - 1e-9) && v <= to * (1 + 1e-9)) ticks.push({v, label: short(Number(v.toPrecision(3)), 3)});
    }
  }
  return ticks.length > 1 ? ticks : [{v: from, label: short(from, 3)}, {v: to, label: short(to, 3)}];
}

// what: {title, names, rows: [[x, …]], x: name of x, log, logX, points, wide, goal, choosesLog, onZoom}
function chart(parent, what) {
  const id = `chart-${document.querySelectorAll(".chart").length}`;
  const plot = element("div", {class: "plot", tabindex: 0, role: "group", "aria-roledescription": "plot",
    "aria-label": `${what.title} against ${what.x}. Left and right read values off, plus and minus zoom, Escape shows all.`});
  const legend = element("ul", {class: "legend", "aria-live": "polite", "aria-atomic": "true"});
  const reset = element("button", {type: "button"}, "Show all");
  const tools = element("div", {class: "tools"}, element("h3", {id}, what.title), reset);
  let log = what.log;
  if (what.choosesLog) {
    const box = element("input", {type: "checkbox", checked: log});
    box.addEventListener("change", () => { log = box.checked; graph.updateOptions({file: file(), logscale: log}); });
    tools.append(element("label", {}, box, "logarithmic"));
  }
  parent.append(element("section", {class: what.wide ? "chart wide" : "chart", "aria-labelledby": id}, tools, plot, legend));

  let rows = what.rows, names = what.names, numbers = what.numbers || names.map((_, k) => k);
  // What a logarithm cannot show is left out.
  const shown = () => rows.filter((row) => row[0] > 0 || !what.logX)
    .map((row) => row.map((value, k) => (Number.isFinite(value) && (value > 0 || !log || k === 0) ? value : null)));
  // On a logarithmic axis empty rows at both ends keep markers away from the border.
  function file() {
    const inside = shown(), empty = names.map(() => null);
    if (!what.logX || !inside.length) return inside;
    const [from, to] = [inside[0][0], inside.at(-1)[0]], room = Math.max(1.05, (to / from) ** 0.02);
    return [[from / room, ...empty], ...inside, [to * room, ...empty]];
  }
  const series = () => Object.fromEntries(names.map((name, k) => [name, {
    color: colour(numbers[k]), strokePattern: what.points ? null : dash(numbers[k]),
    drawPointCallback: (g, _, c, x, y, paint, r) => {
      c.beginPath(); c.strokeStyle = c.fillStyle = paint; c.lineWidth = 2;
      MARKERS[numbers[k] % 6](c, x, y, r); numbers[k] % 6 < 4 ? c.fill() : c.stroke();
    }}]));

  function read(row) {
    const values = row === null ? [] : graph.getValue(row, 0) === null ? [] : names.map((_, k) => graph.getValue(row, k + 1));
    legend.replaceChildren(...names.map((name, k) => element("li", {}, sample(numbers[k], what.points),
      values.length ? `${name} ${short(values[k], 6)}` : name)));
    if (values.length) legend.prepend(element("li", {}, `${what.x} ${short(graph.getValue(row, 0), 6)}`));
  }

  const graph = new Dygraph(plot, file(), {
    labels: [what.x, ...names], series: series(), logscale: log, legend: "never", xlabel: what.x, xLabelHeight: 20,
    connectSeparatedPoints: true, drawPoints: Boolean(what.points), pointSize: 4, highlightCircleSize: 4, strokeWidth: 2,
    gridLineColor: ink("line"), axisLineColor: ink("faint"), rightGap: 12, labelsKMB: false,
    xRangePad: what.points && !what.logX ? 10 : 0, yRangePad: 8,
    axes: {x: {logscale: Boolean(what.logX), axisLabelFormatter: (value) => short(value), pixelsPerLabel: 70,
               ...(what.logX ? {ticker: (from, to, pixels) => logTicks(from, to, pixels, 60)} : {})},
           y: {axisLabelFormatter: (value) => short(value), axisLabelWidth: 64, pixelsPerLabel: 34,
               ticker: (from, to, pixels, options, g, values) =>
                 log && from > 0 ? logTicks(from, to, pixels, 30) : Dygraph.numericLinearTicks(from, to, pixels, options, g, values)}},
    highlightCallback: (event, x, points, row) => read(row),
    unhighlightCallback: () => read(null),
    zoomCallback: () => { if (what.onZoom) what.onZoom(graph); },
    underlayCallback: (c, area, g) => {
      if (!(what.goal > 0)) return;
      const y = g.toDomYCoord(what.goal);
      if (!(y >= area.y && y <= area.y + area.h)) return;
      c.save(); c.strokeStyle = c.fillStyle = ink("faint"); c.setLineDash([3, 3]);
      c.beginPath(); c.moveTo(area.x, y); c.lineTo(area.x + area.w, y); c.stroke();
      c.font = "12px sans-serif"; c.fillText(`asked for: ${short(what.goal)}`, area.x + 6, y - 4); c.restore();
    },
  });
  read(null);

  let selected = null;
  function zoom(factor) {
    const [from, to] = graph.xAxisRange(), middle = selected === null ? (from + to) / 2 : graph.getValue(selected, 0);
    graph.updateOptions({dateWindow: [middle + (from - middle) * factor, middle + (to - middle) * factor]});
    if (what.onZoom) what.onZoom(graph);
  }
  plot.addEventListener("keydown", (event) => {
    const first = what.logX ? 1 : 0, last = graph.numRows() - 1 - first, step = event.shiftKey ? Math.ceil(last / 20) : 1;
    const to = {ArrowRight: selected === null ? first : selected + step, ArrowLeft: selected === null ? last : selected - step,
                Home: first, End: last}[event.key];
    if (to !== undefined && last >= first) {
      selected = Math.max(first, Math.min(last, to));
      graph.setSelection(selected);
      read(selected);
    } else if (event.key === "+" || event.key === "=") {
      zoom(0.5);
    } else if (event.key === "-") {
      zoom(2);
    } else if (event.key === "Escape") {
      graph.resetZoom();
      graph.clearSelection();
      selected = null;
      read(null);
    } else {
      return;
    }
    event.preventDefault();
  });
  plot.addEventListener("blur", () => { graph.clearSelection(); read(null); });
  reset.addEventListener("click", () => graph.resetZoom());
  dark.addEventListener("change", () =>
    graph.updateOptions({series: series(), gridLineColor: ink("line"), axisLineColor: ink("faint")}));
  return {
    graph,
    // Other rows under the same or other names; numbers: their colours, dashes and markers.
    update(newRows, newNames = names, newNumbers = numbers, options = {}) {
      rows = newRows; names = newNames; numbers = newNumbers; selected = null;
      graph.updateOptions({file: file(), labels: [what.x, ...names], series: series(), ...options});
      read(null);
    },
  };
}

// --- of history.csv ---

function historyCharts(page, history, goals) {
  const columns = history.columns;
  const rows = history.rows.split("\n").filter((line) => line).map((line) => line.split(",").map(Number));
  const made = section(page, "History", "history");
  if (rows.length < 2) {
    made.append(element("p", {}, "The run ended before there was a history to draw."));
    return;
  }
  made.append(element("p", {class: "faint"}, "Drag over a plot to zoom, double-click to see all of it again. With the keyboard: " +
    "Tab to a plot, left and right read values off, plus and minus zoom, Escape shows all." +
    (rows.length < history.of ? ` Of ${short(history.of)} rows in history.csv ${short(rows.length)} are drawn: the extremes of each column among their neighbours.` : "")));
  const groups = historyGroups(columns);
  const grid = element("div", {class: "charts"});
  made.append(grid);
  const all = [];
  let follows = false;
  // One zoom in t for all of them.
  const onZoom = (zoomed) => {
    if (follows) return;
    follows = true;
    const window = zoomed.isZoomed("x") ? zoomed.xAxisRange() : null;
    for (const other of all) if (other.graph !== zoomed) other.graph.updateOptions({dateWindow: window});
    follows = false;
  };
  for (const {title, names, log, goal} of groups) {
    const numbers = names.map((name) => columns.indexOf(name));
    const some = rows.map((row) => [row[0], ...numbers.map((k) => row[k])]);
    if (!some.some((row) => row.slice(1).some((value) => Number.isFinite(value) && (value > 0 || !log)))) continue;
    all.push(chart(grid, {title, x: "t [s]", names, rows: some, log, choosesLog: true, goal: goal && goals[goal], onZoom}));
  }
}

const UNITS = {u: "m", v: "m/s", stress: "Pa", strain: "", plastic_strain: "", reaction: "N", reaction_x: "N", reaction_y: "N",
               reaction_z: "N", moment_x: "N m", moment_y: "N m", moment_z: "N m", slope_angle: "°", normal: "N", shear: "N",
               volume: "m³"};

// Figures of one kind share a plot: they have one unit.
function historyGroups(columns) {
  const groups = [{title: "Residual ‖F − R‖/‖F‖", names: ["residual"], log: true, goal: "residual"}];
  if (columns.includes("distance")) groups.push({title: "Error bound ‖u − u*‖/‖u‖", names: ["distance"], log: true, goal: "distance"});
  const energies = ["kinetic_energy", "inertia.external_work"].filter((name) => columns.includes(name));
  groups.push({title: "Energies [J]", names: energies, log: true});
  if (columns.includes("inertia.kinetic_over_work"))
    groups.push({title: "Kinetic energy over external work", names: ["inertia.kinetic_over_work"], log: true});
  const used = new Set(["t", "steps", "rhs_evaluations", "residual", "distance", "inertia.kinetic_over_work", ...energies]);
  const kinds = new Map();
  for (const name of columns) {
    if (used.has(name)) continue;
    const kind = name.slice(name.indexOf(".") + 1);
    if (!kinds.has(kind)) kinds.set(kind, []);
    kinds.get(kind).push(name);
  }
  for (const [kind, names] of kinds) {
    const unit = UNITS[kind.split(".")[0]] ?? "";
    for (let k = 0; k < names.length; k += 6)  // as many as can be told apart
      groups.push({title: `${kind.replaceAll("_", " ")}${unit && ` [${unit}]`}`, names: names.slice(k, k + 6), log: false});
  }
  return groups;
}

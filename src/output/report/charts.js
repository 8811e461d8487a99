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

// what: {title, names, rows: [[x, …]], x: name of x, winds: x may go back, log, logX, points, wide, goal, choosesLog,
// slopes: [{order, from, to, at}], lines below at·x^order between two x, onZoom}
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
  // Empty rows at both ends tell how far x goes where it goes back; on a logarithmic axis they keep markers away from the border.
  const isPadded = Boolean(what.logX || what.winds);
  function file() {
    const inside = shown(), empty = names.map(() => null);
    if (!isPadded || !inside.length) return inside;
    const [from, to] = [Math.min, Math.max].map((end) => inside.reduce((found, row) => end(found, row[0]), inside[0][0]));
    const room = what.logX ? Math.max(1.05, (to / from) ** 0.02) : 1;
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
    xRangePad: what.points && !what.logX ? 10 : 0, yRangePad: what.slopes ? 30 : 8,
    axes: {x: {logscale: Boolean(what.logX), axisLabelFormatter: (value) => short(value), pixelsPerLabel: 70,
               ...(what.logX ? {ticker: (from, to, pixels) => logTicks(from, to, pixels, 60)} : {})},
           y: {axisLabelFormatter: (value) => short(value), axisLabelWidth: 64, pixelsPerLabel: 34,
               ticker: (from, to, pixels, options, g, values) =>
                 log && from > 0 ? logTicks(from, to, pixels, 30) : Dygraph.numericLinearTicks(from, to, pixels, options, g, values)}},
    highlightCallback: (event, x, points, row) => read(row),
    unhighlightCallback: () => read(null),
    zoomCallback: () => { if (what.onZoom) what.onZoom(graph); },
    underlayCallback: (c, area, g) => {
      for (const {order, from, to, at} of what.slopes || []) {
        const below = 12;  // pixels
        const [x, y] = [(size) => area.x + area.w * g.toPercentXCoord(size), (size) => g.toDomYCoord(at * size ** order) + below];
        c.save(); c.strokeStyle = c.fillStyle = ink("faint"); c.lineWidth = 1;
        c.beginPath(); c.rect(area.x, area.y, area.w, area.h); c.clip();
        c.beginPath(); c.moveTo(x(from), y(from)); c.lineTo(x(to), y(to)); c.stroke();
        c.font = "12px sans-serif"; c.textAlign = "right"; c.fillText(short(order, 3), x(to), y(to) + 14); c.restore();
      }
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
    const first = isPadded ? 1 : 0, last = graph.numRows() - 1 - first, step = event.shiftKey ? Math.ceil(last / 20) : 1;
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

// What a column is called, and its unit, by the last part of its name; probes in this order, and others after them.
const PROBED = {
  u: ["Displacement u", "m"], v: ["Velocity v", "m/s"], strain: ["Strain", ""], stress: ["Stress", "Pa"],
  effective_stress: ["Effective stress", "Pa"], pore_pressure: ["Pore pressure", "Pa"], plastic_strain: ["Plastic strain", ""],
  pc: ["Preconsolidation pressure pc", "Pa"], slope_angle: ["Slope angle", "°"], volume: ["Volume", "m³"],
  momentum: ["Momentum", "kg m/s"], angular_momentum: ["Angular momentum", "kg m²/s"],
};
const OF_FORCES = {
  force: ["Force", "N"], reaction: ["Reaction", "N"], moment: ["Moment", "N m"], displacement: ["Displacement of the rigid body", "m"],
  contact_area: ["Contact area", "m²"], penetration: ["Penetration", "cells"], slipping: ["Share of the contact that slips", ""],
};
const TOGETHER = {normal: "force", shear: "force"};  // of a wall
const MOST_LINES = 6;  // as many as can be told apart

// "toe.u.x" → {name: "toe", field: "u", component: "x"}, and so for "punch.force_y".
function partsOf(column) {
  const found = /^(.+?)\.(?:((?:force|reaction|moment|displacement|motion)(?=_[xyz]$)|[^.]+))(?:[._]([xyz]{1,2}))?$/.exec(column);
  return found ? {name: found[1], field: found[2], component: found[3] || ""} : {name: "", field: column, component: ""};
}

const titleOf = ([words, unit]) => words + (unit && ` [${unit}]`);

// By more than rounding does.
function isVarying(rows, k) {
  let least = Infinity, most = -Infinity;
  for (const row of rows) {
    if (!Number.isFinite(row[k])) continue;
    least = Math.min(least, row[k]); most = Math.max(most, row[k]);
  }
  return most - least > 1e-9 * Math.max(-least, most);
}

// Forces against the displacements that drive them: that of the loads first, then of what moves as `motion` tells.
function drivenGroups(columns, rows) {
  const groups = [];
  if (columns.includes("load.displacement")) {
    groups.push({title: "Load factor λ", x: "load.displacement",
                 xName: "mean displacement along the loads [m]", names: ["load.factor"]});
  }
  const extent = (column) => {
    const values = rows.map((row) => row[columns.indexOf(column)]).filter(Number.isFinite);
    return values.reduce((most, value) => Math.max(most, value), -Infinity) - values.reduce((least, value) => Math.min(least, value), Infinity);
  };
  const motions = columns.filter((column) => partsOf(column).field === "motion" && isVarying(rows, columns.indexOf(column)));
  for (const motion of motions) {
    const {name, component} = partsOf(motion), along = component && ` along ${component}`, end = component && `_${component}`;
    if (motions.some((other) => partsOf(other).name === name && extent(other) > extent(motion))) continue;  // along its longest way
    const names = [`${name}.normal`, `${name}.force${end}`, `${name}.reaction${end}`].filter((force) => columns.includes(force));
    if (names.length) groups.push({title: `Force of ${name}${along} [N]`, x: motion, xName: `its displacement${along} [m]`, names});
  }
  return groups;
}

// Plots in the order in which a reader asks, figures of one kind in one; what never changes has none.
function historyGroups(columns, rows) {
  const has = (name) => columns.includes(name), energies = ["kinetic_energy", "inertia.external_work"].filter(has);
  const own = [
    {title: "Residual ‖F − R‖/‖F‖", names: ["residual"], log: true, goal: "residual"},
    {title: "Error bound ‖u − u*‖/‖u‖", names: ["distance"].filter(has), log: true, goal: "distance"},
    {title: "Energies [J]", names: energies, log: true},
    {title: "Kinetic energy over external work", names: ["inertia.kinetic_over_work"].filter(has), log: true},
  ];
  const used = new Set(["t", "steps", "rhs_evaluations", "load.factor", "load.displacement", ...own.flatMap((group) => group.names)]);
  const kinds = new Map(Object.keys(PROBED).map((kind) => [kind, []])), forces = new Map(Object.keys(OF_FORCES).map((kind) => [kind, []]));
  for (const name of columns) {
    const {field} = partsOf(name), kind = TOGETHER[field] || field;
    if (used.has(name) || field === "motion") continue;
    const of = forces.has(kind) ? forces : kinds;
    if (!of.has(kind)) of.set(kind, []);
    of.get(kind).push(name);
  }
  const groups = drivenGroups(columns, rows);
  for (const [kind, names] of [...kinds, ...forces]) {
    const title = titleOf(PROBED[kind] || OF_FORCES[kind] || [kind.replaceAll("_", " "), ""]);
    for (let k = 0; k < names.length; k += MOST_LINES) groups.push({title, names: names.slice(k, k + MOST_LINES)});
  }
  groups.push(...own);
  const varying = groups.filter(({names}) => names.some((name) => isVarying(rows, columns.indexOf(name))));
  return varying.length ? varying : groups.filter(({names}) => names.length);
}

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
  const isAtOnce = !isVarying(rows, 0);  // of a static solver, whose time stands still
  for (const {title, x, xName, names, log = false, goal} of historyGroups(columns, rows)) {
    const base = columns.indexOf(x || (isAtOnce ? "steps" : "t")), numbers = names.map((name) => columns.indexOf(name));
    const some = rows.map((row) => [row[base], ...numbers.map((k) => row[k])]).filter((row) => Number.isFinite(row[0]));
    const drawn = some.flatMap((row) => row.slice(1)).filter((value) => Number.isFinite(value) && (value > 0 || !log));
    if (!drawn.length) continue;
    const [least, most] = drawn.reduce(([low, high], value) => [Math.min(low, value), Math.max(high, value)], [Infinity, -Infinity]);
    const plot = {title, names, rows: some, log: log && most > 10 * least, choosesLog: true, goal: goal && goals[goal]};
    if (x) chart(grid, {...plot, x: xName, winds: true});
    else all.push(chart(grid, {...plot, x: isAtOnce ? "steps of the solver" : "t [s]", onZoom}));
  }
}

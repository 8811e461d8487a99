// --- tables that can be sorted, and what is shown of comparisons and convergence studies ---

// columns: [{name, of: (row) → number or text, text: (row) → what is shown, node: (row) → an element instead}]
function sortableTable(parent, label, columns, rows, first = null) {
  const body = element("tbody"), heads = [];
  let by = first, upwards = true;
  const isNumber = columns.map((column) => rows.every((row) => typeof column.of(row) !== "string"));
  function fill() {
    const sorted = [...rows];
    if (by !== null) {
      const {of} = columns[by], none = (value) => value === null || value === undefined || Number.isNaN(value);
      sorted.sort((a, b) => {  // what has no value stays below
        const [one, other] = [of(a), of(b)];
        if (none(one) || none(other)) return none(one) - none(other);
        return (one < other ? -1 : one > other ? 1 : 0) * (upwards ? 1 : -1);
      });
    }
    heads.forEach((head, k) => {
      head.setAttribute("aria-sort", k === by ? (upwards ? "ascending" : "descending") : "none");
      head.querySelector("span").textContent = k === by ? (upwards ? " ▲" : " ▼") : "";
    });
    body.replaceChildren(...sorted.map((row) => element("tr", {}, ...columns.map((column, k) =>
      element(k === 0 ? "th" : "td", {class: isNumber[k] && "number", scope: k === 0 && "row"},
              column.node ? column.node(row) : (column.text || ((one) => short(column.of(one), 3)))(row))))));
  }
  columns.forEach((column, k) => {
    const button = element("button", {type: "button"}, column.name, element("span", {"aria-hidden": "true"}));
    button.addEventListener("click", () => {
      upwards = by === k ? !upwards : true;
      by = k;
      fill();
    });
    heads.push(element("th", {scope: "col", class: isNumber[k] && "number"}, button));
  });
  fill();
  const table = element("table", {class: "sortable", "aria-label": label}, element("thead", {}, element("tr", {}, ...heads)), body);
  parent.append(element("p", {class: "faint"}, `${label}. A click on a heading sorts by it.`));
  parent.append(element("div", {class: "scroll", tabindex: 0, role: "region", "aria-label": label}, table));
}

// Lines with an x of their own each become rows over all x.
function rowsOf(lines) {
  const all = new Map();
  lines.forEach((line, k) => {
    for (const [x, y] of line) {
      if (!all.has(x)) all.set(x, [x, ...lines.map(() => null)]);
      all.get(x)[k + 1] = y;
    }
  });
  return [...all.values()].sort((a, b) => a[0] - b[0]);
}

function showComparison(data, page) {
  const c = data.comparison, arrived = c.runs.filter((run) => run.status === "converged");
  const cost = (run) => run.total_s ?? Infinity;
  const best = (figure) => arrived.reduce((least, run) => !least || figure(run) < figure(least) ? run : least, null);
  const quickest = best(cost), fewest = best((run) => run.evaluations), aim = c.goal_of === "residual" ? "a residual" : "an error";
  verdict(page, arrived.length === 0 ? "bad" : "good",
    c.transient ? `${arrived.length} of ${c.runs.length} ways came to the end time with an error below 1`
                : `${arrived.length} of ${c.runs.length} ways came to ${aim} of ${short(c.goal)}`, [
      quickest && quickest.total_s !== null && `The quickest: ${quickest.label}, ${seconds(quickest.total_s)} with its set-up.`,
      fewest && `The fewest force evaluations: ${fewest.label}, ${short(fewest.evaluations)}` +
        (fewest.over_lower_bound ? `, ${short(fewest.over_lower_bound, 3)} of the Chebyshev estimate ½ √κ ln(2/ε).` : "."),
      `Errors are measured against: ${c.reference}, itself balanced to ${short(c.reference_residual, 3)}.`,
      c.ramp_difference !== null && `One load step of Newton's method differs from a slow ramp by ${short(c.ramp_difference, 3)}.`,
    ]);

  const made = section(page, "Speed against error", "speed");
  const byResidual = c.goal_of === "residual", figure = byResidual ? 2 : 1;
  const ranked = [...c.runs].sort((a, b) => (a.status !== "converged") - (b.status !== "converged") || cost(a) - cost(b));
  const withLine = (run) => run.samples.length > 0 || run.status === "converged";
  const drawn = new Set(ranked.filter(withLine).slice(0, 6));
  const cheap = element("select", {}, element("option", {value: "evaluations"}, "force evaluations"), element("option", {value: "time"}, "time of the steps"));
  made.append(element("div", {class: "tools"}, element("label", {}, "Against", cheap)));
  const holder = element("div", {class: "charts"});
  made.append(holder);
  const lineOf = (run) => {
    const points = run.samples.filter((one) => one[0] > 0 && one[figure] > 0).map((one) => [one[0], one[figure]]);
    const end = byResidual ? run.residual : run.error;
    if (run.status === "converged" && run.evaluations > 0 && (!points.length || points.at(-1)[0] < run.evaluations))
      points.push([run.evaluations, end > 0 ? end : c.goal]);
    if (cheap.value === "evaluations") return points;
    return run.wall_s && run.evaluations ? points.map(([x, y]) => [x * run.wall_s.median / run.evaluations, y]) : [];
  };
  const xName = () => cheap.value === "time" ? "time [s]" : "force evaluations";
  const what = () => {
    const runs = ranked.filter((run) => drawn.has(run));
    return [rowsOf(runs.map(lineOf)), runs.map((run) => run.label), runs.map((run) => ranked.indexOf(run))];
  };
  const [rows, names, numbers] = what();
  const plot = chart(holder, {title: byResidual ? "Residual ‖F − R‖/‖F‖" : "Relative error ‖u − u*‖/‖u*‖", x: "cost", names, rows, numbers,
                              log: true, logX: true, points: true, wide: true, goal: c.goal});
  const redraw = () => { if (drawn.size) plot.update(...what(), {xlabel: xName()}); };
  redraw();
  cheap.addEventListener("change", redraw);

  const box = (run) => {
    const made = element("input", {type: "checkbox", checked: drawn.has(run), disabled: !withLine(run)});
    made.addEventListener("change", () => {
      if (made.checked) drawn.add(run);
      else if (drawn.size > 1) drawn.delete(run);
      else made.checked = true;
      redraw();
    });
    return element("label", {}, made, run.label);
  };
  made.append(element("p", {class: "faint"}, "A tick in the table below draws a way as a line."));
  sortableTable(made, "The ways to rest that were compared", [
    {name: "way", of: (run) => run.label, node: box},
    {name: "status", of: (run) => run.status, text: (run) => run.status},
    {name: "evaluations", of: (run) => run.evaluations},
    {name: "× estimate", of: (run) => run.status === "converged" ? run.over_lower_bound : null},
    {name: "set-up", of: (run) => run.setup_s || null, text: (run) => seconds(run.setup_s || null)},
    {name: "steps", of: (run) => run.wall_s ? run.wall_s.median : null, text: (run) => seconds(run.wall_s ? run.wall_s.median : null)},
    {name: "in all", of: (run) => run.total_s, text: (run) => seconds(run.total_s)},
    {name: "error", of: (run) => run.error},
    {name: "residual", of: (run) => run.residual},
    {name: "error bound", of: (run) => run.distance},
    {name: "memory", of: (run) => run.memory_bytes || null, text: (run) => bytes(run.memory_bytes)},
  ], ranked, c.transient ? 7 : 6);
  const reasons = ranked.filter((run) => run.status !== "converged" && run.reason);
  if (reasons.length) {
    made.append(element("h3", {}, "Why others did not come to it"));
    made.append(element("ul", {}, ...reasons.map((run) => element("li", {}, `${run.label}: ${run.status}, ${run.reason}`))));
  }

  const model = section(page, "Model", "model");
  facts(model, [
    ["Body", `${short(c.points)} material points, ${short(c.dofs)} degrees of freedom`],
    ["Frequencies", c.omega_1 === null ? null : `ω₁ ${short(c.omega_1, 6)}, ω_max ${short(c.omega_max, 6)} rad/s, κ = ${short(c.kappa)}`],
    ["Chebyshev estimate", c.lower_bound === null ? null : `${short(Math.round(c.lower_bound))} evaluations for an error of ${short(c.goal)}`],
    ["Threads", `${c.threads}${c.chooses_threads ? ", or one where that is quicker" : ""}`],
    ["Wall time", `${seconds(c.wall_s)}, ${seconds(c.timed_s)} of it timed runs`],
  ]);
  notes(model, c.notes);
  versions(page, c.versions);
  sceneText(page, data.scene);
}

const SIZES = {h: "h [m]", points: "1/points per cell", step: "step [s]", motion: "max_motion [cells]"};  // what is refined

function orderWords(order) {
  if (!order) return "no order is known";
  return `order ${order.order.toFixed(2)}` + (order.low === null ? "" : ` (${order.low.toFixed(2)} to ${order.high.toFixed(2)}, 95 %)`) +
    (order.theory === null ? "" : `, in theory ${short(order.theory, 3)}`);
}

// Below the smallest errors that have it: each order that theory knows, or else the whole one nearest to what was measured.
// lines: [[name, series, quantity, [[size, error]…]]]
function orderLines(lines) {
  const lowest = new Map();
  for (const [, series, quantity, points] of lines) {
    if (points.length < 2) continue;
    const order = series.orders[quantity], [[x1, y1], [x2, y2]] = points.slice(-2);
    const beside = order && order.theory ? order.theory : Math.max(1, Math.round(order ? order.order : Math.log(y1 / y2) / Math.log(x1 / x2)));
    if (!lowest.has(beside) || points.at(-1)[1] < lowest.get(beside).at(-1)[1]) lowest.set(beside, points);
  }
  return [...lowest].map(([order, points]) => ({
    order, from: points.at(-1)[0], to: points[0][0], at: points.reduce((least, [x, y]) => Math.min(least, y / x ** order), Infinity)}));
}

function showConvergence(data, page) {
  const study = data.study, all = study.series || [study];
  const called = (series) => series.set ? series.set.join(", ") : "";
  const levels = all.flatMap((series) => series.levels), wrong = levels.filter((level) => level.status === "failed" || level.status === "diverged");
  const open = levels.filter((level) => !["equilibrium", "end-time", "limit-load"].includes(level.status));
  const sentences = all.flatMap((series) => Object.entries(series.orders).map(([name, order]) =>
    `${called(series) && `${called(series)}: `}${name} has ${orderWords(order)}.`));
  verdict(page, wrong.length ? "bad" : open.length ? "doubt" : "good",
    wrong.length ? `${wrong.length} of ${levels.length} levels went wrong`
                 : open.length ? `${open.length} of ${levels.length} levels did not come to their end` : `All ${levels.length} levels came to their end`,
    [`Errors are measured against: ${all[0].reference || "nothing"}.`, ...sentences.slice(0, 8),
     all[0].dominant && `The largest error of the finest level but one: ${all[0].dominant}.`]);

  const made = section(page, "Error against size", "size");
  const holder = element("div", {class: "charts"});
  made.append(holder);
  const size = all[0].refined[0];
  const quantities = [...new Set(all.flatMap((series) => Object.keys(series.quantities)))];
  // One series: its quantities in one plot; several: a plot of each quantity.
  const plots = all.length === 1 ? [{title: "Errors", lines: quantities.map((name) => [name, all[0], name])}]
                                 : quantities.map((name) => ({title: `Error of ${name}`, lines: all.map((series) => [called(series), series, name])}));
  for (const {title, lines} of plots) {
    const some = lines.map(([label, series, name]) => [label, series, name, series.quantities[name] ?
      series.levels.map((level, k) => [level.size, series.quantities[name].errors[k]]).filter(([x, y]) => x > 0 && y > 0) : []])
      .filter(([, , , points]) => points.length);
    if (!some.length) continue;
    chart(holder, {title, x: SIZES[size] || size, names: some.map(([label]) => label), rows: rowsOf(some.map(([, , , points]) => points)),
                   slopes: orderLines(some), log: true, logX: true, points: true, wide: plots.length === 1});
  }
  if (!holder.children.length) holder.append(element("p", {}, "No error is known on any level."));

  const rows = all.flatMap((series) => series.levels.map((level, k) => ({series, level, k})));
  const columns = [
    {name: "level", of: (row) => row.k + 1},
    {name: SIZES[size] || size, of: (row) => row.level.size},
    {name: "points", of: (row) => row.level.points},
    {name: "evaluations", of: (row) => row.level.evaluations},
    {name: "time", of: (row) => row.level.wall_s, text: (row) => seconds(row.level.wall_s)},
    ...quantities.map((name) => ({name, of: (row) => row.series.quantities[name] ? row.series.quantities[name].errors[row.k] : null})),
    {name: "status", of: (row) => row.level.status, text: (row) => row.level.status},
  ];
  if (all.length > 1) columns.splice(1, 0, {name: "series", of: (row) => called(row.series), text: (row) => called(row.series)});
  sortableTable(made, "The levels and their errors", columns, rows);

  const orders = section(page, "Observed orders", "orders");
  sortableTable(orders, "Observed orders, with their 95 % intervals", [
    {name: "quantity", of: (row) => row.name, text: (row) => row.name},
    ...(all.length > 1 ? [{name: "series", of: (row) => called(row.series), text: (row) => called(row.series)}] : []),
    ...[["order", "order"], ["from", "low"], ["to", "high"]].map(([name, key]) =>
      ({name, of: (row) => row.order ? row.order[key] : null, text: (row) => row.order && row.order[key] !== null ? row.order[key].toFixed(2) : "–"})),
    {name: "theory", of: (row) => row.order ? row.order.theory : null},
    {name: "levels", of: (row) => row.order ? row.order.levels.join(" to ") : "–", text: (row) => row.order ? row.order.levels.join(" to ") : "–"},
    {name: "extrapolated", of: (row) => row.series.quantities[row.name].extrapolated, text: (row) => short(row.series.quantities[row.name].extrapolated, 8)},
  ], all.flatMap((series) => Object.keys(series.quantities).map((name) => ({series, name, order: series.orders[name]}))));
  for (const series of all) {
    if (series.sources.length) {
      orders.append(element("p", {}, `${called(series) && `${called(series)}: `}How far ${series.sources_of} moves if one thing alone is refined: ` +
        series.sources.map((source) => `${source.name} ${short(source.change, 2)}`).join(", ") + "."));
    }
    notes(orders, series.notes.map((note) => (called(series) ? `${called(series)}: ${note}` : note)));
  }
  versions(page, study.versions);
  sceneText(page, data.scene);
}

function showSafety(data, page) {
  const study = data.study, trials = [...study.verdicts].sort((a, b) => a.factor - b.factor);
  const low = study.factor_low, high = study.factor_high;
  const end = (factor) => trials.find((trial) => trial.factor === factor);
  verdict(page, study.found ? "good" : "doubt",
    low === null ? "No factor is at rest"
    : high === null ? `At rest up to ${short(low)}; no factor that moves was found`
    : `The factor of safety lies between ${short(low)} and ${short(high)}${study.found ? "" : ", wider than was asked"}`, [
      low !== null && `${short(low)} rests: ${end(low).reason}.`,
      high !== null && `${short(high)} moves: ${end(high).reason}.`,
    ]);

  const made = section(page, "Displacement against factor", "factors");
  const holder = element("div", {class: "charts"});
  made.append(holder);
  const lines = ["rests", "moves", "undecided"].map((name) => [name, trials.filter((trial) => trial.verdict === name && trial.displacement > 0)
    .map((trial) => [trial.factor, trial.displacement])]).filter(([, points]) => points.length);
  if (lines.length)
    chart(holder, {title: "Largest displacement since the first factor [m]", x: "factor", names: lines.map(([name]) => name),
                   rows: rowsOf(lines.map(([, points]) => points)), log: true, choosesLog: true, points: true, wide: true});
  sortableTable(made, "The factors that were tried", [
    {name: "factor", of: (row) => row.factor, text: (row) => short(row.factor, 6)},
    {name: "verdict", of: (row) => row.verdict, text: (row) => row.verdict},
    {name: "displacement [m]", of: (row) => row.displacement},
    {name: "evaluations", of: (row) => row.evaluations},
    {name: "time", of: (row) => row.wall_s, text: (row) => seconds(row.wall_s)},
    {name: "reason", of: (row) => row.reason, text: (row) => row.reason},
  ], trials, 0);

  if (data.mechanism) {
    const picture = section(page, `The mechanism at ${short(data.mechanism.factor)}`, "mechanism");
    picture.append(element("p", {}, "What moves since the equilibrium with the first factor; its size is that of the time it was followed."));
    bodyPicture(picture, data.mechanism.picture);
  }
  const model = section(page, "Model", "model");
  facts(model, [["Wall time", seconds(study.wall_s)], ["Width asked for", short(study.width)]]);
  notes(model, study.notes);
  versions(page, study.versions);
  sceneText(page, data.scene);
}

// --- elements, numbers, and what is shown of a run ---

// element("p", {class: "faint"}, "text", another)
function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (value !== null && value !== undefined && value !== false) made.setAttribute(key, value === true ? "" : value);
  }
  made.append(...children.filter((child) => child !== null && child !== undefined));
  return made;
}

// As many digits as tell something: "0.00958", "1.06e-9", "28 800".
function short(value, digits = 4) {
  if (value === null || value === undefined || Number.isNaN(value)) return "–";
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (Number.isInteger(value) && size < 1e15) return value.toLocaleString("en").replaceAll(",", " ").replace("-", "−");
  const text = size < 1e-3 || size >= 1e6 ? value.toExponential(digits - 1).replace(/\.?0+e/, "e").replace("e+", "e")
                                          : String(Number(value.toPrecision(digits)));
  return text.replaceAll("-", "−");
}

function seconds(value) {
  if (value === null || value === undefined) return "–";
  if (value < 1e-3) return `${short(1e6 * value, 3)} µs`;
  return value < 1 ? `${short(1e3 * value, 3)} ms` : `${short(value, 3)} s`;
}

function bytes(value) {
  if (!value) return "–";
  return value < 1e6 ? `${short(value / 1e3, 3)} kB` : value < 1e9 ? `${short(value / 1e6, 3)} MB` : `${short(value / 1e9, 3)} GB`;
}

function section(parent, title, id) {
  const made = element("section", {"aria-labelledby": id}, element("h2", {id}, title));
  parent.append(made);
  return made;
}

// Rows of [name, value]; those without a value are left out.
function facts(parent, rows) {
  const body = element("tbody");
  for (const [name, value] of rows) {
    if (value === null || value === undefined || value === "") continue;
    body.append(element("tr", {}, element("th", {scope: "row"}, name), element("td", {}, value)));
  }
  parent.append(element("table", {class: "facts"}, body));
}

function notes(parent, list) {
  if (!list.length) return;
  parent.append(element("h3", {}, list.length === 1 ? "A note" : "Notes"));
  parent.append(element("ul", {}, ...list.map((note) => element("li", {}, note))));
}

function verdict(parent, kind, words, sentences) {
  const sign = {good: "✓", doubt: "!", bad: "✗"}[kind];
  parent.append(element("div", {class: `verdict ${kind}`, role: "status"},
    element("p", {}, element("strong", {}, `${sign} ${words}`)),
    ...sentences.filter((sentence) => sentence).map((sentence) => element("p", {}, sentence))));
}

function versions(parent, list) {
  const made = section(parent, "Versions", "versions");
  facts(made, Object.entries(list));
}

function sceneText(parent, scene) {
  if (!scene || !scene.text) return;
  const made = section(parent, "The scene", "scene");
  if (scene.set.length) {
    made.append(element("p", {}, "Its text, over which these were set:"));
    made.append(element("ul", {}, ...scene.set.map((set) => element("li", {}, element("code", {}, set)))));
  }
  made.append(element("pre", {tabindex: 0, role: "region", "aria-label": "Text of the scene"}, scene.text));
}

// --- a run ---

function runVerdict(parent, s, goals) {
  const asked = s.exit_status === 0;
  const words = {
    "equilibrium": "In equilibrium",
    "unstable-equilibrium": "In equilibrium, but an unstable one",
    "limit-load": "At the limit load",
    "end-time": asked ? "At the end time, as asked" : "Not in equilibrium when its time was over",
    "step-limit": asked ? "All steps taken, as asked" : "Not in equilibrium within the steps allowed",
    "time-limit": "Not in equilibrium within the wall time allowed",
    "interrupted": "Interrupted before its end",
    "diverged": "Diverged: this is no answer",
    "failed": "Failed: this is no answer",
  }[s.status] || s.status;
  const kind = asked ? "good" : s.exit_status === 3 ? "doubt" : "bad";
  let bound;
  if (s.distance !== null) {
    bound = s.distance_kind === "bound"
      ? `Error bound: it is within ${short(s.distance, 3)} of its equilibrium, ‖u − u*‖/‖u‖ ≤ ${short(s.distance, 3)}.`
      : `Distance from equilibrium: about ${short(s.distance, 3)} of the displacement, an estimate by the tangent at ` +
        "the end" + (s.way_left === null ? ", no bound." : `, no bound. It yields or slides, and by its own decay its motion would still go ${short(s.way_left, 2)} of the displacement at most.`);
  } else {
    bound = "Error bound: none. " + (s.status === "equilibrium" || goals.residual > 0
      ? "It takes the lowest frequency ω₁ in a single phase, which is not known here; the residual says how far forces are out of balance."
      : "The scene asks for no equilibrium.");
  }
  const exact = s.error && `Against the exact solution: u is off by ${short(s.error.u_rel_l2, 3)} (L2) and ` +
    `${short(s.error.u_rel_max, 3)} at most` +
    (s.error.stress_rel_l2 === null ? "." : `, the stress by ${short(s.error.stress_rel_l2, 3)} (L2).`);
  verdict(parent, kind, words, [
    s.reason && `Why it ended: ${s.reason}.`,
    bound,
    s.residual === null ? null : `Out-of-balance force: ‖F − R‖/‖F‖ = ${short(s.residual, 3)}` +
      (goals.residual > 0 ? `, asked for ${short(goals.residual, 3)}.` : "."),
    exact,
    `Exit status ${s.exit_status}: ${asked ? "as the scene asks." : s.exit_status === 3 ? "not what the scene asks for, within its limits."
                                                                    : "it went wrong; what is shown is what it had until then."}`,
  ]);
}

function vector(components) {
  return `(${Object.values(components).map((value) => short(value, 6)).join(", ")})`;
}

function runFacts(parent, s) {
  const made = section(parent, "Summary", "summary");
  const unit = (value, name, digits) => value === null ? null : `${short(value, digits)} ${name}`;
  const rows = [
    ["Reached", s.t === null ? null : `t = ${short(s.t, 6)} s in ${short(s.steps)} steps` +
      (s.rejected_steps ? `, ${short(s.rejected_steps)} more rejected` : "")],
    ["Force evaluations", short(s.rhs_evaluations)],
    ["Wall time", `${seconds(s.wall_s)}, ${s.threads} thread${s.threads === 1 ? "" : "s"}` +
      (s.ns_per_point_step ? `, ${short(s.ns_per_point_step, 3)} ns a point and step` : "")],
    ["Kinetic energy", unit(s.kinetic_energy, "J")],
    ["External work", unit(s.external_work, "J")],
    ["Stability", s.stability],
    ["Slope angle", unit(s.slope_angle, "°")],
    ["Load factor", s.load && `${short(s.load.factor, 6)}, the largest ${short(s.load.largest_factor, 6)}, ` +
      `at a mean displacement of ${short(s.load.displacement)} m`],
  ];
  s.ended_stages.forEach((stage, k) => rows.push([`Stage ${k + 1}`,
    `t = ${short(stage.begin, 6)} to ${short(stage.end, 6)} s, ` +
      `${stage.status === "end-time" ? "ended before an equilibrium" : stage.status}, residual ${short(stage.residual, 3)}`]));
  for (const [name, fields] of Object.entries(s.probes)) {
    const place = s.probe_places[name];
    rows.push([`Probe ${name}`, Object.entries(fields).map(([field, value]) => `${field} = ${short(value, 7)}`).join(", ") +
      (place ? `, at x = ${place.map((x) => short(x, 6)).join(", ")} m` : "")]);
  }
  for (const [name, force] of Object.entries(s.reactions)) rows.push([`Reaction of ${name}`, `${vector(force)} N`]);
  for (const [name, moment] of Object.entries(s.reaction_moments)) rows.push([`Moment of ${name}`, `${vector(moment)} N m`]);
  for (const weak of s.weak_supports) {
    rows.push([`Weak ${weak.support}`, `gives way by ${short(weak.gap, 3)} m, ${short(weak.share, 2)} of the largest displacement`]);
  }
  rows.push(
    ["Plastic strain against the forces", s.plastic_overshoot === null ? null : short(s.plastic_overshoot, 3)],
    ["Damping and inertia in the reactions", s.rate_share === null ? null : short(s.rate_share, 3)],
    ["At rest, on average, and held by at most", s.resting_points === null ? null
      : `${short(100 * s.resting_points, 3)} % of the points, ${short(100 * s.held_force, 2)} % of the forces around them`],
    ["Plastic work out of balance", s.unbalanced_plastic_work === null ? null : short(s.unbalanced_plastic_work, 3)],
    ["Mass, momentum, angular momentum off by", s.mass_error === null ? null
      : [s.mass_error, s.momentum_error, s.angular_momentum_error].map((value) => short(value, 2)).join(", ")]);
  facts(made, rows);
}

function modelFacts(parent, s) {
  const made = section(parent, "Model", "model");
  facts(made, [
    ["Body", s.points ? `${short(s.points)} material points, ${short(s.dofs)} degrees of freedom, ${s.phases} phase${s.phases === 1 ? "" : "s"}` : null],
    ["Memory", s.bytes_per_point ? `${short(s.bytes_per_point, 3)} bytes a point` : null],
    ["Method", [s.method, s.integrator, s.damping && `damping ${s.damping}`].filter((word) => word).join(", ")],
    ["Damping c", s.c === null ? null : short(s.c, 6)],
    ["Step", s.dt ? `${short(s.dt)} s` + (s.critical_step ? `, the critical one ${short(s.critical_step)} s` : "") : null],
    ["Frequencies", `ω₁ ${s.omega_1 === null ? "not needed" : short(s.omega_1, 6)}, ω_max ${short(s.omega_max, 6)} rad/s` +
      (s.omega_1 && s.omega_max ? `, κ = ${short((s.omega_max / s.omega_1) ** 2)}` : "")],
  ]);
  notes(made, s.notes);
}

function showRun(data, page) {
  const s = data.summary;
  runVerdict(page, s, data.goals);
  const pictures = data.picture && section(page, "The body", "body");
  const asksForSlope = Object.values(s.probes).some((fields) => "slope_angle" in fields);
  if (pictures) bodyPicture(pictures, data.picture, asksForSlope ? s.stages : []);
  if (data.lacks_memory) page.append(element("p", {}, "No memory was left for a picture of the body."));
  if (data.history) historyCharts(page, data.history, data.goals);
  runFacts(page, s);
  modelFacts(page, s);
  versions(page, s.versions);
  sceneText(page, data.scene);
}

function show(data, page) {
  page.append(element("h1", {}, document.title));
  ({run: showRun, compare: showComparison, converge: showConvergence, safety: showSafety})[data.kind](data, page);
  document.documentElement.dataset.drawn = performance.now().toFixed(0);  // [ms] since the page was opened
}

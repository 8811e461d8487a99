// --- the material points at the stages of a run ---

const DIGITS = new Uint8Array(128);
[..."ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/"].forEach((digit, k) => { DIGITS[digit.charCodeAt(0)] = k; });

// Two letters a number (body_picture.hpp).
function numbersOf(text, min, max) {
  const values = new Float32Array(text.length / 2);
  for (let k = 0; k < values.length; ++k) {
    const code = 64 * DIGITS[text.charCodeAt(2 * k)] + DIGITS[text.charCodeAt(2 * k + 1)];
    values[k] = code === 4095 ? NaN : min + (max - min) * code / 4094;
  }
  return values;
}

// Viridis [van der Walt, Smith 2015]: the lighter, the larger, also where there is no colour.
const VIRIDIS = ["440154", "482878", "3e4989", "31688e", "26828e", "1f9e89", "35b779", "6ece58", "b5de2b", "fde725"]
  .map((hex) => [0, 2, 4].map((k) => parseInt(hex.slice(k, k + 2), 16)));
const SHADE_PARTS = Array.from({length: 64}, (_, k) => {
  const at = k / 63 * (VIRIDIS.length - 1), low = Math.min(Math.floor(at), VIRIDIS.length - 2);
  return VIRIDIS[low].map((part, c) => Math.round(part + (VIRIDIS[low + 1][c] - part) * (at - low)));
});
const SHADES = SHADE_PARTS.map((parts) => `rgb(${parts.join(",")})`);
const UNKNOWN = [153, 153, 153];  // the grey of what is no number
const LIGHTS = 24;                // levels of brightness

// The fields that can be shown: {name, of: (moment) → values}; what is computed of components is kept. Where something has
// yielded, the plastic strain is the first.
function fieldsOf(picture, x) {
  const names = picture.fields.map((field) => field.name), dim = picture.dim;
  const decoded = picture.moments.map(() => new Map());
  const stored = (m, name) => {
    const k = names.indexOf(name);
    if (!decoded[m].has(name)) decoded[m].set(name, numbersOf(picture.moments[m].values[k], picture.fields[k].min, picture.fields[k].max));
    return decoded[m].get(name);
  };
  const computed = (m, name, parts, formula) => {
    if (!decoded[m].has(name)) {
      const columns = parts.map((part) => stored(m, part)), values = new Float32Array(columns[0].length);
      for (let p = 0; p < values.length; ++p) values[p] = formula(columns, p);
      decoded[m].set(name, values);
    }
    return decoded[m].get(name);
  };
  const length = (columns, p) => Math.sqrt(columns.reduce((sum, column) => sum + column[p] ** 2, 0));
  const u = names.filter((name) => name === "u" || name.startsWith("u."));
  const stress = names.filter((name) => name.startsWith("stress"));
  const list = [];
  if (dim > 1) list.push({name: "displacement |u| [m]", of: (m) => computed(m, "|u|", u, length)});
  for (const name of u) list.push({name: `${name} [m]`, of: (m) => stored(m, name)});
  const yields = picture.fields.some((field) => field.name === "plastic_strain" && field.max > 0);
  for (const name of names.slice(u.length + 1 + stress.length)) {
    const field = {name: name.replaceAll("_", " "), of: (m) => stored(m, name)};
    if (yields && name === "plastic_strain") list.unshift(field);
    else list.push(field);
  }
  if (dim > 1) {
    const normal = ["stress.xx", "stress.yy", "stress.zz"], shear = stress.filter((name) => !normal.includes(name));
    list.push({name: "mean stress [Pa]", of: (m) => computed(m, "mean", normal, ([a, b, c], p) => (a[p] + b[p] + c[p]) / 3)});
    list.push({name: "von Mises stress [Pa]", of: (m) => computed(m, "mises", [...normal, ...shear], ([a, b, c, ...t], p) =>
      Math.sqrt(((a[p] - b[p]) ** 2 + (b[p] - c[p]) ** 2 + (c[p] - a[p]) ** 2) / 2 + 3 * length(t, p) ** 2))});
  }
  for (const name of stress) list.push({name: `${name} [Pa]`, of: (m) => stored(m, name)});
  list.push({name: dim > 1 ? "speed |v| [m/s]" : "v [m/s]", of: (m) => stored(m, "v")});
  if (dim > 1) list.push({name: "height at the start [m]", of: () => x[1]});
  return {list, u: (m) => u.map((name) => stored(m, name))};
}

const stageWords = (picture, slopes, m) => {
  const t = picture.moments[m].t, slope = slopes.find((one) => one.t === t);
  return `t = ${short(t, 5)} s, ${m + 1} of ${picture.moments.length}` +
    (slope && slope.slope_angle !== null ? `, slope angle ${short(slope.slope_angle, 3)}°` : "");
};

// slopes: [{t, slope_angle}] of the stages, where the scene asks for that angle.
function bodyPicture(parent, picture, slopes = []) {
  if (!picture.moments.length || !picture.drawn) return;
  const x = picture.x.map((axis) => numbersOf(axis.values, axis.min, axis.max));
  const {list, u} = fieldsOf(picture, x);
  const last = picture.moments.length - 1;
  const slider = element("input", {type: "range", min: 0, max: last, step: 1, value: last, "aria-label": "Stage"});
  const said = element("output", {}, "");
  const choice = element("select", {}, ...list.map((field, k) => element("option", {value: k}, field.name)));
  const tools = element("div", {class: "tools"});
  if (last > 0) tools.append(element("label", {class: "stage"}, "Stage", slider, said));
  tools.append(element("label", {}, picture.dim > 1 ? "Colour by" : "Show", choice));
  parent.append(tools);
  const draw = (picture.dim === 1 ? linePicture : pointPicture)(parent, picture, {x, u, list}, tools);
  const update = () => {
    const m = Number(slider.value), words = stageWords(picture, slopes, m);
    said.textContent = words;
    slider.setAttribute("aria-valuetext", words);
    draw(m, Number(choice.value));
  };
  slider.addEventListener("input", update);
  choice.addEventListener("change", update);
  update();
  const words = [];
  if (picture.of_moments > picture.moments.length) words.push(`${picture.moments.length} of the ${short(picture.of_moments)} stages in fields.h5 are shown.`);
  if (picture.drawn < picture.points) {
    words.push(`${short(picture.drawn)} of ${short(picture.points)} material points are drawn` +
      (picture.dim === 3 ? ", those at the surface." : ", evenly chosen, so that this file stays small."));
  }
  if (picture.dim === 3) words.push("Light falls on the body from the eye, a little from above: what turns away is darker than its colour in the bar.");
  words.push("Numbers are drawn with three digits; fields.h5, where the scene asks for stages, and the probes in history.csv have all of them.");
  parent.append(element("p", {class: "faint"}, words.join(" ")));
}

// In one dimension a field is a line over the body.
function linePicture(parent, picture, body) {
  const order = Array.from(body.x[0].keys()).sort((a, b) => body.x[0][a] - body.x[0][b]);
  const holder = element("div", {class: "charts"});
  parent.append(holder);
  let drawn = null;
  return (m, k) => {
    const now = body.list[k].of(m), first = body.list[k].of(0);
    const rows = order.map((p) => [body.x[0][p], now[p], first[p]]);
    const names = [body.list[k].name, `at t = ${short(picture.moments[0].t, 4)} s`];
    if (drawn) drawn.update(rows, names);
    else drawn = chart(holder, {title: "Field along the body", x: "x at the start [m]", names, rows, log: false, points: picture.drawn < 200, wide: true});
  };
}

const niceStep = (range, most) => {
  const raw = range / most, power = 10 ** Math.floor(Math.log10(raw));
  return power * [1, 2, 5, 10].find((factor) => factor * power >= raw);
};

// By how much displacements can be enlarged: so that the largest is a few hundredths to a third of the body.
function enlargements(picture) {
  const size = Math.max(...picture.x.map((axis) => axis.max - axis.min));
  const largest = Math.max(...picture.fields.slice(0, picture.dim).map((field) => Math.max(Math.abs(field.min), Math.abs(field.max))));
  const shares = largest > 0 ? [0.03, 0.1, 0.3].map((share) => Number((share * size / largest).toPrecision(1))) : [];
  return [1, ...shares.filter((value) => value > 1)];
}

// In the plane and in space points are marks as large as what they stand for.
function pointPicture(parent, picture, body, tools) {
  const inSpace = picture.dim === 3, count = picture.drawn;
  const sizes = picture.sizes && picture.sizes.map((axis) => numbersOf(axis.values, axis.min, axis.max));
  const canvas = element("canvas", {class: inSpace ? "picture turns" : "picture", tabindex: 0, role: "img"});
  const factor = element("select", {}, ...enlargements(picture).map((value) => element("option", {value}, `× ${short(value)}`)));
  if (factor.length > 1) tools.append(element("label", {}, "Displacements", factor));
  const readout = element("p", {"aria-live": "polite"}), extremes = element("p", {class: "faint"});
  const ticks = element("div", {class: "ticks"});
  const scale = element("div", {class: "scale", role: "img"}, element("div", {class: "bar"}), ticks);
  scale.firstChild.style.background = `linear-gradient(to right, ${SHADES.join(",")})`;
  const view = {azimuth: -0.6, elevation: 0.45};
  if (inSpace) {
    const views = {"diagonal": [-0.6, 0.45], "front (x, y)": [0, 0], "side (z, y)": [-Math.PI / 2, 0], "top (x, z)": [0, Math.PI / 2]};
    const seen = element("select", {}, ...Object.keys(views).map((name) => element("option", {}, name)));
    seen.addEventListener("change", () => { [view.azimuth, view.elevation] = views[seen.value]; redraw(); });
    tools.append(element("label", {}, "Seen from", seen));
  }
  parent.append(canvas, scale, readout, extremes);

  let now = {m: 0, k: 0};
  const limits = new Map();  // of each field, over all moments: without the few that are far out
  function limitsOf(k) {
    if (limits.has(k)) return limits.get(k);
    const values = [];
    const every = Math.max(1, Math.floor(count * picture.moments.length / 20000));
    let least = Infinity, most = -Infinity;
    for (let m = 0; m < picture.moments.length; ++m) {
      const field = body.list[k].of(m);
      for (let p = 0; p < count; ++p) {
        if (!Number.isFinite(field[p])) continue;
        least = Math.min(least, field[p]); most = Math.max(most, field[p]);
        if (p % every === 0) values.push(field[p]);
      }
    }
    values.sort((a, b) => a - b);
    let [from, to] = [0.005, 0.995].map((share) => values[Math.floor(share * (values.length - 1))] ?? 0);
    if (most - least < 3 * (to - from) || !(to > from)) [from, to] = [least, most];
    if (!Number.isFinite(from)) [from, to] = [0, 0];
    limits.set(k, {from, to, least, most});
    return limits.get(k);
  }

  const normals = new Map();  // of each moment
  function normalsAt(m) {
    if (!normals.has(m)) {
      const u = body.u(m), places = body.x.map((axis, k) => axis.map((at, p) => at + u[k][p]));
      normals.set(m, normalsOf(places, picture.x, picture.mark.map((length, k) => length * (sizes ? picture.sizes[k].max : 1))));
    }
    return normals.get(m);
  }

  // A vector along the screen, upwards, and towards the eye.
  function turned(x, y, z) {
    const [ca, sa, ce, se] = [Math.cos(view.azimuth), Math.sin(view.azimuth), Math.cos(view.elevation), Math.sin(view.elevation)];
    const depth = ca * z - sa * x;
    return [ca * x + sa * z, ce * y - se * depth, se * y + ce * depth];
  }

  // How bright each point is, in LIGHTS levels.
  function lightOn(m) {
    const [x, y, z] = normalsAt(m), levels = new Uint8Array(count);
    for (let p = 0; p < count; ++p) levels[p] = Math.round((LIGHTS - 1) * brightness(...turned(x[p], y[p], z[p])));
    return levels;
  }

  // Where the points are drawn: along the screen, and towards the eye.
  function seen(m, enlarged) {
    const u = body.u(m), places = [new Float32Array(count), new Float32Array(count), new Float32Array(count)];
    const [ca, sa, ce, se] = [Math.cos(view.azimuth), Math.sin(view.azimuth), Math.cos(view.elevation), Math.sin(view.elevation)];
    for (let p = 0; p < count; ++p) {
      const X = body.x[0][p] + enlarged * u[0][p], Y = body.x[1][p] + enlarged * u[1][p];
      if (!inSpace) { places[0][p] = X; places[1][p] = Y; continue; }
      const Z = body.x[2][p] + enlarged * u[2][p], depth = ca * Z - sa * X;
      places[0][p] = ca * X + sa * Z; places[1][p] = ce * Y - se * depth; places[2][p] = se * Y + ce * depth;
    }
    return places;
  }
  function boxOf(enlarged) {
    const box = [Infinity, Infinity, -Infinity, -Infinity];
    for (let m = 0; m < picture.moments.length; ++m) {
      const [X, Y] = seen(m, enlarged);
      for (let p = 0; p < count; ++p) {
        if (!Number.isFinite(X[p]) || !Number.isFinite(Y[p])) continue;
        box[0] = Math.min(box[0], X[p]); box[1] = Math.min(box[1], Y[p]);
        box[2] = Math.max(box[2], X[p]); box[3] = Math.max(box[3], Y[p]);
      }
    }
    const half = picture.mark.map((length, k) => length / 2 * (sizes ? picture.sizes[k].max : 1));
    return [box[0] - half[0], box[1] - half[1], box[2] + half[0], box[3] + half[1]];
  }

  let frame = null;  // of the last drawing: what a pointer on it means
  let radius = 0;    // in space: the box stays as the body turns
  function redraw() {
    const enlarged = Number(factor.value), width = canvas.clientWidth || 600, narrow = width < 480;
    let box = boxOf(enlarged);
    if (inSpace) {
      if (radius === 0 || radius.of !== enlarged) {
        const sizes = [0, 1, 2].map((k) => picture.x[k].max - picture.x[k].min);
        radius = {of: enlarged, r: Math.max(0.4 * Math.hypot(...sizes), (box[2] - box[0]) / 2, (box[3] - box[1]) / 2)};
      }
      const [cx, cy] = [(box[0] + box[2]) / 2, (box[1] + box[3]) / 2];
      box = [cx - radius.r, cy - radius.r, cx + radius.r, cy + radius.r];
    }
    const left = inSpace ? 12 : narrow ? 40 : 56, right = 12, top = 12, bottom = inSpace ? 12 : 30;
    const pixels = Math.min((width - left - right) / (box[2] - box[0]), (inSpace ? 460 : 480) / (box[3] - box[1]));
    const height = Math.max(90, Math.ceil((box[3] - box[1]) * pixels)) + top + bottom;
    const ratio = window.devicePixelRatio || 1;
    canvas.style.height = `${height}px`;
    canvas.width = Math.round(width * ratio); canvas.height = Math.round(height * ratio);
    const c = canvas.getContext("2d");
    c.scale(ratio, ratio);
    c.fillStyle = "#ffffff"; c.fillRect(0, 0, width, height);
    const shift = (width - left - right - (box[2] - box[0]) * pixels) / 2;
    const toX = (X) => left + shift + (X - box[0]) * pixels, toY = (Y) => height - bottom - (Y - box[1]) * pixels;
    if (inSpace) drawDirections(c, height);
    else drawAxes(c, box, toX, toY, pixels, left + shift, height - bottom);

    const [X, Y, depth] = seen(now.m, enlarged), values = body.list[now.k].of(now.m), {from, to, least, most} = limitsOf(now.k);
    const sides = (p) => picture.mark.map((length, k) => length * (sizes ? sizes[k][p] : 1));
    const halfOf = (p) => inSpace ? [0, 0].fill(Math.max(0.8, 0.75 * Math.max(...sides(p)) * pixels)) : sides(p).map((length) => Math.max(0.6, 0.6 * length * pixels));
    let half = halfOf(0);
    const order = Array.from({length: count}, (_, p) => p);
    const shade = (p) => Number.isFinite(values[p]) ? Math.max(0, Math.min(63, Math.round(63 * (to > from ? (values[p] - from) / (to - from) : 0)))) : -1;
    if (inSpace) order.sort((a, b) => depth[a] - depth[b]);
    else order.sort((a, b) => shade(a) - shade(b));
    const light = inSpace ? lightOn(now.m) : null, paints = new Map();
    // The number of a paint; without light that of its shade.
    const paintOf = (p) => light ? LIGHTS * (shade(p) + 1) + light[p] : shade(p);
    function styleOf(number) {
      if (!light) return number < 0 ? "#999999" : SHADES[number];
      if (!paints.has(number)) {
        const of = Math.floor(number / LIGHTS) - 1;
        paints.set(number, inLight(of < 0 ? UNKNOWN : SHADE_PARTS[of], (number % LIGHTS) / (LIGHTS - 1)));
      }
      return paints.get(number);
    }
    let paint = null;
    c.save();
    c.setTransform(1, 0, 0, 1, 0, 0);  // whole pixels, or light would shine through between the marks
    for (const p of order) {
      const wanted = paintOf(p);
      if (wanted !== paint) c.fillStyle = styleOf(wanted);
      paint = wanted;
      if (sizes) half = halfOf(p);
      const x = toX(X[p]), y = toY(Y[p]), left = Math.floor((x - half[0]) * ratio), top = Math.floor((y - half[1]) * ratio);
      c.fillRect(left, top, Math.ceil((x + half[0]) * ratio) - left, Math.ceil((y + half[1]) * ratio) - top);
    }
    c.restore();
    frame = {X, Y, values, toX, toY, depth};
    tell(from, to, least, most, values);
  }

  function drawAxes(c, box, toX, toY, pixels, left, base) {
    c.strokeStyle = "#d5dae0"; c.fillStyle = "#3b444e"; c.font = "12px sans-serif"; c.lineWidth = 1;
    const range = [box[2] - box[0], box[3] - box[1]];
    const step = Math.max(niceStep(range[0], Math.max(2, range[0] * pixels / 70)), niceStep(range[1], Math.max(2, range[1] * pixels / 40)) / 2);
    for (let at = Math.ceil(box[0] / step) * step; at <= box[2] + 1e-9 * step; at += step) {
      c.beginPath(); c.moveTo(toX(at), toY(box[1])); c.lineTo(toX(at), toY(box[3])); c.stroke();
      c.textAlign = "center"; c.fillText(short(Number(at.toPrecision(6))), toX(at), base + 16);
    }
    for (let at = Math.ceil(box[1] / step) * step; at <= box[3] + 1e-9 * step; at += step) {
      c.beginPath(); c.moveTo(toX(box[0]), toY(at)); c.lineTo(toX(box[2]), toY(at)); c.stroke();
      c.textAlign = "right"; c.fillText(short(Number(at.toPrecision(6))), left - 6, toY(at) + 4);
    }
    c.textAlign = "left"; c.fillText("m", left - 18, base + 16);
  }

  // Where x, y and z point to.
  function drawDirections(c, height) {
    const [ca, sa, ce, se] = [Math.cos(view.azimuth), Math.sin(view.azimuth), Math.cos(view.elevation), Math.sin(view.elevation)];
    const ends = {x: [ca, se * sa], y: [0, ce], z: [sa, -se * ca]};
    c.strokeStyle = c.fillStyle = "#3b444e"; c.font = "13px sans-serif"; c.lineWidth = 1.5; c.textAlign = "center";
    for (const [name, [right, up]] of Object.entries(ends)) {
      c.beginPath(); c.moveTo(50, height - 45); c.lineTo(50 + 26 * right, height - 45 - 26 * up); c.stroke();
      c.fillText(name, 50 + 36 * right, height - 41 - 36 * up);
    }
  }

  const positionOf = (p) => `(${body.x.map((axis, k) => short(axis[p] + body.u(now.m)[k][p], 3)).join(", ")})`;
  function tell(from, to, least, most, values) {
    const name = body.list[now.k].name, parts = [0, 0.25, 0.5, 0.75, 1].map((share) => from + share * (to - from));
    ticks.replaceChildren(...parts.map((value, k) => element("span", {},
      (k === 0 && least < from ? "≤ " : k === 4 && most > to ? "≥ " : "") + short(value, 3))));
    scale.setAttribute("aria-label", `Scale of ${name}: dark is ${short(from, 3)}, light is ${short(to, 3)}`);
    let low = -1, high = -1;
    for (let p = 0; p < count; ++p) {
      if (!Number.isFinite(values[p])) continue;
      if (low < 0 || values[p] < values[low]) low = p;
      if (high < 0 || values[p] > values[high]) high = p;
    }
    const words = low < 0 ? `${name}: not known here` : `${name} at t = ${short(picture.moments[now.m].t, 5)} s: least ` +
      `${short(values[low], 3)} at ${positionOf(low)}, largest ${short(values[high], 3)} at ${positionOf(high)}`;
    extremes.textContent = words;
    canvas.setAttribute("aria-label", `The material points. ${words}. Arrow keys ${inSpace ? "turn the body" : "read values off"}.`);
  }

  // The value at the point next to a place on the canvas.
  function read(x, y) {
    let best = -1, distance = 144;
    for (let p = 0; p < count; ++p) {
      const d = (frame.toX(frame.X[p]) - x) ** 2 + (frame.toY(frame.Y[p]) - y) ** 2;
      if (d < distance - (inSpace && best >= 0 && frame.depth[p] < frame.depth[best] ? d : 0)) { best = p; distance = d; }
    }
    readout.textContent = best < 0 ? "" : `At ${positionOf(best)} m: ${body.list[now.k].name} = ${short(frame.values[best], 3)}`;
  }
  const hint = inSpace ? "Drag, or use the arrow keys, to turn the body; point at it to read values off." : "Point at the body, or use the arrow keys on it, to read values off.";
  readout.textContent = hint;

  let held = null, cursor = null;
  canvas.addEventListener("pointerdown", (event) => {
    if (inSpace) { held = [event.clientX, event.clientY]; canvas.setPointerCapture(event.pointerId); }
  });
  canvas.addEventListener("pointerup", () => { held = null; });
  canvas.addEventListener("pointermove", (event) => {
    if (held) {
      view.azimuth += (event.clientX - held[0]) / 150;
      view.elevation = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, view.elevation + (event.clientY - held[1]) / 150));
      held = [event.clientX, event.clientY];
      redraw();
      return;
    }
    const box = canvas.getBoundingClientRect();
    read(event.clientX - box.left, event.clientY - box.top);
  });
  canvas.addEventListener("pointerleave", () => { readout.textContent = hint; });
  canvas.addEventListener("keydown", (event) => {
    const move = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]}[event.key];
    if (!move) return;
    event.preventDefault();
    if (inSpace) {
      view.azimuth += 0.1 * move[0];
      view.elevation = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, view.elevation - 0.1 * move[1]));
      redraw();
      return;
    }
    const width = canvas.clientWidth, height = canvas.clientHeight;
    cursor = cursor || [width / 2, height / 2];
    cursor = [Math.max(0, Math.min(width, cursor[0] + move[0] * width / 60)), Math.max(0, Math.min(height, cursor[1] + move[1] * width / 60))];
    redraw();
    const c = canvas.getContext("2d");
    for (const [paint, thick] of [["#ffffff", 4], ["#000000", 2]]) {
      c.strokeStyle = paint; c.lineWidth = thick; c.beginPath();
      c.moveTo(cursor[0] - 8, cursor[1]); c.lineTo(cursor[0] + 8, cursor[1]);
      c.moveTo(cursor[0], cursor[1] - 8); c.lineTo(cursor[0], cursor[1] + 8); c.stroke();
    }
    read(...cursor);
  });
  factor.addEventListener("change", redraw);
  let width = 0;
  new ResizeObserver(() => { if (canvas.clientWidth !== width) { width = canvas.clientWidth; redraw(); } }).observe(canvas);
  return (m, k) => { now = {m, k}; width = canvas.clientWidth; redraw(); };
}

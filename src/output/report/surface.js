// --- light on the surface of a body in space ---

const MOST_VOXELS = 1e6;

// The grid of voxels around the points: {low, size, numbers}, three of each. A voxel is as large as what eight of the marks
// stand for, so that a layer of them has no holes. Points that have flown off are left outside.
function voxelsAround(places, first, marks) {
  const low = [], numbers = [];
  let size = marks.map((mark) => 2 * mark), many = Infinity;
  for (const coarser of [1, 1.5, 2, 3, 4, 6, 8, 12, 16]) {
    if (many <= MOST_VOXELS) break;
    size = marks.map((mark) => 2 * coarser * mark);
    for (let k = 0; k < 3; ++k) {
      const room = (first[k].max - first[k].min) / 2;
      let least = Infinity, most = -Infinity;
      for (const at of places[k]) {
        if (!(at >= first[k].min - room && at <= first[k].max + room)) continue;
        least = Math.min(least, at); most = Math.max(most, at);
      }
      if (least > most) [least, most] = [first[k].min, first[k].max];
      low[k] = least - marks[k] / 2 - 3 * size[k];
      numbers[k] = Math.ceil((most - least) / size[k]) + 7;
    }
    many = numbers[0] * numbers[1] * numbers[2];
  }
  return {low, size, numbers};
}

// 1 in the voxels that hold a point, and in those that such voxels enclose.
function solid(cells, {numbers}) {
  const [nx, ny, nz] = numbers, all = nx * ny * nz, found = new Float32Array(all).fill(1), filled = new Uint8Array(all);
  for (const cell of cells) if (cell >= 0) filled[cell] = 1;
  const stack = [0];
  found[0] = 0;
  while (stack.length) {
    const at = stack.pop(), i = at % nx, j = Math.floor(at / nx) % ny, k = Math.floor(at / (nx * ny));
    const visit = (next) => { if (found[next] && !filled[next]) { found[next] = 0; stack.push(next); } };
    if (i > 0) visit(at - 1);
    if (i < nx - 1) visit(at + 1);
    if (j > 0) visit(at - nx);
    if (j < ny - 1) visit(at + nx);
    if (k > 0) visit(at - nx * ny);
    if (k < nz - 1) visit(at + nx * ny);
  }
  return found;
}

// The mean with the neighbours along an axis, weighted 1 : 2 : 1; what is at the border is empty.
function smoothed(values, stride) {
  const made = new Float32Array(values.length);
  for (let at = stride; at < values.length - stride; ++at) made[at] = (values[at - stride] + 2 * values[at] + values[at + stride]) / 4;
  return made;
}

// Directions out of the body at its points, three arrays, of any length: down the density of the body. places: of the
// points; first: {min, max} of each axis at the start; marks: how long a mark is.
function normalsOf(places, first, marks) {
  const voxels = voxelsAround(places, first, marks), {low, size, numbers} = voxels, strides = [1, numbers[0], numbers[0] * numbers[1]];
  const count = places[0].length, cells = new Int32Array(count);
  for (let p = 0; p < count; ++p) {
    for (let k = 0; k < 3 && cells[p] >= 0; ++k) {
      const along = Math.floor((places[k][p] - low[k]) / size[k]);
      cells[p] = along >= 2 && along < numbers[k] - 2 ? cells[p] + along * strides[k] : -1;
    }
  }
  let density = solid(cells, voxels);
  for (const stride of [...strides, ...strides]) density = smoothed(density, stride);
  return strides.map((stride, k) => Float32Array.from(cells, (cell) => cell < 0 ? 0 : (density[cell - stride] - density[cell + stride]) / size[k]));
}

// How bright a place with this normal is, from 0 to 1; x to the right, y up, z towards the eye, from where the light comes,
// a little from above.
const LIGHT = [-0.2, 0.7, 0.68];
function brightness(x, y, z) {
  const length = Math.hypot(x, y, z);
  if (!(length > 0)) return 0.8;
  const facing = Math.max(0, 0.3 - z / length);  // what turns away would be a dark rim
  const light = (x * LIGHT[0] + y * LIGHT[1] + z * LIGHT[2]) / length + facing * LIGHT[2];
  return Math.max(0, Math.min(1, light / 0.92));
}

// A colour of three parts in this light: a little paler than it is, or darker.
const inLight = (parts, light) => `rgb(${parts.map((part) => Math.round(part * (0.5 + 0.5 * light) + 0.15 * light * (255 - part))).join(",")})`;

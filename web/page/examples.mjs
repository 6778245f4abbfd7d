// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces of our own making; Z is up.

/** A grid of u and v, both closed, and where its vertices are. */
function closedGrid(around, across, place) {
  const positions = new Float64Array(3 * around * across);
  const faces = new Uint32Array(6 * around * across);
  for (let i = 0; i < around; ++i) {
    for (let j = 0; j < across; ++j) {
      const at = i * across + j;
      positions.set(place((2 * Math.PI * i) / around, (2 * Math.PI * j) / across), 3 * at);
      const [next, above] = [((i + 1) % around) * across, (j + 1) % across];
      faces.set([at, next + j, next + above, at, next + above, i * across + above], 6 * at);
    }
  }
  return { positions, faces };
}

const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => a.map((x) => x / Math.hypot(...a));

function torus() {
  return closedGrid(72, 36, (u, v) => {
    const ring = 1 + 0.42 * Math.cos(v);
    return [ring * Math.cos(u), ring * Math.sin(u), 0.42 * Math.sin(v)];
  });
}

/** A tube about a trefoil. */
function knot() {
  const centre = (u) => [
    Math.sin(u) + 2 * Math.sin(2 * u), Math.cos(u) - 2 * Math.cos(2 * u), -Math.sin(3 * u),
  ];
  return closedGrid(160, 20, (u, v) => {
    const [here, after] = [centre(u), centre(u + 1e-4)];
    const along = unit(after.map((x, k) => x - here[k]));
    const out = unit(cross(along, [here[1], -here[0], 3]));
    const up = cross(along, out);
    return here.map((x, k) => x + 0.55 * (Math.cos(v) * out[k] + Math.sin(v) * up[k]));
  });
}

/** A sphere of quads with bumps of several sizes. */
function pebble() {
  const [rings, around] = [40, 60];
  const [positions, faces] = [[], []];
  for (let i = 0; i <= rings; ++i) {
    const pole = i === 0 || i === rings;
    for (let j = 0; j < (pole ? 1 : around); ++j) {
      const [t, p] = [(Math.PI * i) / rings, (2 * Math.PI * j) / around];
      const [x, y, z] = [Math.sin(t) * Math.cos(p), Math.sin(t) * Math.sin(p), Math.cos(t)];
      const radius = 1 + 0.15 * Math.sin(3 * x + 1) * Math.cos(4 * y) + 0.1 * Math.sin(5 * z + 2 * x);
      positions.push(radius * x, radius * y, radius * z);
    }
  }
  const last = 1 + (rings - 1) * around;
  const at = (i, j) => (i === 0 ? 0 : i === rings ? last : 1 + (i - 1) * around + (j % around));
  for (let i = 0; i < rings; ++i) {
    for (let j = 0; j < around; ++j) {
      if (i > 0) faces.push(at(i, j), at(i + 1, j), at(i, j + 1));
      if (i < rings - 1) faces.push(at(i, j + 1), at(i + 1, j), at(i + 1, j + 1));
    }
  }
  return { positions: Float64Array.from(positions), faces: Uint32Array.from(faces) };
}

export const EXAMPLES = { torus, knot, pebble };

// SPDX-License-Identifier: GPL-3.0-or-later
import { checkedArray } from "./arrays.mjs";
import { MeanderError } from "./errors.mjs";
import { Flow } from "./flow.mjs";
import { Surface } from "./surface.mjs";
import { spacingFor } from "./spacing.mjs";

// An open seam is closed where it is narrower than these shares of the size of the mesh and of half the spacing.
const SEAM_OF_SIZE = 1e-4;
const SEAM_OF_RADIUS = 0.02;

function diagonalOf(positions) {
  let sum = 0;
  for (let axis = 0; axis < 3; ++axis) {
    let [low, high] = [Infinity, -Infinity];
    for (let i = axis; i < positions.length; i += 3) {
      if (!Number.isFinite(positions[i])) continue;
      low = Math.min(low, positions[i]);
      high = Math.max(high, positions[i]);
    }
    if (high > low) sum += (high - low) ** 2;
  }
  return Math.sqrt(sum);
}

function areaOf(positions, faces) {
  let area = 0;
  const at = (corner, axis) => positions[3 * faces[corner] + axis];
  for (let f = 0; f + 2 < faces.length; f += 3) {
    const side = (corner) => [0, 1, 2].map((axis) => at(f + corner, axis) - at(f, axis));
    const [u, v] = [side(1), side(2)];
    area += Math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]) / 2;
  }
  return area;
}

/** The spacing where nobody chose one: it shows the shape, and is filled in seconds. */
export function automaticSpacing(positions, faces) {
  return spacingFor(areaOf(positions, faces));
}

/** The repairs that fill() makes: all that are safe, and none on a mesh without faults. */
export function safeRepairs(positions, spacing) {
  return {
    dropDegenerate: true,
    dropDoubled: true,
    makeManifold: true,
    weldDistance: Math.min(SEAM_OF_SIZE * diagonalOf(positions), (SEAM_OF_RADIUS * spacing) / 2),
  };
}

/** Fills a mesh with a curve, and gives the curve. */
export function fill(wish) {
  const {
    positions, faces, polygons = null, spacing, quality = "even", repairs, seed = null, density = null, directions = null,
    alignment = "along", each = null, ...options
  } = wish;
  if (spacing !== undefined && !(Number.isFinite(spacing) && spacing > 0)) {
    throw new MeanderError(`The spacing must be a positive number; it is ${spacing}.`);
  }
  const vertices = checkedArray("positions", positions, Float64Array, 3);
  const corners = checkedArray("faces", faces, Uint32Array, 3);
  const wanted = spacing ?? automaticSpacing(vertices, corners);
  const mended = repairs === undefined ? safeRepairs(vertices, wanted) : repairs;
  const surface = new Surface(vertices, corners, polygons === null ? mended : { ...mended, polygons });
  let flow = null;
  try {
    flow = new Flow(surface, { preset: quality, ...options, radius: wanted / 2 }, seed, density);
    if (directions !== null) {
      const field = typeof directions === "string" ? surface.directions(directions, wanted) : directions;
      flow.setDirections(field, alignment);
    }
    const stopReason = flow.run(each);
    return { ...flow.polylines(), stopReason, statistics: flow.statistics(), surface: surface.statistics() };
  } finally {
    flow?.close();
    surface.close();
  }
}

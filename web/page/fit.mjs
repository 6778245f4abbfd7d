// SPDX-License-Identifier: GPL-3.0-or-later
//
// A mesh as it is drawn: about the origin, two units across, with normals between its faces.

/** Where a mesh is drawn: at (x - centre) * scale. */
export function fitOf(positions, faces) {
  const [low, high] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
  for (const corner of faces) {
    for (let axis = 0; axis < 3; ++axis) {
      const x = positions[3 * corner + axis];
      if (x < low[axis]) low[axis] = x;
      if (x > high[axis]) high[axis] = x;
    }
  }
  return {
    centre: low.map((x, axis) => (x + high[axis]) / 2),
    scale: 2 / (Math.hypot(...low.map((x, axis) => high[axis] - x)) || 1),
  };
}

export function placed(positions, { centre, scale }) {
  const places = new Float32Array(positions.length);
  for (let i = 0; i < places.length; ++i) places[i] = (positions[i] - centre[i % 3]) * scale;
  return places;
}

/** Of each vertex: the sum of its faces' normals, by their areas. */
export function normalsOf(places, faces) {
  const normals = new Float32Array(places.length);
  for (let f = 0; f < faces.length; f += 3) {
    const [a, b, c] = [3 * faces[f], 3 * faces[f + 1], 3 * faces[f + 2]];
    const [ux, uy, uz] = [places[b] - places[a], places[b + 1] - places[a + 1], places[b + 2] - places[a + 2]];
    const [vx, vy, vz] = [places[c] - places[a], places[c + 1] - places[a + 1], places[c + 2] - places[a + 2]];
    const [x, y, z] = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    for (const corner of [a, b, c]) {
      normals[corner] += x;
      normals[corner + 1] += y;
      normals[corner + 2] += z;
    }
  }
  for (let i = 0; i < normals.length; i += 3) {
    const length = Math.hypot(normals[i], normals[i + 1], normals[i + 2]) || 1;
    for (let k = i; k < i + 3; ++k) normals[k] /= length;
  }
  return normals;
}

/** Corners of the two sides of a cut surface, with the mesh's normals, and 1 where a corner is on the second side. */
export function sidesOf(cut, fit, faces, normals) {
  const { positions, vertexFaces, vertexWeights, sides } = cut;
  const corners = cut.faces.length;
  const [places, facings, tones] = [new Float32Array(3 * corners), new Float32Array(3 * corners), new Float32Array(corners)];
  for (let k = 0; k < corners; ++k) {
    const vertex = cut.faces[k];
    for (let axis = 0; axis < 3; ++axis) {
      places[3 * k + axis] = (positions[3 * vertex + axis] - fit.centre[axis]) * fit.scale;
      for (let w = 0; w < 3; ++w) {
        facings[3 * k + axis] += vertexWeights[3 * vertex + w] * normals[3 * faces[3 * vertexFaces[vertex] + w] + axis];
      }
    }
    tones[k] = sides[Math.floor(k / 3)] < 0 ? 1 : 0;
  }
  return { places, normals: facings, tones };
}

/** Whether the curve has two sides everywhere: an open one has both of its sides in one region. */
export function isParted({ regions, sides }) {
  const sideOf = new Map();
  return regions.every((region, face) => {
    if (!sideOf.has(region)) sideOf.set(region, sides[face]);
    return sideOf.get(region) === sides[face];
  });
}

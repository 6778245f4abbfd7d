// SPDX-License-Identifier: GPL-3.0-or-later
//
// A line as the instances of a ring that the graphics card draws: computed beside the flow, so that the page only hands
// them on.

/** Points with 1 where a piece begins, directions away from the surface with the share of the strand, and how many. */
export function instancesOf({ positions, normals, offsets, closed }, { centre, scale }) {
  const strands = offsets.length - 1;
  const total = positions.length / 3 + 3 * strands;
  const [points, ups] = [new Float32Array(4 * total), new Float32Array(4 * total)];
  let at = 0;
  const put = (i, piece, share) => {
    for (let axis = 0; axis < 3; ++axis) {
      points[4 * at + axis] = (positions[3 * i + axis] - centre[axis]) * scale;
      ups[4 * at + axis] = normals[3 * i + axis];
    }
    points[4 * at + 3] = piece;
    ups[4 * at + 3] = share;
    ++at;
  };
  for (let s = 0; s < strands; ++s) {
    const [first, end] = [offsets[s], offsets[s + 1]];
    const last = end - 1;
    if (end - first < 2) continue;
    put(closed[s] ? last : first, 0, 0);
    for (let i = first; i < end; ++i) put(i, closed[s] || i < last ? 1 : 0, (i - first) / (end - first));
    put(closed[s] ? first : last, 0, 1);
    if (closed[s]) put(first + 1, 0, 1);
  }
  return { points, ups, pieces: Math.max(0, at - 3) };
}

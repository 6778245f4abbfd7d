// SPDX-License-Identifier: GPL-3.0-or-later
//
// A line as the text or bytes of a file.
import { triangles } from "./tube.mjs";

/** Indices of the points of each strand, the first again at the end of a closed one. */
function* strandsOf({ offsets, closed }) {
  for (let s = 0; s + 1 < offsets.length; ++s) {
    const indices = Array.from({ length: offsets[s + 1] - offsets[s] }, (_, i) => offsets[s] + i);
    if (closed[s]) indices.push(offsets[s]);
    yield indices;
  }
}

function rows(positions) {
  const lines = [];
  for (let i = 0; i < positions.length; i += 3) lines.push(`${positions[i]} ${positions[i + 1]} ${positions[i + 2]}`);
  return lines;
}

export function objOf(line) {
  const points = rows(line.positions).map((row) => `v ${row}`);
  const strands = Array.from(strandsOf(line), (indices) => `l ${indices.map((i) => i + 1).join(" ")}`);
  return `# Meander\n${[...points, ...strands].join("\n")}\n`;
}

export function plyOf(line) {
  const edges = [];
  for (const indices of strandsOf(line)) {
    for (let k = 1; k < indices.length; ++k) edges.push(`${indices[k - 1]} ${indices[k]}`);
  }
  const points = rows(line.positions);
  const head = ["ply", "format ascii 1.0", "comment Meander", `element vertex ${points.length}`];
  head.push(...["x", "y", "z"].map((axis) => `property double ${axis}`), `element edge ${edges.length}`);
  head.push("property int vertex1", "property int vertex2", "end_header");
  return `${[...head, ...points, ...edges].join("\n")}\n`;
}

const SIDE = 200; // of a drawing, in millimetres
const MARGIN = 10;

/** A drawing on the plane of two axes; `pen` is the width of the line in the units of the mesh. */
export function svgOf(line, [right, up], pen) {
  const count = line.positions.length / 3;
  const flat = new Float64Array(2 * count);
  const [low, high] = [[Infinity, Infinity], [-Infinity, -Infinity]];
  for (let i = 0; i < count; ++i) {
    [right, up].forEach((axis, k) => {
      const x = axis.reduce((sum, a, j) => sum + a * line.positions[3 * i + j], 0);
      flat[2 * i + k] = x;
      low[k] = Math.min(low[k], x);
      high[k] = Math.max(high[k], x);
    });
  }
  const scale = (SIDE - 2 * MARGIN) / Math.max(high[0] - low[0], high[1] - low[1], Number.MIN_VALUE);
  const place = (i) =>
    `${(MARGIN + (flat[2 * i] - low[0]) * scale).toFixed(3)},${(MARGIN + (high[1] - flat[2 * i + 1]) * scale).toFixed(3)}`;
  const paths = Array.from(strandsOf(line), (indices) => `<polyline points="${indices.map(place).join(" ")}"/>`);
  const [width, height] = [0, 1].map((k) => (2 * MARGIN + (high[k] - low[k]) * scale).toFixed(3));
  return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}mm" height="${height}mm" viewBox="0 0 ${width} ${height}">
<g fill="none" stroke="#000" stroke-width="${Math.max(0.1, pen * scale).toFixed(3)}" stroke-linecap="round" stroke-linejoin="round">
${paths.join("\n")}
</g>
</svg>
`;
}

/** The tube as a binary glTF file, in which Y is up. */
export function glbOf(line, radius, upright) {
  const { places, facings, index } = triangles(line, radius);
  const [low, high] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
  places.forEach((x, i) => {
    low[i % 3] = Math.min(low[i % 3], x);
    high[i % 3] = Math.max(high[i % 3], x);
  });
  const parts = [places, facings, index];
  let length = 0;
  const bufferViews = parts.map(({ byteLength }, k) => {
    const view = { buffer: 0, byteOffset: length, byteLength, target: k === 2 ? 34963 : 34962 };
    length += byteLength;
    return view;
  });
  const vector = { componentType: 5126, type: "VEC3", count: places.length / 3 };
  const node = { mesh: 0, name: "Meander", ...(upright && { rotation: [-Math.SQRT1_2, 0, 0, Math.SQRT1_2] }) };
  const text = JSON.stringify({
    asset: { version: "2.0", generator: "Meander" },
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [node],
    meshes: [{ primitives: [{ attributes: { POSITION: 0, NORMAL: 1 }, indices: 2, material: 0 }] }],
    materials: [{ pbrMetallicRoughness: { baseColorFactor: [0.48, 0.05, 0.01, 1], metallicFactor: 0, roughnessFactor: 0.6 } }],
    buffers: [{ byteLength: length }],
    bufferViews,
    accessors: [
      { bufferView: 0, ...vector, min: low, max: high },
      { bufferView: 1, ...vector },
      { bufferView: 2, componentType: 5125, type: "SCALAR", count: index.length },
    ],
  });
  const words = new TextEncoder().encode(text + " ".repeat((4 - (new TextEncoder().encode(text).length % 4)) % 4));
  const bytes = new Uint8Array(12 + 8 + words.length + 8 + length);
  const view = new DataView(bytes.buffer);
  const head = [0x46546c67, 2, bytes.length, words.length, 0x4e4f534a];
  head.forEach((word, k) => view.setUint32(4 * k, word, true));
  bytes.set(words, 20);
  view.setUint32(20 + words.length, length, true);
  view.setUint32(24 + words.length, 0x004e4942, true);
  let at = 28 + words.length;
  for (const { buffer, byteLength } of parts) {
    bytes.set(new Uint8Array(buffer), at);
    at += byteLength;
  }
  return bytes;
}

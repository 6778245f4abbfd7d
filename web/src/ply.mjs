// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes in PLY files, binary and text.
import { calling } from "./calls.mjs";
import { MeanderError } from "./errors.mjs";
import { triangulated } from "./files.mjs";
import { native } from "./module.mjs";

// Both generations of names: how wide a number is, and how a DataView reads it.
const TYPES = {
  char: [1, "getInt8"], int8: [1, "getInt8"], uchar: [1, "getUint8"], uint8: [1, "getUint8"],
  short: [2, "getInt16"], int16: [2, "getInt16"], ushort: [2, "getUint16"], uint16: [2, "getUint16"],
  int: [4, "getInt32"], int32: [4, "getInt32"], uint: [4, "getUint32"], uint32: [4, "getUint32"],
  float: [4, "getFloat32"], float32: [4, "getFloat32"], double: [8, "getFloat64"], float64: [8, "getFloat64"],
};
const ORDERS = { ascii: "text", binary_little_endian: "little", binary_big_endian: "big" };

const refuse = (sentence) => {
  throw new MeanderError(`${sentence}; export it again.`, "invalid_mesh");
};

function header(bytes) {
  const text = new TextDecoder("latin1").decode(bytes.subarray(0, 65536));
  const end = /(^|\n)end_header\r?\n/.exec(text);
  if (!text.startsWith("ply") || !end) refuse("The file has no PLY header");
  let order = null;
  const elements = [];
  for (const line of text.slice(0, end.index).split("\n")) {
    const words = line.trim().split(/\s+/);
    if (words[0] === "format") order = ORDERS[words[1]];
    if (words[0] === "element") elements.push({ name: words[1], count: Number(words[2]), properties: [] });
    if (words[0] !== "property") continue;
    const list = words[1] === "list";
    const [kind, length, name] = list ? [TYPES[words[3]], TYPES[words[2]], words[4]] : [TYPES[words[1]], null, words[2]];
    if (!kind || (list && !length) || !name || !elements.length) refuse(`The PLY header has a line that means nothing (${line.trim()})`);
    elements[elements.length - 1].properties.push({ name, kind, length });
  }
  if (!order) refuse("The PLY header does not say its format");
  if (elements.some(({ count }) => !(Number.isInteger(count) && count >= 0))) refuse("The PLY header has a count that is none");
  return { order, elements, begin: end.index + end[0].length };
}

/** What gives one number after the other, of a type of the header. */
function numbersOf(bytes, order, begin) {
  if (order === "text") {
    const text = bytes.subarray(begin);
    const numbers = calling((call) => {
      const room = (text.length >> 1) + 1;
      const [values, count, end] = [call.memory(8 * room), call.memory(4), call.memory(4)];
      call.check(
        native.meander_text_read_numbers(call.copy(text), text.length, values, room, count, end, call.error.address),
      );
      return call.read(Float64Array, values, call.pointer(count));
    });
    let at = 0;
    return () => (at < numbers.length ? numbers[at++] : refuse("The file ends before the last number that its header counts"));
  }
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  let at = begin;
  return ([width, read]) => {
    if (at + width > bytes.length) refuse("The file ends before the last number that its header counts");
    at += width;
    return view[read](at - width, order === "little");
  };
}

/** The triangles of a strip: every second one is turned, and -1 ends a run. */
function* strip(corners) {
  let run = [];
  for (const corner of [...corners, -1]) {
    if (corner >= 0) {
      run.push(corner);
      continue;
    }
    for (let k = 2; k < run.length; ++k) yield k % 2 ? [run[k - 1], run[k - 2], run[k]] : run.slice(k - 2, k + 1);
    run = [];
  }
}

export function readPly(bytes) {
  const { order, elements, begin } = header(bytes);
  const next = numbersOf(bytes, order, begin);
  let positions = null;
  const [corners, ends] = [[], []];
  const wanted = new Set(elements.map(({ name }) => name).filter((name) => /^(vertex|face|tristrips)$/.test(name)));
  for (const { name, count, properties } of elements) {
    if (wanted.size === 0) break;
    wanted.delete(name);
    const axes = ["x", "y", "z"].map((axis) => properties.findIndex((property) => property.name === axis));
    const isVertex = name === "vertex";
    if (isVertex && axes.includes(-1)) refuse("The file has no vertices with x, y and z");
    if (isVertex) positions = [];
    for (let row = 0; row < count; ++row) {
      const values = [];
      for (const { name: what, kind, length } of properties) {
        if (!length) {
          values.push(next(kind));
          continue;
        }
        const items = Array.from({ length: next(length) }, () => next(kind));
        values.push(0);
        if (!/^vertex_ind(ex|ices)$/.test(what)) continue;
        const wrong = items.find((item) => !Number.isInteger(item) || item > 0xfffffffe || item < (name === "face" ? 0 : -1));
        if (wrong !== undefined) refuse(`The file has a face with a vertex ${wrong}`);
        for (const polygon of name === "tristrips" ? strip(items) : [items]) {
          if (polygon.length < 3) continue;
          for (const item of polygon) corners.push(item);
          ends.push(corners.length);
        }
      }
      if (isVertex) for (const axis of axes) positions.push(values[axis]);
    }
  }
  if (!positions) refuse("The file has no vertices with x, y and z");
  if (!ends.length) throw new MeanderError("The file has no faces; give a mesh with triangles.", "invalid_mesh");
  const vertices = Float64Array.from(positions);
  return { positions: vertices, ...triangulated(vertices, Uint32Array.from(corners), Uint32Array.from(ends)) };
}

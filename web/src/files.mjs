// SPDX-License-Identifier: GPL-3.0-or-later
//
// Mesh files: OBJ, PLY and STL. Polygons become the triangles that Blender makes of them. What is wrong with the mesh
// itself is passed on, since the library names it.
import * as abi from "meander:abi";
import { calling } from "./calls.mjs";
import { MeanderError } from "./errors.mjs";
import { native } from "./module.mjs";
import { readPly } from "./ply.mjs";

const refuse = (sentence) => {
  throw new MeanderError(sentence, "invalid_mesh");
};

/** The points and polygons in a text of a kind of abi.Text. */
function readPolygons(bytes, kind) {
  return calling((call) => {
    const found = call.result(abi.PolygonsRecord, native.meander_polygons_init);
    call.check(
      native.meander_text_read_polygons(call.copy(bytes), bytes.length, kind, found.address, call.error.address),
    );
    const count = found.get("polygon_count");
    return {
      positions: found.array("positions", 3 * found.get("point_count")),
      corners: found.array("corners", found.get("corner_count")),
      ends: found.array("ends", count),
    };
  });
}

/** The triangles of polygons, and the polygon of each; the polygons themselves where all have three corners. */
export function triangulated(positions, corners, ends) {
  if (corners.length === 3 * ends.length && ends.every((end, i) => end === 3 * (i + 1))) {
    return { faces: corners, polygons: null };
  }
  return calling((call) => {
    const found = call.result(abi.TrianglesRecord, native.meander_triangles_init);
    const wide = call.copy(BigUint64Array.from(ends, BigInt));
    call.check(
      native.meander_polygons_triangulate(
        call.copy(positions), positions.length / 3, call.copy(corners), corners.length, wide, ends.length,
        found.address, call.error.address,
      ),
    );
    const count = found.get("count");
    return { faces: found.array("corners", 3 * count), polygons: found.array("polygons", count) };
  });
}

function readObj(bytes) {
  const { positions, corners, ends } = readPolygons(bytes, abi.Text.obj_faces);
  if (ends.length === 0) refuse("The file has no faces; give a mesh with v and f lines.");
  return { positions, ...triangulated(positions, corners, ends) };
}

/** Corners at the same place become one vertex, in the order in which they first occur. */
export function joined(corners) {
  const places = new Map();
  const positions = [];
  const faces = new Uint32Array(corners.length / 3);
  for (let i = 0; i < faces.length; ++i) {
    const [x, y, z] = [corners[3 * i] + 0, corners[3 * i + 1] + 0, corners[3 * i + 2] + 0]; // -0 is 0
    const key = `${x},${y},${z}`;
    let place = places.get(key);
    if (place === undefined) {
      place = positions.length / 3;
      places.set(key, place);
      positions.push(x, y, z);
    }
    faces[i] = place;
  }
  return { positions: Float64Array.from(positions), faces, polygons: null };
}

const HEAD_OF_STL = 84;
const TRIANGLE_OF_STL = 50;

function readStl(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const room = Math.floor((bytes.length - HEAD_OF_STL) / TRIANGLE_OF_STL);
  const count = bytes.length >= HEAD_OF_STL ? view.getUint32(80, true) : 0;
  const head = new TextDecoder("latin1").decode(bytes.subarray(0, 4096));
  // Binary files may begin with "solid" as well, so their size decides.
  const exact = bytes.length === HEAD_OF_STL + TRIANGLE_OF_STL * count;
  if (!exact && !head.includes("\0") && /^\s*solid|facet|vertex/i.test(head)) {
    const found = readPolygons(bytes, abi.Text.stl);
    if (found.ends.length === 0) refuse("The file has no faces; give a mesh with triangles.");
    const { positions, faces } = joined(found.positions);
    const corners = found.corners.map((corner) => faces[corner]);
    return { positions, ...triangulated(positions, corners, found.ends) };
  }
  if (count === 0 || room < count) refuse("The file is no STL file, or ends too early; export it again.");
  const corners = new Float64Array(9 * count);
  for (let i = 0; i < count; ++i) {
    for (let k = 0; k < 9; ++k) {
      corners[9 * i + k] = view.getFloat32(HEAD_OF_STL + TRIANGLE_OF_STL * i + 12 + 4 * k, true);
    }
  }
  return joined(corners);
}

const READERS = { obj: readObj, ply: readPly, stl: readStl };

/** The vertices and triangles in the bytes of a file, whose name says the kind. */
export function readMesh(bytes, name) {
  const suffix = /\.(\w+)$/.exec(name)?.[1].toLowerCase();
  if (!Object.hasOwn(READERS, suffix ?? "")) refuse(`${name} is no OBJ, PLY or STL file; export the mesh as one.`);
  return READERS[suffix](bytes instanceof Uint8Array ? bytes : new Uint8Array(bytes));
}

// SPDX-License-Identifier: GPL-3.0-or-later
//
// node --test tests/web/library.test.mjs: build/web/meander.mjs, every call of it once, its errors, its memory.
import assert from "node:assert/strict";
import fs from "node:fs";
import test from "node:test";
import { brotliCompressSync } from "node:zlib";
import * as meander from "../../build/web/meander.mjs";

await meander.ready;
const { fill, Flow, MeanderError, Surface } = meander;

const TETRAHEDRON = {
  positions: new Float64Array([1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1]),
  faces: new Uint32Array([0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2]),
};

/** The unit square of so many cells a side. */
function sheet(cells) {
  const [positions, faces] = [[], []];
  for (let j = 0; j <= cells; ++j) for (let i = 0; i <= cells; ++i) positions.push(i / cells, j / cells, 0);
  for (let j = 0; j < cells; ++j) {
    for (let i = 0; i < cells; ++i) {
      const at = j * (cells + 1) + i;
      faces.push(at, at + 1, at + cells + 2, at, at + cells + 2, at + cells + 1);
    }
  }
  return { positions: Float64Array.from(positions), faces: Uint32Array.from(faces) };
}

const SHEET = sheet(6);

test("fills a mesh without crossings, on its surface, within the spacing", () => {
  const curve = fill({ ...TETRAHEDRON, spacing: 0.3, quality: "even" });
  assert.equal(curve.stopReason, "converged");
  assert.equal(curve.statistics.crossings, 0);
  assert.equal(curve.offsets.length, curve.closed.length + 1);
  assert.equal(curve.offsets.at(-1), curve.positions.length / 3);
  const { distances } = meander.findClosest(TETRAHEDRON.positions, TETRAHEDRON.faces, curve.positions);
  assert.ok(Math.max(...distances) < 1e-12);
  assert.ok(Math.abs(curve.statistics.spacingMedian / 0.3 - 1) < 0.1);
});

test("a server sends no more than 450 KB of the module, and 700 of the page", () => {
  const sent = (name) => brotliCompressSync(fs.readFileSync(new URL(`../../build/web/${name}`, import.meta.url))).length;
  assert.ok(sent("meander.mjs") <= 450000);
  assert.ok(sent("index.html") <= 700000);
});

test("every struct lies where the library has it", () => {
  for (const name of ["error", "polygons", "triangles", "surface_options", "surface_statistics", "faults", "outlines",
    "seed", "flow_options", "extent", "cost", "preview", "flow_statistics", "iteration", "polylines", "nodes",
    "point_data", "gaps", "cut"]) {
    const { library, binding } = meander.structLayout(`meander_${name}`);
    assert.deepEqual(binding, library, name);
  }
});

test("meander.d.ts declares what the module exports, and nothing else", () => {
  const text = fs.readFileSync(new URL("../../web/meander.d.ts", import.meta.url), "utf8");
  const declared = [...text.matchAll(/^export (?:const|function|class) (\w+)/gm)].map((match) => match[1]);
  assert.deepEqual(declared.sort(), Object.keys(meander).sort());
});

test("a surface tells its figures, fields, outlines and nearest points", () => {
  const surface = new Surface(SHEET.positions, SHEET.faces);
  const count = surface.vertexCount;
  const figures = surface.statistics();
  assert.equal(figures.faces, 72);
  assert.equal(figures.boundaryLoops, 1);
  assert.ok(Math.abs(figures.area - 1) < 1e-9);
  for (const kind of meander.CURVATURES) assert.ok(surface.curvature(kind, 0.2).every((x) => Math.abs(x) < 1e-9));
  for (const kind of meander.DIRECTIONS) assert.equal(surface.directions(kind).length, 3 * count);
  assert.equal(surface.extendedDirections([0.1, 0.1, 0, 0.9, 0.2, 0], [0, 2]).length, 3 * count);
  const { seed, skipped } = surface.outlines(0.1, 0.1);
  assert.equal(skipped, 0);
  assert.deepEqual([...seed.guides], [1]);
  assert.deepEqual([...surface.findClosest([0.5, 0.5, 2]).distances], [2]);
  const cost = meander.estimateCost(surface.extent(), { radius: 0.05 });
  assert.ok(cost.nodes > 50 && cost.memory > 0 && Number.isFinite(cost.processorSeconds));
  surface.close();
  assert.throws(() => surface.statistics(), MeanderError);
});

test("a flow is stepped, watched, stopped and asked for other things", () => {
  const surface = new Surface(SHEET.positions, SHEET.faces);
  const flow = new Flow(surface, { preset: "even", radius: 0.05 });
  assert.equal(flow.stopReason, "running");
  assert.equal(flow.progress, 0);
  assert.equal(flow.step(), "running");
  let steps = 0;
  let shown = 0;
  assert.equal(flow.run((same) => {
    assert.equal(same, flow);
    assert.ok(flow.progress >= shown && flow.progress <= 1);
    assert.ok(meander.PHASES.includes(flow.phase));
    shown = flow.progress;
    return ++steps < 20;
  }), "cancelled");
  assert.equal(flow.history().length, 21);
  assert.equal(flow.run(), "converged");
  const before = flow.statistics().length;
  flow.setRadius(0.06);
  assert.ok(meander.STOP_REASONS.includes(flow.run()));
  assert.ok(flow.statistics().length < before);
  flow.setDensity(Float64Array.from({ length: surface.vertexCount }, (_, i) => 1 + SHEET.positions[3 * i]));
  flow.step();
  flow.setDensity(null);
  flow.setOptions({ preset: "even", radius: 0.06, bendingWeight: 0.2 });
  flow.setVertices(SHEET.positions.map((x) => 1.1 * x));
  flow.step();
  const { positions, guides } = flow.polylines();
  const data = flow.pointData();
  assert.equal(data.normals.length, positions.length);
  assert.equal(data.faces.length, positions.length / 3);
  assert.deepEqual(Object.keys(flow.pointData(["tangents", "arc_lengths"])).sort(), ["arcLengths", "tangents"]);
  assert.ok(guides.every((guide) => guide === 0));
  const nodes = flow.nodes();
  assert.equal(nodes.barycentrics.length, 3 * nodes.faces.length);
  assert.ok(flow.gaps().emptyShare >= 0);
  flow.close();
  surface.close();
});

test("a surface is cut along its line, which parts it", () => {
  const surface = new Surface(SHEET.positions, SHEET.faces);
  const flow = new Flow(surface, { preset: "even", radius: 0.1 });
  flow.run();
  const cut = meander.cutSurface(flow);
  const { positions, closed } = flow.polylines();
  assert.equal(cut.lineVertices.length, positions.length / 3);
  assert.deepEqual([...cut.closed], [...closed]);
  cut.lineVertices.forEach((vertex, i) => {
    for (let k = 0; k < 3; ++k) assert.equal(cut.positions[3 * vertex + k], positions[3 * i + k]);
    assert.equal(cut.distances[vertex], 0);
  });
  assert.equal(cut.sides.length, cut.faces.length / 3);
  assert.deepEqual([...new Set(cut.sides)].sort(), [-1, 1]);
  assert.ok(meander.cutSurface(flow, 0.05, true).faces.length > cut.faces.length);
  refused(() => meander.cutSurface(flow, -1), /detail/);
});

test("seeds, guides, densities and directions are taken", () => {
  const strokes = { points: [0.1, 0.1, 0, 0.9, 0.1, 0, 0.1, 0.5, 0, 0.9, 0.5, 0], offsets: [0, 2, 4], guides: [0, 1] };
  const drawn = fill({ ...SHEET, spacing: 0.1, seed: { ...strokes, loops: true }, iterationLimit: 10 });
  assert.equal(drawn.guides[1], 1);
  const dense = fill({ ...SHEET, spacing: 0.2, density: new Float64Array(49).fill(4), iterationLimit: 30 });
  assert.ok(dense.statistics.length > 0);
  const rows = fill({ ...SHEET, spacing: 0.1, directions: "boundary", alignmentWeight: 1, start: "full", iterationLimit: 30 });
  assert.equal(rows.statistics.startAskedFull, 1);
  const across = fill({ ...SHEET, spacing: 0.1, directions: new Float64Array(147).fill(1), alignment: "across", iterationLimit: 3 });
  assert.equal(across.stopReason, "iteration_limit");
});

test("options have the names of the presets, and warnings are sentences", () => {
  for (const preset of meander.PRESETS) assert.equal(meander.defaultOptions(preset).preset, preset);
  assert.equal(meander.defaultOptions("paper").stopRule, "paper");
  assert.ok(Object.keys(meander.defaultOptions().tunings).length > 0);
  assert.deepEqual(meander.optionWarnings({ radius: 1 }), []);
  assert.match(meander.optionWarnings({ radius: 1, segmentLength: 1 })[0], /\.$/);
});

const refused = (work, sentence, status = "invalid_argument") =>
  assert.throws(work, (problem) => {
    assert.ok(problem instanceof MeanderError, String(problem.stack));
    assert.match(problem.message, sentence);
    assert.equal(problem.status, status);
    return true;
  });

test("what is wrong is one sentence, and everything works afterwards", () => {
  refused(() => fill({ ...TETRAHEDRON, spacing: -1 }), /spacing must be a positive number/);
  refused(() => fill({ ...TETRAHEDRON, spacing: 0.3, quality: "best" }), /choose one of even, paper, finest/);
  refused(() => fill({ ...TETRAHEDRON, spacing: 0.3, wieght: 1 }), /there is no option 'wieght'/);
  refused(() => fill({ ...TETRAHEDRON, spacing: 0.3, density: [1] }), /one value for each of the 4 vertices/);
  refused(() => new Surface([0, 0, 0], [0, 0]), /3 numbers for each row/);
  refused(() => new Surface([0, 0, 0, 1, 0, 0, 0, 1, 0], [0, 1, -1]), /whole numbers/);
  refused(() => new Surface([0, 0, 0, 1, 0, 0, 0, 1, 0], [0, 1, 7]), /vertex 7/, "invalid_mesh");
  refused(() => new Surface([0, 0, 0, 1, 0, 0, NaN, 1, 0], [0, 1, 2]), /vertex 2/i, "invalid_mesh");
  refused(() => fill({ ...SHEET, spacing: 0.1, seed: { points: [5, 5, 5, 6, 6, 6] } }), /seed point 0/i, "invalid_seed");
  try {
    new Surface([0, 0, 0, 1, 0, 0, 2, 0, 0], [0, 1, 2]);
    assert.fail();
  } catch (problem) {
    assert.deepEqual([problem.elementKind, problem.elements], ["face", [0]]);
  }
  assert.equal(fill({ ...TETRAHEDRON, spacing: 0.5 }).statistics.crossings, 0);
});

test("faults are named, and mended", () => {
  const positions = [...TETRAHEDRON.positions, 5, 5, 5];
  const faces = [...TETRAHEDRON.faces, 0, 1, 4, 0, 1, 2];
  const { kinds } = meander.findFaults(positions, faces);
  assert.ok([...kinds].some((kind) => meander.FAULTS[kind] === "doubled_face"));
  const curve = fill({ positions, faces, spacing: 0.6, iterationLimit: 5 });
  assert.ok(curve.surface.doubledFaces > 0);
  refused(() => fill({ positions, faces, spacing: 0.6, repairs: null }), /has 4 faces/, "invalid_mesh");
  assert.ok(meander.automaticSpacing(TETRAHEDRON.positions, TETRAHEDRON.faces) > 0);
  assert.ok(meander.safeRepairs(TETRAHEDRON.positions, 0.1).weldDistance > 0);
});

const bytes = (text) => new TextEncoder().encode(text);

test("reads OBJ, PLY and STL", () => {
  const obj = meander.readMesh(bytes("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"), "a.OBJ");
  assert.equal(obj.faces.length, 6);
  assert.deepEqual([...obj.polygons], [0, 0]);
  assert.ok(fill({ ...obj, spacing: 0.2 }).statistics.length > 1); // what is read can be filled as it is
  const head = (format) => `ply\nformat ${format} 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n`;
  const text = meander.readMesh(bytes(`${head("ascii")}0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n`), "a.ply");
  assert.deepEqual([...text.faces], [0, 1, 2]);
  for (const [format, little] of [["binary_little_endian", true], ["binary_big_endian", false]]) {
    const begin = bytes(head(format));
    const file = new Uint8Array(begin.length + 36 + 13);
    file.set(begin);
    const view = new DataView(file.buffer, begin.length);
    [0, 0, 0, 1, 0, 0, 0, 1, 0].forEach((x, k) => view.setFloat32(4 * k, x, little));
    view.setUint8(36, 3);
    [0, 1, 2].forEach((x, k) => view.setInt32(37 + 4 * k, x, little));
    const mesh = meander.readMesh(file, "a.ply");
    assert.deepEqual([[...mesh.positions], [...mesh.faces]], [[0, 0, 0, 1, 0, 0, 0, 1, 0], [0, 1, 2]]);
    refused(() => meander.readMesh(file.slice(0, -1), "a.ply"), /ends before the last number/, "invalid_mesh");
  }
  const facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
  const stl = meander.readMesh(bytes(`solid a\n${facet}endsolid a\n`), "a.stl");
  assert.equal(stl.positions.length, 9);
  const binary = new Uint8Array(84 + 100);
  const view = new DataView(binary.buffer);
  view.setUint32(80, 2, true);
  [0, 0, 0, 1, 0, 0, 0, 1, 0].forEach((x, k) => view.setFloat32(96 + 4 * k, x, true));
  [1, 0, 0, 1, 1, 0, -0, 1, 0].forEach((x, k) => view.setFloat32(146 + 4 * k, x, true));
  const joined = meander.readMesh(binary.buffer, "b.stl");
  assert.deepEqual([joined.positions.length, [...joined.faces]], [12, [0, 1, 2, 1, 3, 2]]);
  refused(() => meander.readMesh(bytes("v 0 0\n"), "a.obj"), /Line 1/, "invalid_mesh");
  refused(() => meander.readMesh(bytes("v 0 0 0\n"), "a.obj"), /has no faces/, "invalid_mesh");
  refused(() => meander.readMesh(bytes("ply\n"), "a.ply"), /no PLY header/, "invalid_mesh");
  refused(() => meander.readMesh(bytes("nothing"), "a.stl"), /no STL file/, "invalid_mesh");
  refused(() => meander.readMesh(bytes(""), "a.blend"), /no OBJ, PLY or STL file/, "invalid_mesh");
});

test("200 runs take no more memory than ten", () => {
  const once = () => fill({ ...TETRAHEDRON, spacing: 0.5, iterationLimit: 3 });
  for (let k = 0; k < 10; ++k) once();
  const before = meander.memoryInUse();
  for (let k = 0; k < 200; ++k) once();
  assert.equal(meander.memoryInUse(), before);
});

test("memory grows under what was taken before", () => {
  const early = new Surface(TETRAHEDRON.positions, TETRAHEDRON.faces);
  const before = meander.memoryInUse();
  const large = new Surface(...Object.values(sheet(200)));
  assert.ok(meander.memoryInUse() > before);
  assert.equal(early.statistics().faces, 4);
  assert.equal(large.statistics().faces, 80000);
  large.close();
  early.close();
});

// SPDX-License-Identifier: GPL-3.0-or-later
//
// The library behind the page: reads meshes, and runs one flow at a time, a step between two messages.
import { EXAMPLES } from "./examples.mjs";
import { fitOf, isParted, normalsOf, placed, sidesOf } from "./fit.mjs";
import { instancesOf } from "./instances.mjs";
import { MOST_FACES, tooLarge, tooManyFaces } from "./room.mjs";
import { cutSurface } from "../src/cut.mjs";
import { automaticSpacing, safeRepairs } from "../src/fill.mjs";
import { joined, readMesh } from "../src/files.mjs";
import { Flow } from "../src/flow.mjs";
import { MeanderError } from "../src/errors.mjs";
import { ready } from "../src/module.mjs";
import { estimateCost } from "../src/options.mjs";
import { Surface } from "../src/surface.mjs";

// What a tab has room for: a module has 4 GB at most, and the page draws what comes out.
const MOST_BYTES = 2.5e9;
const MOST_POINTS = 5e6;
// Between two pictures of the growing line, and how many times what one takes.
const PICTURE = 60;
const PATIENCE = 4;

let mesh = null; // positions, faces, polygons, area, and how it is drawn: fit, normals
let run = null; // of the latest wish: its flow, and what there is to tell

const tell = (message, transfer = []) => self.postMessage(message, transfer);
const large = (sentence) => {
  throw new MeanderError(sentence, "invalid_mesh");
};
const count = (number) => Math.round(number).toLocaleString("en");

function end() {
  run?.flow?.close();
  run = null;
}

/** The bytes of a file, once it is known to be none that is too large. */
function bytesOf(file) {
  const reader = new FileReaderSync();
  const piece = (begin, end) => new Uint8Array(reader.readAsArrayBuffer(file.slice(begin, end)));
  const sentence = tooLarge(file.name, file.size, piece);
  if (sentence) large(sentence);
  return piece(0, file.size);
}

function read({ example, name, bytes, corners }) {
  if (example) return EXAMPLES[example]();
  return corners ? joined(corners) : readMesh(bytes, name);
}

/** Keeps a mesh, and says how it is drawn. */
function keep({ positions, faces, polygons = null, area }) {
  const fit = fitOf(positions, faces);
  const places = placed(positions, fit);
  mesh = { positions, faces, polygons, area, fit, normals: normalsOf(places, faces) };
  return places;
}

// The page shows a mesh with all its faults; the library refuses what cannot be filled, with a sentence.
const surfaceOf = ({ positions, faces, polygons }, spacing) =>
  new Surface(positions, faces, { ...safeRepairs(positions, spacing), polygons });

/** Reads a mesh. A run ends only when that has succeeded. */
function load({ id, name, file, ...message }) {
  const bytes = file && bytesOf(file);
  if (/\.glb$/i.test(name) && !message.corners) {
    tell({ kind: "glb", id, bytes }, [bytes.buffer]); // for three.js, which is on the page
    return;
  }
  const found = read({ name, bytes, ...message });
  if (found.faces.length / 3 > MOST_FACES) large(tooManyFaces(name, found.faces.length / 3));
  const spacing = automaticSpacing(found.positions, found.faces);
  const surface = surfaceOf(found, spacing);
  const figures = surface.statistics();
  surface.close();
  end();
  const places = keep({ ...found, area: figures.area });
  const { positions, faces, polygons, fit, normals } = mesh;
  tell({ kind: "mesh", id, positions, faces, polygons, figures, fit, places, normals }, [places.buffer]);
}

const axisField = (axis, vertices) => {
  const field = new Float64Array(3 * vertices);
  for (let i = "xyz".indexOf(axis); i < field.length; i += 3) field[i] = 1;
  return field;
};

function begin({ id, spacing, quality, rows, seed: { positions, offsets, closed } }) {
  end();
  const surface = surfaceOf(mesh, spacing);
  try {
    const options = { preset: quality === "flowing" ? "even" : quality, radius: spacing / 2 };
    if (quality === "flowing" || rows) options.start = "full";
    if (rows) options.alignmentWeight = 2;
    const cost = estimateCost(surface.extent(), options);
    if (!(cost.memory < MOST_BYTES && cost.points < MOST_POINTS)) {
      large(`The line would have about ${count(cost.points)} points and take ${count(cost.memory / 1e6)} MB, more than a tab has room for; take a larger spacing, or fill it by the command.`);
    }
    const seed = closed.length && { points: positions, offsets, closed, loops: true, maxDistance: spacing };
    const flow = new Flow(surface, options, seed || null);
    run = { id, flow, cost, paused: false, spent: 0, shown: 0 };
    if (rows) flow.setDirections(axisField(rows, surface.vertexCount));
  } finally {
    surface.close();
  }
  picture();
  tick();
}

/** The present line, as the page draws it and saves it. */
function picture(ended = null) {
  const began = performance.now();
  const { positions, offsets, closed } = run.flow.polylines();
  const { normals } = run.flow.pointData("normals");
  const drawn = instancesOf({ positions, normals, offsets, closed }, mesh.fit);
  const message = {
    kind: "line", id: run.id, positions, normals, offsets, closed, drawn, ended, progress: run.flow.progress,
    spent: run.spent,
  };
  if (ended) {
    const { nodes, length } = run.flow.history().at(-1) ?? { nodes: 0, length: 0 };
    message.figures = { nodes, length };
  }
  // Where a run is stopped, most of the surface is empty, and looking at all of it takes long.
  if (ended && ended !== "cancelled") message.empty = run.flow.gaps().emptyShare;
  const arrays = [positions, normals, offsets, closed, drawn.points, drawn.ups];
  tell(message, arrays.map(({ buffer }) => buffer));
  run.shown = performance.now();
  run.next = run.shown + Math.max(PICTURE, PATIENCE * (run.shown - began));
}

// A message between two steps: timers wait for four milliseconds.
const turn = new MessageChannel();
turn.port1.onmessage = () => guarded(step);
const tick = () => turn.port2.postMessage(null);

function step() {
  if (!run || run.paused || run.ended) return;
  const began = performance.now();
  const reason = run.flow.step();
  run.spent += (performance.now() - began) / 1000;
  if (reason !== "running") return finish(reason);
  if (performance.now() >= run.next) picture();
  tick();
}

/** The mesh as a file that the command reads. */
function objOfMesh() {
  const lines = ["# Meander"];
  const { positions, faces } = mesh;
  for (let i = 0; i < positions.length; i += 3) lines.push(`v ${positions[i]} ${positions[i + 1]} ${positions[i + 2]}`);
  for (let i = 0; i < faces.length; i += 3) lines.push(`f ${faces[i] + 1} ${faces[i + 1] + 1} ${faces[i + 2] + 1}`);
  return `${lines.join("\n")}\n`;
}

function finish(reason) {
  run.ended = true;
  picture(reason);
}

/** The surface in two colours, once there is a line to part it. */
function sides({ id }) {
  if (!run?.ended) return;
  const cut = cutSurface(run.flow);
  const found = sidesOf(cut, mesh.fit, mesh.faces, mesh.normals);
  tell({ kind: "sides", id, ...found, parted: isParted(cut) }, Object.values(found).map(({ buffer }) => buffer));
}

const ANSWERS = {
  load,
  sides,
  /** The mesh of a worker before this one, which did not hear any more. */
  keep: (message) => void keep(message),
  fill: (message) => mesh && begin(message),
  pause({ paused }) {
    if (!run || run.ended) return;
    run.paused = paused;
    if (!paused) tick();
  },
  obj: ({ id }) => tell({ kind: "obj", id, text: objOfMesh() }),
  stop() {
    if (run && !run.ended) finish("cancelled");
  },
};

function guarded(work, id = run?.id) {
  try {
    work();
  } catch (problem) {
    const known = problem instanceof MeanderError;
    if (id === run?.id || !known) end(); // a file that cannot be read leaves the run as it is
    tell({ kind: "problem", id, text: known ? problem.message : `The page failed (${problem.message}); load it again.` });
  }
}

self.onmessage = async ({ data }) => {
  tell({ kind: "heard" });
  try {
    await ready;
  } catch (problem) {
    tell({ kind: "problem", id: data.id, text: problem.message });
    return;
  }
  guarded(() => ANSWERS[data.kind](data), data.id);
};

// SPDX-License-Identifier: GPL-3.0-or-later
//
// The library behind the page: reads meshes, and runs one flow at a time, a step between two messages.
import { EXAMPLES } from "./examples.mjs";
import { automaticSpacing, safeRepairs } from "../src/fill.mjs";
import { joined, readMesh } from "../src/files.mjs";
import { Flow } from "../src/flow.mjs";
import { MeanderError } from "../src/errors.mjs";
import { ready } from "../src/module.mjs";
import { estimateCost } from "../src/options.mjs";
import { Surface } from "../src/surface.mjs";

// What a tab has room for: a module has 4 GB at most, and the page draws what comes out.
const MOST_FACES = 2e6;
const MOST_BYTES = 2.5e9;
const MOST_POINTS = 5e6;
// Between two pictures of the growing line, and how many times what one takes.
const PICTURE = 60;
const PATIENCE = 4;

let mesh = null;
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

function read({ example, name, bytes, corners }) {
  if (example) return EXAMPLES[example]();
  if (!corners) return readMesh(new Uint8Array(bytes), name);
  return joined(corners);
}

/** Area, size and spacing of a mesh, and a copy of it for the page. */
function load(message) {
  end();
  const found = read(message);
  if (found.faces.length / 3 > MOST_FACES) {
    large(`${message.name ?? "The mesh"} has ${count(found.faces.length / 3)} faces, more than a tab has room for (${count(MOST_FACES)}); give a coarser one, or fill it by the command.`);
  }
  const spacing = automaticSpacing(found.positions, found.faces);
  // The page shows a mesh with all its faults; the library refuses what cannot be filled, with a sentence.
  const surface = new Surface(found.positions, found.faces, safeRepairs(found.positions, spacing));
  const figures = surface.statistics();
  surface.close();
  mesh = { ...found, area: figures.area };
  const positions = Float32Array.from(mesh.positions);
  tell({ kind: "mesh", id: message.id, positions, faces: mesh.faces, figures }, [positions.buffer]);
}

const axisField = (axis, vertices) => {
  const field = new Float64Array(3 * vertices);
  for (let i = "xyz".indexOf(axis); i < field.length; i += 3) field[i] = 1;
  return field;
};

function begin({ id, spacing, quality, rows, strokes }) {
  end();
  const surface = new Surface(mesh.positions, mesh.faces, safeRepairs(mesh.positions, spacing));
  try {
    const options = { preset: quality === "flowing" ? "even" : quality, radius: spacing / 2 };
    if (quality === "flowing" || rows) options.start = "full";
    if (rows) options.alignmentWeight = 2;
    const cost = estimateCost(surface.extent(), options);
    if (!(cost.memory < MOST_BYTES && cost.points < MOST_POINTS)) {
      large(`The line would have about ${count(cost.points)} points and take ${count(cost.memory / 1e6)} MB, more than a tab has room for; take a larger spacing, or fill it by the command.`);
    }
    const seed = strokes.length && {
      points: Float64Array.from(strokes.flatMap(({ points }) => Array.from(points))),
      offsets: strokes.reduce((ends, { points }) => [...ends, ends[ends.length - 1] + points.length / 3], [0]),
      closed: strokes.map(({ closed }) => Number(closed)),
      loops: true,
      maxDistance: spacing,
    };
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
  const message = {
    kind: "line", id: run.id, positions, normals, offsets, closed, ended, progress: run.flow.progress, spent: run.spent,
  };
  if (ended) {
    const { nodes, length } = run.flow.history().at(-1) ?? { nodes: 0, length: 0 };
    message.figures = { nodes, length };
  }
  // Where a run is stopped, most of the surface is empty, and looking at all of it takes long.
  if (ended && ended !== "cancelled") message.empty = run.flow.gaps().emptyShare;
  tell(message, [positions.buffer, normals.buffer, offsets.buffer, closed.buffer]);
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

const ANSWERS = {
  load,
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
    end();
    const known = problem instanceof MeanderError;
    tell({ kind: "problem", id, text: known ? problem.message : `The page failed (${problem.message}); load it again.` });
  }
}

self.onmessage = async ({ data }) => {
  try {
    await ready;
  } catch (problem) {
    tell({ kind: "problem", id: data.id, text: problem.message });
    return;
  }
  guarded(() => ANSWERS[data.kind](data), data.id);
};

// SPDX-License-Identifier: GPL-3.0-or-later
//
// The page: its controls, and what the worker says.
import { glbOf, objOf, plyOf, svgOf } from "./save.mjs";
import { readGlb } from "./glb.mjs";
import { View } from "./view.mjs";

const MOST_BYTES = 250e6; // of a file: its text and its numbers are in memory together

const of = (id) => document.getElementById(id);
const controls = Object.fromEntries(
  ["example", "file", "upright", "across", "quality", "rows", "thickness", "colours", "surface", "layout"].map((id) => [id, of(id)]),
);
const says = (id, text) => {
  if (of(id).textContent !== text) of(id).textContent = text;
};
const count = (number) => Math.round(number).toLocaleString("en");
const digits = (number, of = 3) => String(Number(number.toPrecision(of)));

/** What a test, and nothing else, looks at. */
const state = document.body.dataset;

let view = null;
let mesh = null; // name, suffix, area, diagonal
let line = null; // the latest, of the present run
let strokes = [];
let wish = 0; // the latest; what the worker says of others is late
let drawing = null;

const source = new Blob([of("worker").textContent], { type: "text/javascript" });
const worker = new Worker(URL.createObjectURL(source));
const ask = (message, transfer = []) => worker.postMessage({ ...message, id: wish }, transfer);

// ---- What the settings say --------------------------------------------------------------------------------------

const across = () => Number(controls.across.value);
// Of as many digits as the command says.
const spacing = () => Number((Math.sqrt(mesh.area) / across()).toPrecision(4));
const radiusOfTube = () => (Number(controls.thickness.value) * spacing()) / 2;

function look() {
  view.setLook({
    colours: controls.colours.value,
    radius: mesh ? radiusOfTube() : 0,
    surface: controls.surface.checked,
    upright: controls.upright.checked,
  });
}

function command() {
  const words = ["meander", "--input", mesh.suffix === "glb" ? `${mesh.stem}.obj` : mesh.name, "--spacing", digits(spacing(), 4)];
  const rows = controls.rows.value;
  if (rows) words.push("--quality", "rows", "--direction", rows);
  else words.push("--quality", controls.quality.value);
  if (strokes.length) words.push("--seed", `${mesh.stem}_seed.obj`);
  words.push("--output", `${mesh.stem}_line.obj`);
  return words.map((word) => (/^[\w.\/+-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`)).join(" ");
}

function describe() {
  says("across-value", String(across()));
  controls.quality.disabled = controls.rows.value !== "";
  if (!mesh) return;
  says("spacing", `${digits(spacing())} in the units of the mesh`);
  of("command").value = command();
}

// ---- Running ----------------------------------------------------------------------------------------------------

function setRunning(what) {
  state.run = what; // loading, running, paused, done, nothing
  const going = what === "running" || what === "paused";
  of("pause").disabled = of("stop").disabled = !going;
  of("again").disabled = !mesh || what === "loading";
  says("pause", what === "paused" ? "Go on" : "Pause");
  of("pause").setAttribute("aria-pressed", String(what === "paused"));
  for (const button of document.querySelectorAll(".save")) {
    const { kind } = button.dataset;
    button.disabled = kind === "mesh" ? !mesh : kind === "seed" ? strokes.length === 0 : !line;
  }
}

function fill() {
  if (!mesh) return;
  ++wish;
  line = null;
  state.pictures = "0";
  view.setLine(null);
  describe();
  look();
  says("problem", "");
  says("status", "Begins …");
  of("progress").value = 0;
  ask({ kind: "fill", spacing: spacing(), quality: controls.quality.value, rows: controls.rows.value, strokes });
  setRunning("running");
}

let delay = 0;
/** After the last of several changes. */
function fillSoon() {
  clearTimeout(delay);
  describe();
  delay = setTimeout(fill, 150);
}

function load(message, name, transfer = []) {
  clearTimeout(delay);
  ++wish;
  strokes = [];
  showStrokes();
  says("problem", "");
  says("status", `Reads ${name} …`);
  setRunning("loading");
  const [, stem, suffix] = /^(.*?)(?:\.(\w+))?$/.exec(name);
  loading = { name, stem, suffix: suffix?.toLowerCase() };
  ask({ kind: "load", name, ...message }, transfer);
}
let loading = null;

function example() {
  controls.upright.checked = true;
  load({ example: controls.example.value }, `${controls.example.value}.obj`);
}

async function open(file) {
  controls.example.querySelector("[value=own]").hidden = false;
  controls.example.value = "own";
  try {
    if (file.size > MOST_BYTES) {
      throw new Error(`${file.name} has ${count(file.size / 1e6)} MB, more than a tab has room for (${count(MOST_BYTES / 1e6)}); give a coarser mesh, or fill it by the command.`);
    }
    const bytes = await file.arrayBuffer();
    const glb = /\.glb$/i.test(file.name);
    controls.upright.checked = /\.(stl|ply)$/i.test(file.name);
    if (glb) {
      const corners = await readGlb(bytes);
      load({ corners }, file.name, [corners.buffer]);
    } else load({ bytes }, file.name, [bytes]);
  } catch (problem) {
    says("problem", problem.message);
    state.problems = String(Number(state.problems ?? 0) + 1);
  }
}

/** Seconds to the end, as people say them. */
function left(progress, spent) {
  if (progress < 0.02 || spent < 0.5) return "";
  const seconds = (spent * (1 - progress)) / progress;
  return seconds < 90 ? `about ${Math.max(1, Math.round(seconds))} s left` : `about ${Math.round(seconds / 60)} min left`;
}

const ENDS = {
  converged: "Done", stalled: "Done, as nothing can move any more", iteration_limit: "Ended at the limit", cancelled: "Stopped",
};
let told = 0;

const ANSWERS = {
  mesh({ positions, faces, figures }) {
    mesh = { ...loading, area: figures.area };
    view.setMesh(positions, faces);
    const mended = ["droppedFaces", "splitVertices", "cutEdges", "weldedEdges", "splitEdges", "openedEdges"].reduce((sum, key) => sum + figures[key], 0);
    const parts = figures.components === 1 ? "" : `, ${count(figures.components)} parts`;
    says("facts", `${count(figures.faces)} faces${parts}${mended ? `; ${count(mended)} faults mended` : ""}`);
    state.mesh = mesh.name;
    fill();
  },
  line({ ended, progress, spent, figures, empty, ...found }) {
    line = found;
    view.setLine(line);
    of("progress").value = ended ? 1 : progress;
    state.points = String(line.positions.length / 3);
    state.least = String(Math.min(Number(state.least ?? Infinity), line.positions.length / 3));
    state.pictures = String(Number(state.pictures ?? 0) + 1);
    state.first ??= String(Math.round(performance.now()));
    if (ended) {
      const share = empty >= 0.001 ? `, ${digits(100 * empty, 2)} % of the surface is empty` : "";
      says("status", `${ENDS[ended]}: ${count(figures.nodes)} nodes, ${digits(figures.length)} long${share}.`);
      says("left", "");
      setRunning("done");
      return;
    }
    // A screen reader hears it every five seconds, and not with every picture.
    if (performance.now() - told > 5000 || !told) {
      told = performance.now();
      says("status", `Grows: ${Math.round(100 * progress)} %`);
    }
    says("left", left(progress, spent));
    setRunning(state.run === "paused" ? "paused" : "running");
  },
  obj: ({ text }) => download("mesh", text),
  problem({ text }) {
    says("problem", text);
    says("status", "");
    state.problems = String(Number(state.problems ?? 0) + 1);
    setRunning(line ? "done" : "nothing");
  },
};

worker.onmessage = ({ data }) => {
  if (data.id !== wish) return;
  ANSWERS[data.kind](data);
};
worker.onerror = (event) => {
  says("problem", `The page failed (${event.message}); load it again.`);
  setRunning("nothing");
};

const stop = () => ask({ kind: "stop" });
function pause() {
  const paused = state.run === "running";
  ask({ kind: "pause", paused });
  setRunning(paused ? "paused" : "running");
  if (paused) says("status", "Paused");
}

// ---- A seed that is drawn ---------------------------------------------------------------------------------------

function showStrokes() {
  of("clear").disabled = strokes.length === 0;
  const [positions, normals, offsets, closed] = [[], [], [0], []];
  for (const stroke of [...strokes, ...(drawing ? [drawing] : [])]) {
    positions.push(...stroke.points);
    normals.push(...stroke.normals);
    offsets.push(positions.length / 3);
    closed.push(stroke.closed ? 1 : 0);
  }
  view?.setStrokes(offsets.length > 1 ? { positions, normals, offsets, closed } : null);
}

function setDrawing(on) {
  of("draw").setAttribute("aria-pressed", String(on));
  view.canvas.classList.toggle("drawing", on);
  view.controls.enabled = !on;
  says("hint", on ? "Draw on the surface; a stroke that comes back to its beginning is closed." : "Drag to turn, scroll to zoom. Drop a mesh to fill it.");
}

const isDrawing = () => of("draw").getAttribute("aria-pressed") === "true";

function drawTo(event) {
  const hit = view.placeAt(event);
  if (!hit) return;
  const { points } = drawing;
  const far = points.length === 0 || Math.hypot(...hit.point.map((x, k) => x - points[points.length - 3 + k])) > spacing() / 3;
  if (!far) return;
  points.push(...hit.point);
  drawing.normals.push(...hit.normal);
  showStrokes();
}

function endStroke() {
  const stroke = drawing;
  drawing = null;
  const n = stroke.points.length / 3;
  if (n >= 2) {
    const gap = Math.hypot(...[0, 1, 2].map((k) => stroke.points[k] - stroke.points[3 * n - 3 + k]));
    stroke.closed = n >= 6 && gap < 1.5 * spacing();
    strokes.push(stroke);
    fill();
  }
  showStrokes();
}

// ---- Saving -----------------------------------------------------------------------------------------------------

const AXES = {
  upright: { front: [[1, 0, 0], [0, 0, 1]], side: [[0, 1, 0], [0, 0, 1]], top: [[1, 0, 0], [0, 1, 0]] },
  lying: { front: [[1, 0, 0], [0, 1, 0]], side: [[0, 0, -1], [0, 1, 0]], top: [[1, 0, 0], [0, 0, -1]] },
};

async function contents(kind) {
  const upright = controls.upright.checked;
  if (kind === "obj") return objOf(line);
  if (kind === "seed") {
    return objOf({
      positions: strokes.flatMap(({ points }) => points),
      offsets: strokes.reduce((ends, { points }) => [...ends, ends[ends.length - 1] + points.length / 3], [0]),
      closed: strokes.map((stroke) => stroke.closed),
    });
  }
  if (kind === "ply") return plyOf(line);
  if (kind === "glb") return glbOf(line, radiusOfTube(), upright);
  if (kind === "png") return view.picture();
  const layout = controls.layout.value;
  const axes = layout === "view" ? view.axesInView() : AXES[upright ? "upright" : "lying"][layout];
  return svgOf(line, axes, 0.4 * spacing());
}

const ENDINGS = { mesh: ".obj", seed: "_seed.obj" };

async function save(kind) {
  if (kind === "mesh") ask({ kind: "obj" }); // the worker has it in all its digits
  else download(kind, await contents(kind));
}

function download(kind, text) {
  const link = document.createElement("a");
  const blob = new Blob([text]);
  link.href = URL.createObjectURL(blob);
  link.download = `${mesh.stem}${ENDINGS[kind] ?? `_line.${kind}`}`;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
  says("status", `Saved ${link.download}.`);
}

// ---- Beginning --------------------------------------------------------------------------------------------------

function listen() {
  controls.example.onchange = () => controls.example.value !== "own" && example();
  controls.file.onchange = () => controls.file.files[0] && open(controls.file.files[0]);
  controls.across.oninput = fillSoon;
  controls.quality.onchange = controls.rows.onchange = fillSoon;
  for (const id of ["thickness", "colours", "surface", "upright"]) controls[id].oninput = look;
  of("pause").onclick = pause;
  of("stop").onclick = stop;
  of("again").onclick = fill;
  of("draw").onclick = () => setDrawing(!isDrawing());
  of("clear").onclick = () => {
    strokes = [];
    showStrokes();
    fill();
  };
  for (const button of document.querySelectorAll(".save")) button.onclick = () => save(button.dataset.kind);
  of("copy").onclick = async () => {
    of("command").select();
    await (navigator.clipboard?.writeText(of("command").value) ?? document.execCommand("copy"));
    says("status", "Copied the command.");
  };
  of("panel").onsubmit = (event) => event.preventDefault();
  document.addEventListener("keydown", (event) => {
    if (event.key !== "Escape") return;
    if (isDrawing()) setDrawing(false);
    else stop();
  });
  const { canvas } = view;
  canvas.addEventListener("pointerdown", (event) => {
    if (!isDrawing() || !mesh || event.button !== 0) return;
    canvas.setPointerCapture(event.pointerId);
    drawing = { points: [], normals: [], closed: false };
    drawTo(event);
  });
  canvas.addEventListener("pointermove", (event) => drawing && drawTo(event));
  for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, () => drawing && endStroke());
  for (const over of ["dragenter", "dragover"]) {
    document.addEventListener(over, (event) => {
      event.preventDefault();
      of("drop").hidden = false;
    });
  }
  document.addEventListener("dragleave", (event) => {
    if (!event.relatedTarget) of("drop").hidden = true;
  });
  document.addEventListener("drop", (event) => {
    event.preventDefault();
    of("drop").hidden = true;
    if (event.dataTransfer.files[0]) open(event.dataTransfer.files[0]);
  });
}

try {
  view = new View(of("canvas"));
  listen();
  setRunning("loading");
  example();
} catch (problem) {
  says("problem", `This page draws by WebGL 2, which this browser does not give (${problem.message}).`);
}

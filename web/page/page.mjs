// SPDX-License-Identifier: GPL-3.0-or-later
//
// The page: its controls, and what the worker says.
import { glbOf, objOf, plyOf, svgOf } from "./save.mjs";
import { readGlb } from "./glb.mjs";
import { Library } from "./library.mjs";
import { Pen } from "./pen.mjs";
import { View } from "./view.mjs";

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

let [view, pen, library] = [null, null, null];
let mesh = null; // name, stem, suffix, area, positions, faces, polygons, and what Example says of it
let line = null; // the latest, of the present run
let number = 0; // of the latest question to the worker
let wish = 0; // the number of the present run; what is said of others is late
let reading = null; // the number and the name of a file that is being read, and whether settings have changed

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
  if (pen.strokes.length) words.push("--seed", `${mesh.stem}_seed.obj`);
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

const hasLine = () => line !== null && line.positions.length > 0;

function setRunning(what) {
  state.run = what; // running, paused, done, nothing
  const going = what === "running" || what === "paused";
  of("pause").disabled = !going;
  of("stop").disabled = !going && !reading;
  of("again").disabled = !mesh;
  says("pause", what === "paused" ? "Go on" : "Pause");
  for (const button of document.querySelectorAll(".save")) {
    const { kind } = button.dataset;
    button.disabled = kind === "mesh" ? !mesh : kind === "seed" ? pen.strokes.length === 0 : !hasLine();
  }
  of("clear").disabled = pen.strokes.length === 0;
}

function fill() {
  if (!mesh) return;
  describe();
  look();
  if (reading) {
    reading.changed = true;
    return;
  }
  wish = ++number;
  line = null;
  state.fill = String(wish);
  state.pictures = "0";
  delete state.sides;
  view.setLine(null);
  says("problem", "");
  says("status", "Begins …");
  says("left", "");
  of("progress").value = 0;
  const { positions, offsets, closed } = pen.seed();
  const seed = { positions, offsets, closed };
  const asked = { kind: "fill", id: wish, spacing: spacing(), quality: controls.quality.value, rows: controls.rows.value, seed };
  library.end(asked, () => {
    if (state.run === "paused") setRunning("running"); // who was told to pause is gone
    return true;
  });
  setRunning("running");
}

let delay = 0;
/** After the last of several changes. */
function fillSoon() {
  clearTimeout(delay);
  describe();
  delay = setTimeout(fill, 150);
}

function lengthOf({ positions, offsets, closed }) {
  const far = (i, j) => Math.hypot(...[0, 1, 2].map((k) => positions[3 * i + k] - positions[3 * j + k]));
  let length = 0;
  for (let s = 0; s < closed.length; ++s) {
    for (let i = offsets[s] + 1; i < offsets[s + 1]; ++i) length += far(i - 1, i);
    if (closed[s]) length += far(offsets[s + 1] - 1, offsets[s]);
  }
  return length;
}

/** The run is lost with its worker, and its line is kept. */
function kept() {
  wish = ++number;
  says("status", hasLine() ? `Stopped: ${digits(lengthOf(line))} long.` : "Stopped before there was a line.");
  says("left", "");
  setRunning("done");
}

function stop() {
  clearTimeout(delay);
  if (reading) {
    library.replace();
    notRead(`Stopped reading ${reading.name}.`);
  } else if (state.run === "running" || state.run === "paused") {
    const stopped = wish;
    library.end({ kind: "stop" }, () => {
      if (wish === stopped) kept();
      return false;
    });
  }
}

function pause() {
  const paused = state.run === "running";
  library.tell({ kind: "pause", paused });
  setRunning(paused ? "paused" : "running");
  if (paused) says("status", "Paused.");
}

// ---- Reading ----------------------------------------------------------------------------------------------------

function read(name, message) {
  clearTimeout(delay);
  const [, stem, suffix] = /^(.*?)(?:\.(\w+))?$/.exec(name);
  const { value } = controls.example;
  reading = { number: ++number, name, stem, suffix: suffix?.toLowerCase(), example: value };
  says("problem", "");
  says("status", `Reads ${name} …`);
  // A run is lost with a worker that does not hear; the worker that reads is not the one that ran.
  const going = state.run === "running" || state.run === "paused";
  library.end({ kind: "load", id: number, name, ...message }, () => {
    if (going) setRunning("done");
    return reading !== null;
  });
  setRunning(state.run ?? "nothing");
}

function example() {
  read(`${controls.example.value}.obj`, { example: controls.example.value });
}

function open(file) {
  controls.example.querySelector("[value=own]").hidden = false;
  controls.example.value = "own";
  read(file.name, { file });
}

/** What was there before stays. */
function notRead(status) {
  const { changed } = reading;
  reading = null;
  if (mesh) controls.example.value = mesh.example;
  if (/^(running|paused)$/.test(state.run) && library.heard === 0) kept(); // the worker that ran is gone
  controls.file.value = ""; // the same one may be chosen again
  says("status", status);
  setRunning(state.run);
  if (changed) fill();
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
  async glb({ bytes }) {
    const { number, name } = reading;
    try {
      const corners = await readGlb(bytes.buffer);
      if (reading?.number === number) read(name, { corners });
    } catch (problem) {
      if (reading?.number === number) ANSWERS.problem({ text: problem.message, id: number });
    }
  },
  mesh({ positions, faces, polygons, figures, fit, places, normals }) {
    const { name, stem, suffix, example } = reading;
    mesh = { name, stem, suffix, example, area: figures.area, positions, faces, polygons };
    reading = null;
    controls.upright.checked = example !== "own" || /^(stl|ply)$/.test(suffix);
    pen.forget();
    view.setMesh({ places, normals, faces, fit });
    const mended = ["droppedFaces", "splitVertices", "cutEdges", "weldedEdges", "splitEdges", "openedEdges"].reduce((sum, key) => sum + figures[key], 0);
    const parts = figures.components === 1 ? "" : `, ${count(figures.components)} parts`;
    says("facts", `${name}: ${count(figures.faces)} faces${parts}${mended ? `; ${count(mended)} faults mended` : ""}`);
    state.mesh = mesh.name;
    fill();
  },
  line({ ended, progress, spent, figures, empty, drawn, ...found }) {
    line = found;
    view.setLine(drawn);
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
      part();
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
  sides({ parted, ...found }) {
    view.setSides(found);
    if (!parted) says("status", `${of("status").textContent} Where it has one side only, the colours also meet halfway between its turns.`);
    state.sides = state.pictures;
  },
  obj: ({ text }) => download("mesh", text),
  problem({ text, id }) {
    says("problem", text);
    state.problems = String(Number(state.problems ?? 0) + 1);
    if (id === reading?.number) notRead("");
    else {
      says("status", "");
      setRunning(hasLine() ? "done" : "nothing");
    }
  },
};

/** Asks for the two sides of a line that is done. */
function part() {
  if (controls.colours.value === "sides" && state.run === "done" && hasLine() && state.sides !== state.pictures) {
    library.tell({ kind: "sides", id: wish });
  }
}

function answer(said) {
  if (said.id === (reading?.number ?? wish) || said.id === wish) ANSWERS[said.kind](said);
}

function failed(problem) {
  says("problem", `The page failed (${problem}); load it again.`);
  setRunning("nothing");
}

// ---- A seed that is drawn ---------------------------------------------------------------------------------------

const HINT = of("hint").textContent;

function setDrawing(on, byKeys) {
  of("draw").setAttribute("aria-pressed", String(on));
  pen.setOn(on, byKeys);
}

// ---- Saving -----------------------------------------------------------------------------------------------------

const AXES = {
  upright: { front: [[1, 0, 0], [0, 0, 1]], side: [[0, 1, 0], [0, 0, 1]], top: [[1, 0, 0], [0, 1, 0]] },
  lying: { front: [[1, 0, 0], [0, 1, 0]], side: [[0, 0, -1], [0, 1, 0]], top: [[1, 0, 0], [0, 0, -1]] },
};

async function contents(kind) {
  const upright = controls.upright.checked;
  if (kind === "obj") return objOf(line);
  if (kind === "seed") return objOf(pen.seed());
  if (kind === "ply") return plyOf(line);
  if (kind === "glb") return glbOf(line, radiusOfTube(), upright);
  if (kind === "png") return view.picture();
  const layout = controls.layout.value;
  const axes = layout === "view" ? view.axesInView() : AXES[upright ? "upright" : "lying"][layout];
  return svgOf(line, axes, 0.4 * spacing());
}

const ENDINGS = { mesh: ".obj", seed: "_seed.obj" };

async function save(kind) {
  if (kind === "mesh") library.tell({ kind: "obj", id: wish }); // the worker has it in all its digits
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
  controls.colours.onchange = part;
  of("pause").onclick = pause;
  of("stop").onclick = stop;
  of("again").onclick = fill;
  of("draw").onclick = (event) => setDrawing(!pen.on, event.detail === 0); // no click, but a key
  of("clear").onclick = () => {
    pen.forget();
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
    if (!pen.on) return stop();
    setDrawing(false);
    if (document.activeElement === view.canvas) of("draw").focus();
  });
  view.canvas.addEventListener("keydown", (event) => pen.key(event) || view.key(event));
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
  pen = new Pen(view, of("pen"), {
    spacing,
    changed: fill,
    say: (words) => says("status", words),
    hint: (words) => says("hint", words ?? HINT),
  });
  library = new Library(of("worker").textContent, { answer, failed, mesh: () => mesh });
  listen();
  example();
} catch (problem) {
  says("problem", `This page draws by WebGL 2, which this browser does not give (${problem.message}).`);
}

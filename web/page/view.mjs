// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is seen: the surface, its line, and strokes that are drawn; a picture only when something has changed.
import { BufferAttribute, Color, ColorManagement, Group, PerspectiveCamera, Raycaster, Scene, Vector2, Vector3, WebGLRenderer } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { instancesOf } from "./instances.mjs";
import { newSurface, newTube, shape } from "./tube.mjs";

const COLOURS = {
  clay: { surface: "#e3d9cb", line: "#b8401c" },
  ink: { surface: "#f7f5f0", line: "#34363f" },
  rainbow: { surface: "#4a4d57", line: "#b8401c" },
  sides: { surface: "#f0e4d2", line: "#b8401c" }, // until the line is done, and of the two sides after that
};
// The shaders compute with colours as they are seen.
ColorManagement.enabled = false;

const TURN = 0.12; // radians for an arrow key

export class View {
  constructor(canvas) {
    this.canvas = canvas;
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.scene = new Scene();
    this.camera = new PerspectiveCamera(35, 1, 0.01, 50);
    this.camera.position.set(1.6, 1.5, 2.6);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener("change", () => this.draw());
    this.body = new Group();
    this.surface = newSurface(new Color(), new Color());
    this.sides = newSurface(new Color(), new Color());
    this.sides.visible = false;
    this.line = newTube(new Color());
    this.strokes = newTube(new Color("#2f6fd0"));
    this.body.add(this.surface, this.sides, this.line, this.strokes);
    this.scene.add(this.body);
    this.fit = { centre: [0, 0, 0], scale: 1 };
    this.look = null;
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
    this.resize();
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / Math.max(height, 1);
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  draw() {
    this.wanted ??= requestAnimationFrame(() => {
      this.wanted = undefined;
      this.renderer.render(this.scene, this.camera);
    });
  }

  /** Arrow keys turn, plus and minus zoom. */
  key(event) {
    const turns = { ArrowLeft: [-TURN, 0], ArrowRight: [TURN, 0], ArrowUp: [0, -TURN], ArrowDown: [0, TURN] };
    const zooms = { "+": 0.9, "=": 0.9, "-": 1.1 };
    const offset = this.camera.position.clone().sub(this.controls.target);
    if (turns[event.key]) {
      const [sideways, upwards] = turns[event.key];
      offset.applyAxisAngle(new Vector3(0, 1, 0), sideways);
      const angle = offset.angleTo(new Vector3(0, 1, 0)) + upwards;
      if (angle > 0.05 && angle < Math.PI - 0.05) {
        offset.applyAxisAngle(new Vector3(offset.z, 0, -offset.x).normalize(), upwards);
      }
    } else if (zooms[event.key]) offset.multiplyScalar(zooms[event.key]);
    else return;
    event.preventDefault();
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
    this.draw();
  }

  /** Another surface, as fit.mjs has placed it. */
  setMesh({ places, normals, faces, fit }) {
    this.fit = fit;
    this.#give(this.surface, { position: [places, 3], normal: [normals, 3] }, faces);
    this.setLine(null);
    this.setStrokes(null);
  }

  #give(surface, attributes, faces) {
    const { geometry } = surface;
    geometry.dispose();
    for (const [name, [array, width]] of Object.entries(attributes)) geometry.setAttribute(name, new BufferAttribute(array, width));
    geometry.setIndex(faces && new BufferAttribute(faces, 1));
    geometry.computeBoundingSphere();
    geometry.computeBoundingBox();
  }

  /** A line as instances.mjs has it; null: none. */
  setLine(drawn) {
    if (drawn) shape(this.line, drawn);
    this.hasLine = drawn !== null;
    this.hasSides = false;
    this.#show();
  }

  /** The surface in two colours, in place of the line between them. */
  setSides({ places, normals, tones }) {
    this.#give(this.sides, { position: [places, 3], normal: [normals, 3], tone: [tones, 1] }, null);
    this.hasSides = true;
    this.#show();
  }

  setStrokes(strokes) {
    if (strokes) shape(this.strokes, instancesOf(strokes, this.fit));
    this.strokes.visible = strokes !== null;
    this.draw();
  }

  /** `radius` of the tube in the units of the mesh. */
  setLook({ colours, radius, surface, upright }) {
    this.look = { colours, surface };
    this.line.material.uniforms.colour.value.set(COLOURS[colours].line);
    this.line.material.uniforms.rainbow.value = colours === "rainbow" ? 1 : 0;
    for (const { material } of [this.surface, this.sides]) {
      material.uniforms.colour.value.set(COLOURS[colours].surface);
      material.uniforms.other.value.set(COLOURS[colours].line);
    }
    for (const tube of [this.line, this.strokes]) tube.material.uniforms.radius.value = radius * this.fit.scale;
    this.body.rotation.x = upright ? -Math.PI / 2 : 0;
    this.#show();
  }

  #show() {
    const parted = this.hasSides && this.look.colours === "sides";
    this.sides.visible = parted;
    this.line.visible = this.hasLine && !parted;
    this.surface.visible = !parted && Boolean(this.look?.surface);
    this.draw();
  }

  /** The place on the surface at a place of the picture, in the units of the mesh; null: there is none. */
  placeAt([x, y]) {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const pointer = new Vector2((2 * x) / width - 1, 1 - (2 * y) / height);
    const ray = new Raycaster();
    ray.setFromCamera(pointer, this.camera);
    const hit = ray.intersectObject(this.surface, false)[0];
    if (!hit) return null;
    const normal = hit.face.normal;
    const place = this.body.worldToLocal(hit.point.clone());
    return {
      point: place.toArray().map((x, axis) => x / this.fit.scale + this.fit.centre[axis]),
      normal: normal.toArray(),
    };
  }

  /** Two axes of the mesh's space that lie in the picture, to the right and up. */
  axesInView() {
    const turn = this.camera.matrixWorld.clone().premultiply(this.body.matrixWorld.clone().invert());
    return [0, 1].map((column) => new Vector3().setFromMatrixColumn(turn, column).normalize().toArray());
  }

  picture() {
    this.renderer.render(this.scene, this.camera);
    return new Promise((resolve) => this.canvas.toBlob(resolve, "image/png"));
  }
}

// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is seen: the surface, its line, and strokes that are drawn; a picture only when something has changed.
import { BufferAttribute, Color, ColorManagement, Group, PerspectiveCamera, Raycaster, Scene, Vector2, Vector3, WebGLRenderer } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { newSurface, newTube, shape } from "./tube.mjs";

const COLOURS = {
  clay: { surface: "#e3d9cb", line: "#b8401c" },
  ink: { surface: "#f7f5f0", line: "#34363f" },
  rainbow: { surface: "#4a4d57", line: "#b8401c" },
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
    this.surface = newSurface(new Color());
    this.line = newTube(new Color());
    this.strokes = newTube(new Color("#2f6fd0"));
    this.body.add(this.surface, this.line, this.strokes);
    this.scene.add(this.body);
    this.centre = [0, 0, 0];
    this.scale = 1;
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
    this.resize();
    canvas.addEventListener("keydown", (event) => this.key(event));
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

  /** Another surface, fitted to the picture. */
  setMesh(positions, faces) {
    const [low, high] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
    for (const corner of faces) {
      for (let axis = 0; axis < 3; ++axis) {
        low[axis] = Math.min(low[axis], positions[3 * corner + axis]);
        high[axis] = Math.max(high[axis], positions[3 * corner + axis]);
      }
    }
    this.centre = low.map((x, axis) => (x + high[axis]) / 2);
    this.scale = 2 / Math.hypot(...low.map((x, axis) => high[axis] - x));
    const fitted = positions.map((x, i) => (x - this.centre[i % 3]) * this.scale);
    const { geometry } = this.surface;
    geometry.dispose();
    geometry.setAttribute("position", new BufferAttribute(fitted, 3));
    geometry.setIndex(new BufferAttribute(faces, 1));
    geometry.deleteAttribute("normal");
    geometry.computeVertexNormals();
    geometry.computeBoundingSphere();
    geometry.computeBoundingBox();
    this.setLine(null);
    this.setStrokes(null);
  }

  setLine(line) {
    if (line) shape(this.line, line, this.centre, this.scale);
    this.line.visible = line !== null;
    this.draw();
  }

  setStrokes(strokes) {
    if (strokes) shape(this.strokes, strokes, this.centre, this.scale);
    this.strokes.visible = strokes !== null;
    this.draw();
  }

  /** `radius` of the tube in the units of the mesh. */
  setLook({ colours, radius, surface, upright }) {
    this.line.material.uniforms.colour.value.set(COLOURS[colours].line);
    this.line.material.uniforms.rainbow.value = colours === "rainbow" ? 1 : 0;
    this.surface.material.uniforms.colour.value.set(COLOURS[colours].surface);
    for (const tube of [this.line, this.strokes]) tube.material.uniforms.radius.value = radius * this.scale;
    this.surface.visible = surface;
    this.body.rotation.x = upright ? -Math.PI / 2 : 0;
    this.draw();
  }

  /** The place on the surface below the pointer, in the units of the mesh; null: there is none. */
  placeAt(event) {
    const box = this.canvas.getBoundingClientRect();
    const pointer = new Vector2(
      (2 * (event.clientX - box.left)) / box.width - 1,
      1 - (2 * (event.clientY - box.top)) / box.height,
    );
    const ray = new Raycaster();
    ray.setFromCamera(pointer, this.camera);
    const hit = ray.intersectObject(this.surface, false)[0];
    if (!hit) return null;
    const normal = hit.face.normal;
    const place = this.body.worldToLocal(hit.point.clone());
    return {
      point: place.toArray().map((x, axis) => x / this.scale + this.centre[axis]),
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

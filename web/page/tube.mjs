// SPDX-License-Identifier: GPL-3.0-or-later
//
// A line as a tube: drawn by the graphics card from its points alone, and as triangles for files.
import { BufferGeometry, DoubleSide, Float32BufferAttribute, InstancedBufferGeometry, InstancedInterleavedBuffer, InterleavedBufferAttribute, Mesh, ShaderMaterial } from "three";

const SIDES = 8;

/** The light of both the surface and the line, in the space of the camera. */
export const LIGHT = `
  vec3 lit(vec3 colour, vec3 normal) {
    vec3 n = normalize(normal);
    float key = max(dot(n, normalize(vec3(-0.4, 0.7, 0.8))), 0.0);
    float sky = 0.5 + 0.5 * n.y;
    float rim = pow(1.0 - max(n.z, 0.0), 3.0);
    return colour * (0.32 + 0.28 * sky + 0.55 * key) + 0.12 * rim;
  }
`;

const VERTEX = `
  attribute vec4 before, here, there, after;
  attribute vec4 upHere, upThere;
  uniform float radius;
  varying vec3 facing;
  varying float share;
  vec3 along(vec3 a, vec3 b, vec3 otherwise) {
    vec3 d = b - a;
    return dot(d, d) > 0.0 ? normalize(d) : otherwise;
  }
  void main() {
    vec3 piece = along(here.xyz, there.xyz, vec3(1.0, 0.0, 0.0));
    bool end = position.z > 0.5;
    vec3 centre = end ? there.xyz : here.xyz;
    vec3 t = end ? along(here.xyz, after.xyz, piece) : along(before.xyz, there.xyz, piece);
    vec4 given = end ? upThere : upHere;
    vec3 up = given.xyz - dot(given.xyz, t) * t;
    up = dot(up, up) > 1e-8 ? normalize(up) : normalize(cross(t, vec3(0.3, 0.5, 0.8)));
    vec3 out_ = position.x * up + position.y * cross(t, up);
    facing = normalMatrix * out_;
    share = given.w;
    vec3 place = centre + radius * (out_ + 0.4 * up);
    // What lies between two strands is no piece: it shrinks to a point.
    gl_Position = here.w > 0.5 ? projectionMatrix * modelViewMatrix * vec4(place, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
  }
`;

const FRAGMENT = `
  uniform vec3 colour;
  uniform float rainbow;
  varying vec3 facing;
  varying float share;
  ${LIGHT}
  void main() {
    vec3 spectrum = 0.55 + 0.45 * cos(6.2832 * (share + vec3(0.0, 0.36, 0.68)));
    gl_FragColor = vec4(lit(mix(colour, spectrum, rainbow), facing), 1.0);
  }
`;

/** A tube without points. */
export function newTube(colour) {
  const geometry = new InstancedBufferGeometry();
  const [ring, index] = [[], []];
  for (let end = 0; end < 2; ++end) {
    for (let k = 0; k < SIDES; ++k) ring.push(Math.cos((2 * Math.PI * k) / SIDES), Math.sin((2 * Math.PI * k) / SIDES), end);
  }
  for (let k = 0; k < SIDES; ++k) {
    const next = (k + 1) % SIDES;
    index.push(k, next, SIDES + next, k, SIDES + next, SIDES + k);
  }
  geometry.setAttribute("position", new Float32BufferAttribute(ring, 3));
  geometry.setIndex(index);
  geometry.instanceCount = 0;
  const uniforms = { radius: { value: 0.01 }, colour: { value: colour }, rainbow: { value: 0 } };
  const material = new ShaderMaterial({ uniforms, vertexShader: VERTEX, fragmentShader: FRAGMENT, side: DoubleSide });
  const mesh = new Mesh(geometry, material);
  mesh.frustumCulled = false;
  return mesh;
}

/** Gives a tube the instances of a line. */
export function shape(tube, { points, ups, pieces }) {
  const { geometry } = tube;
  const buffers = [points, ups].map((array) => new InstancedInterleavedBuffer(array, 4));
  const name = (key, buffer, behind) => geometry.setAttribute(key, new InterleavedBufferAttribute(buffers[buffer], 4, 4 * behind));
  geometry.dispose(); // the buffers of the line before
  name("before", 0, 0);
  name("here", 0, 1);
  name("there", 0, 2);
  name("after", 0, 3);
  name("upHere", 1, 1);
  name("upThere", 1, 2);
  geometry.instanceCount = pieces;
}

/** The tube as triangles: positions, normals and indices, in the units of the line. */
export function triangles({ positions, normals, offsets, closed }, radius) {
  const count = positions.length / 3;
  const [places, facings] = [new Float32Array(3 * SIDES * count), new Float32Array(3 * SIDES * count)];
  const index = [];
  const at = (array, i) => [array[3 * i], array[3 * i + 1], array[3 * i + 2]];
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const unit = (a, otherwise) => {
    const length = Math.hypot(...a);
    return length > 0 ? a.map((x) => x / length) : otherwise;
  };
  for (let s = 0; s + 1 < offsets.length; ++s) {
    const [first, n] = [offsets[s], offsets[s + 1] - offsets[s]];
    const neighbour = (i) => first + (closed[s] ? (i + n) % n : Math.min(Math.max(i, 0), n - 1));
    for (let i = 0; i < n; ++i) {
      const [before, after] = [at(positions, neighbour(i - 1)), at(positions, neighbour(i + 1))];
      const t = unit(after.map((x, k) => x - before[k]), [1, 0, 0]);
      const given = at(normals, first + i);
      const up = unit(given.map((x, k) => x - dot(given, t) * t[k]), [0, 0, 1]);
      const side = [t[1] * up[2] - t[2] * up[1], t[2] * up[0] - t[0] * up[2], t[0] * up[1] - t[1] * up[0]];
      const centre = at(positions, first + i);
      for (let k = 0; k < SIDES; ++k) {
        const [c, d] = [Math.cos((2 * Math.PI * k) / SIDES), Math.sin((2 * Math.PI * k) / SIDES)];
        for (let axis = 0; axis < 3; ++axis) {
          const out = c * up[axis] + d * side[axis];
          const place = 3 * (SIDES * (first + i) + k) + axis;
          facings[place] = out;
          places[place] = centre[axis] + radius * (out + 0.4 * up[axis]);
        }
      }
      if (!closed[s] && i === n - 1) continue;
      const [a, b] = [SIDES * (first + i), SIDES * neighbour(i + 1)];
      for (let k = 0; k < SIDES; ++k) {
        const next = (k + 1) % SIDES;
        index.push(a + k, a + next, b + next, a + k, b + next, b + k);
      }
    }
  }
  return { places, facings, index: Uint32Array.from(index) };
}

/** The surface below the line; where its geometry has tones, those above a half have the other colour. */
export function newSurface(colour, other) {
  const material = new ShaderMaterial({
    uniforms: { colour: { value: colour }, other: { value: other } },
    vertexShader: "attribute float tone; varying float toned; varying vec3 facing; void main() { toned = tone; facing = normalMatrix * normal; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }",
    fragmentShader: `uniform vec3 colour, other; varying float toned; varying vec3 facing; ${LIGHT} void main() { gl_FragColor = vec4(lit(toned > 0.5 ? other : colour, gl_FrontFacing ? facing : -facing), 1.0); }`,
    side: DoubleSide,
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 1,
  });
  return new Mesh(new BufferGeometry(), material);
}

// SPDX-License-Identifier: GPL-3.0-or-later
import { Vector3 } from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";

/** The corners of all triangles of a GLB file, nine numbers each, in the space of its scene. */
export async function readGlb(bytes) {
  let scene = null;
  try {
    ({ scene } = await new GLTFLoader().parseAsync(bytes, ""));
  } catch (problem) {
    throw new Error(`The file is no GLB file that can be read (${problem.message}); export it again, without compression.`);
  }
  const corners = [];
  const place = new Vector3();
  scene.updateMatrixWorld(true);
  scene.traverse((object) => {
    if (!object.isMesh) return;
    const { position } = object.geometry.attributes;
    const index = object.geometry.index ?? { count: position.count, getX: (i) => i };
    for (let i = 0; i < index.count; ++i) {
      object.getVertexPosition(index.getX(i), place).applyMatrix4(object.matrixWorld);
      corners.push(place.x, place.y, place.z);
    }
  });
  if (corners.length === 0) throw new Error("The file has no faces; give a mesh with triangles.");
  return Float64Array.from(corners);
}

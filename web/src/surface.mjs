// SPDX-License-Identifier: GPL-3.0-or-later
import * as abi from "meander:abi";
import { checkedArray, oneForEach } from "./arrays.mjs";
import { calling, chosen, Handle, namesOf } from "./calls.mjs";
import { MeanderError } from "./errors.mjs";
import { native } from "./module.mjs";
import { wideOffsets } from "./seed.mjs";

export const CURVATURES = namesOf(abi.Curvature);
export const DIRECTIONS = namesOf(abi.Directions);
export const FAULTS = namesOf(abi.Fault);

const FLAGS = {
  dropDegenerate: "drop_degenerate",
  splitBowTies: "split_bow_ties",
  cutNonManifold: "cut_non_manifold",
  makeManifold: "make_manifold",
  dropDoubled: "drop_doubled",
};
const LENGTHS = {
  mergeDistance: "merge_distance",
  weldDistance: "weld_distance",
  smallestPart: "smallest_part",
  maskThreshold: "mask_threshold",
};
const MASKS = {
  faceMask: ["face_mask", Uint8Array, "faces"],
  polygons: ["polygons", Uint32Array, "faces"],
  vertexMask: ["vertex_mask", Float64Array, "vertices"],
};

function surfaceOptions(call, options, counts) {
  const record = call.struct(abi.SurfaceOptionsRecord, native.meander_surface_options_init);
  for (const [key, value] of Object.entries(options ?? {})) {
    if (value == null) continue;
    if (key in FLAGS) record.set(FLAGS[key], value ? 1 : 0);
    else if (key in LENGTHS) record.set(LENGTHS[key], Number(value));
    else if (key in MASKS) {
      const [name, Type, elements] = MASKS[key];
      const array = oneForEach(key, value, Type, counts[elements], `${elements} of the mesh`);
      record.set(name, call.copy(array));
      record.set(`${name}_count`, array.length);
    } else {
      const names = Object.keys({ ...FLAGS, ...LENGTHS, ...MASKS });
      throw new MeanderError(`there is no surface option '${key}'; those there are: ${names.join(", ")}`);
    }
  }
  return record.address;
}

/** Address and count of vertices, and of faces. */
function meshArguments(call, positions, faces) {
  const vertices = checkedArray("positions", positions, Float64Array, 3);
  const corners = checkedArray("faces", faces, Uint32Array, 3);
  return [call.copy(vertices), vertices.length / 3, call.copy(corners), corners.length / 3];
}

function closestPoints(call, points, find) {
  const asked = checkedArray("points", points, Float64Array, 3);
  const count = asked.length / 3;
  const [faces, weights, distances] = [call.memory(4 * count), call.memory(24 * count), call.memory(8 * count)];
  call.check(find(call.copy(asked), count, 1, faces, weights, distances, 0, call.error.address));
  return {
    faces: call.read(Uint32Array, faces, count),
    weights: call.read(Float64Array, weights, 3 * count),
    distances: call.read(Float64Array, distances, count),
  };
}

/** The points of any list of triangles, however faulty, that are nearest to points in space. */
export function findClosest(positions, faces, points) {
  return calling((call) => {
    const mesh = meshArguments(call, positions, faces);
    return closestPoints(call, points, (...rest) => native.meander_mesh_find_closest(...mesh, ...rest));
  });
}

/** All that is wrong with a mesh, where Surface names the first. */
export function findFaults(positions, faces, weldDistance = 0) {
  return calling((call) => {
    const found = call.result(abi.FaultsRecord, native.meander_faults_init);
    const mesh = meshArguments(call, positions, faces);
    call.check(native.meander_mesh_find_faults(...mesh, weldDistance, found.address, 0, call.error.address));
    const count = found.get("count");
    return { kinds: found.array("kinds", count), elements: found.array("elements", 2 * count) };
  });
}

/** A triangle mesh that the library has checked and copied. */
export class Surface extends Handle {
  constructor(positions, faces, options = null) {
    const { address, vertexCount } = calling((call) => {
      const mesh = meshArguments(call, positions, faces);
      const record = surfaceOptions(call, options, { vertices: mesh[1], faces: mesh[3] });
      const surface = call.memory(4);
      call.check(native.meander_surface_create(...mesh, record, surface, 0, call.error.address));
      return { address: call.pointer(surface), vertexCount: mesh[1] };
    });
    super(address, native.meander_surface_destroy);
    this.vertexCount = vertexCount;
  }

  /** Figures of the surface, and what the options did. */
  statistics() {
    return calling((call) => {
      const record = call.struct(abi.SurfaceStatisticsRecord, native.meander_surface_statistics_init);
      call.check(native.meander_surface_get_statistics(this.address, record.address, call.error.address));
      const { flippedFaces, ...others } = record.figures();
      return { ...others, turnedFaces: flippedFaces };
    });
  }

  /** What there is to fill, for estimateCost. */
  extent(density = null) {
    return calling((call) => {
      const values = density == null ? null : checkedArray("density", density, Float64Array);
      const record = call.struct(abi.ExtentRecord, native.meander_extent_init);
      call.check(
        native.meander_surface_measure_extent(
          this.address, call.copy(values), values?.length ?? 0, record.address, call.error.address,
        ),
      );
      return record.figures();
    });
  }

  /** The points of the surface nearest to points in space. */
  findClosest(points) {
    return calling((call) =>
      closestPoints(call, points, (...rest) => native.meander_surface_find_closest(this.address, ...rest)),
    );
  }

  /** Curvature at every vertex, of a kind of CURVATURES, averaged over the radius `smoothing`. */
  curvature(kind, smoothing = 0) {
    return calling((call) => {
      const values = call.memory(8 * this.vertexCount);
      const number = chosen("kind of curvature", kind, abi.Curvature);
      call.check(
        native.meander_surface_compute_curvature(
          this.address, number, smoothing, values, this.vertexCount, 0, call.error.address,
        ),
      );
      return call.read(Float64Array, values, this.vertexCount);
    });
  }

  /** A field of lines, of a kind of DIRECTIONS: a vector at every vertex. */
  directions(kind, smoothing = 0) {
    return calling((call) => {
      const values = call.memory(24 * this.vertexCount);
      const number = chosen("kind of directions", kind, abi.Directions);
      call.check(
        native.meander_surface_compute_directions(
          this.address, number, smoothing, values, this.vertexCount, 0, call.error.address,
        ),
      );
      return call.read(Float64Array, values, 3 * this.vertexCount);
    });
  }

  /** The field of lines that follows strokes drawn on the surface, and is smooth elsewhere. */
  extendedDirections(points, offsets) {
    return calling((call) => {
      const asked = checkedArray("points", points, Float64Array, 3);
      const ends = wideOffsets("the strokes", offsets, asked.length / 3);
      const values = call.memory(24 * this.vertexCount);
      call.check(
        native.meander_surface_compute_stroke_directions(
          this.address, call.copy(asked), asked.length / 3, call.copy(ends), ends.length - 1, values,
          this.vertexCount, 0, call.error.address,
        ),
      );
      return call.read(Float64Array, values, 3 * this.vertexCount);
    });
  }

  /** Lines along the boundary, as guides of a seed, and how many stretches were left out. */
  outlines(distance, spacing) {
    return calling((call) => {
      const found = call.result(abi.OutlinesRecord, native.meander_outlines_init);
      call.check(
        native.meander_surface_find_outlines(this.address, distance, spacing, found.address, 0, call.error.address),
      );
      const strands = found.get("strand_count");
      const seed = {
        points: found.array("positions", 3 * found.get("point_count")),
        offsets: found.array("offsets", strands + 1),
        closed: found.array("closed", strands),
        guides: new Uint8Array(strands).fill(1),
        loops: true,
      };
      return { seed, skipped: found.get("skipped_count") };
    });
  }
}

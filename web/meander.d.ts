// SPDX-License-Identifier: GPL-3.0-or-later
//
// The library in JavaScript. Lengths are in the units of the positions, indices start at zero. Arrays that are given
// are copied, arrays that are returned are yours. Names are those of the Python package in camelCase; meander.h says
// more of each. Everything blocks until it is done: on a page, call it in a Worker.

/** Comes true when the library can be called. */
export const ready: Promise<void>;

export const VERSION: string;
export const ABI_VERSION: number;

type Numbers = ArrayLike<number>;

export type Preset = "even" | "paper" | "finest";
export type StopReason = "running" | "converged" | "iteration_limit" | "stalled" | "cancelled";
export type Phase = "none" | "growth" | "hairpin_removal" | "polish";
export type Curvature = "gaussian" | "mean" | "absolute_gaussian" | "absolute_mean" | "curvedness";
export type Directions = "curvature_min" | "curvature_max" | "smooth" | "boundary";
export type Alignment = "along" | "across";

export const PRESETS: Preset[];
export const STOP_REASONS: StopReason[];
export const PHASES: Phase[];
export const CURVATURES: Curvature[];
export const DIRECTIONS: Directions[];
export const ALIGNMENTS: Alignment[];
/** Names of the numbers in Faults.kinds. */
export const FAULTS: string[];

/** Something that a person can put right: `message` is one sentence that says how. */
export class MeanderError extends Error {
  status: "invalid_argument" | "invalid_mesh" | "invalid_seed" | "cancelled" | "out_of_memory" | "internal";
  /** What `elements` counts. */
  elementKind: "vertex" | "face" | "edge" | "seed_point" | null;
  elements: number[];
}

/** Options of a flow, as in meander_flow_options; what is left out is as the preset has it. */
export interface FlowOptions {
  preset?: Preset;
  /** Half the spacing; 0: the automatic one. */
  radius?: number;
  segmentLength?: number;
  maxRadius?: number;
  maxRadiusFactor?: number;
  lengthWeight?: number;
  bendingWeight?: number;
  medialWeight?: number;
  alignmentWeight?: number;
  lengthPower?: number;
  medialPower?: number;
  step?: number;
  startSpacingFactor?: number;
  boundaryDistance?: number;
  polishBendingWeight?: number;
  boundaryRule?: "centre" | "obstacle";
  medialAxis?: "euclidean" | "geodesic";
  stopRule?: "settled" | "paper";
  growIntoEmpty?: number | boolean;
  widenLoops?: number | boolean;
  holdEnds?: number | boolean;
  hairpinRemovalIterations?: number;
  polish?: number | boolean;
  iterationLimit?: number;
  threads?: number;
  roughness?: number;
  start?: "grow" | "full";
  /** Another whole number, another curve. */
  variation?: number;
  /** Experimental: their names, ranges and defaults may change with every version. */
  tunings?: Record<string, number>;
}

/** The library's defaults of a preset. */
export function defaultOptions(preset?: Preset): Required<FlowOptions>;
/** What is allowed but seldom meant in the options, one sentence each. */
export function optionWarnings(options: FlowOptions): string[];

/** What to do with a mesh before it is checked; see meander_surface_options. */
export interface SurfaceOptions {
  mergeDistance?: number;
  dropDegenerate?: boolean;
  splitBowTies?: boolean;
  cutNonManifold?: boolean;
  makeManifold?: boolean;
  weldDistance?: number;
  smallestPart?: number;
  dropDoubled?: boolean;
  /** One for each face: those with 0 are left out. */
  faceMask?: Numbers | null;
  /** One for each vertex: what lies below maskThreshold is cut away. */
  vertexMask?: Numbers | null;
  maskThreshold?: number;
  /** Of which polygon each face is a part. */
  polygons?: Numbers | null;
}

export interface SurfaceStatistics {
  vertices: number;
  faces: number;
  components: number;
  boundaryLoops: number;
  turnedFaces: number;
  unusedVertices: number;
  mergedVertices: number;
  droppedFaces: number;
  splitVertices: number;
  cutEdges: number;
  maskedFaces: number;
  clippedFaces: number;
  weldedEdges: number;
  openedEdges: number;
  doubledFaces: number;
  splitEdges: number;
  smallParts: number;
  area: number;
  diagonal: number;
}

export interface Extent {
  faces: number;
  lengthArea: number;
  nodeArea: number;
  edgeDensity: number;
  curvature: number;
}

export interface Cost {
  nodes: number;
  points: number;
  length: number;
  /** Bytes that the library holds at most; those of a module are about as many. */
  memory: number;
  processorSeconds: number;
}

/** What filling an extent costs, before it begins. */
export function estimateCost(extent: Extent, options: FlowOptions): Cost;

export interface Closest {
  faces: Uint32Array;
  /** Three for each point. */
  weights: Float64Array;
  distances: Float64Array;
}

export function findClosest(positions: Numbers, faces: Numbers, points: Numbers): Closest;

export interface Faults {
  /** Places in FAULTS, rising. */
  kinds: Uint32Array;
  /** Two for each: a vertex or a face twice, or the vertices of an edge. */
  elements: Uint32Array;
}

export function findFaults(positions: Numbers, faces: Numbers, weldDistance?: number): Faults;

/** Strands to start from. */
export interface Seed {
  /** Three numbers for each point, strand after strand. */
  points: Numbers;
  /** Where each strand begins, and the number of points; left out: all points are one strand. */
  offsets?: Numbers;
  /** For each strand 1 closed, 0 open; left out: all open. */
  closed?: Numbers;
  /** For each point 1: it never moves. */
  fixed?: Numbers | null;
  /** For each strand 1: it stays as it is, and the others keep away from it. */
  guides?: Numbers | null;
  /** Regions between guides, and components, without a growing strand get a small loop. */
  loops?: boolean;
  /** How far from the surface a point may be. */
  maxDistance?: number;
}

/** An object of the library's. Its memory is freed when the collector comes to it, or at once by close(). */
declare class Handle {
  close(): void;
}

/** A triangle mesh that the library has checked and copied. */
export class Surface extends Handle {
  /** Throws MeanderError, naming the first element, for a mesh that cannot be used. */
  constructor(positions: Numbers, faces: Numbers, options?: SurfaceOptions | null);
  readonly vertexCount: number;
  statistics(): SurfaceStatistics;
  extent(density?: Numbers | null): Extent;
  findClosest(points: Numbers): Closest;
  curvature(kind: Curvature, smoothing?: number): Float64Array;
  /** Three numbers for each vertex. */
  directions(kind: Directions, smoothing?: number): Float64Array;
  extendedDirections(points: Numbers, offsets: Numbers): Float64Array;
  outlines(distance: number, spacing: number): { seed: Required<Pick<Seed, "points" | "offsets" | "closed" | "guides" | "loops">>; skipped: number };
}

/** A curve as full polylines: every straight piece lies in one face. */
export interface Polylines {
  /** Three numbers for each point, strand after strand. */
  positions: Float64Array;
  /** Strand k has the points offsets[k] .. offsets[k + 1] - 1. */
  offsets: Uint32Array;
  /** 1 where the last point joins the first, which is not repeated. */
  closed: Uint8Array;
  guides: Uint8Array;
}

export interface Nodes {
  faces: Uint32Array;
  barycentrics: Float64Array;
  radii: Float64Array;
  fixed: Uint8Array;
}

export type PointPart = "arc_lengths" | "normals" | "tangents" | "radii" | "places" | "all";

/** What was asked for of every point of the polylines. */
export interface PointData {
  arcLengths?: Float64Array;
  normals?: Float64Array;
  tangents?: Float64Array;
  radii?: Float64Array;
  faces?: Uint32Array;
  barycentrics?: Float64Array;
}

/** Figures of a flow, as in meander_flow_statistics. */
export interface FlowStatistics {
  stopReason: StopReason;
  iterations: number;
  nodes: number;
  strands: number;
  closedStrands: number;
  /** 0. */
  crossings: number;
  polishing: boolean;
  guides: number;
  emptyComponents: number;
  length: number;
  energy: number;
  meanStep: number;
  spacingTarget: number;
  spacingP05: number;
  spacingMedian: number;
  spacingP95: number;
  evenness: number;
  [figure: string]: number | boolean | string;
}

export interface Iteration {
  iteration: number;
  nodes: number;
  length: number;
  meanStep: number;
  energy: number;
  seconds: number;
}

export interface Gaps {
  positions: Float64Array;
  radii: Float64Array;
  sizes: Float64Array;
  faces: Uint32Array;
  /** 1 where the surface is narrower than a spacing. */
  narrow: Uint8Array;
  emptyShare: number;
  narrowShare: number;
}

/** A curve that grows on a surface, which may be closed once the flow is made. */
export class Flow extends Handle {
  constructor(surface: Surface, options?: FlowOptions, seed?: Seed | null, density?: Numbers | null);
  readonly stopReason: StopReason;
  /** How far the steps have come towards the end, from 0 to 1: an estimate. */
  readonly progress: number;
  readonly phase: Phase;
  /** One iteration, whatever the stop reason says; returns the new one. */
  step(): StopReason;
  /** Steps to the end; `each` is called after every step, and ends the run by returning false. */
  run(each?: ((flow: Flow) => boolean | void) | null): StopReason;
  setDirections(directions: Numbers | null, kind?: Alignment): void;
  setRadius(radius: number): void;
  setDensity(density: Numbers | null): void;
  setOptions(options: FlowOptions): void;
  setVertices(positions: Numbers): void;
  polylines(): Polylines;
  nodes(): Nodes;
  /** Parts of the data; radii cost a medial axis. */
  pointData(parts?: PointPart | PointPart[]): PointData;
  statistics(): FlowStatistics;
  history(): Iteration[];
  gaps(leastSize?: number): Gaps;
}

/** A mesh that has a curve among its edges; see meander_cut. */
export interface CutSurface {
  positions: Float64Array;
  /** From the curve, along the surface. */
  distances: Float64Array;
  vertexFaces: Uint32Array;
  vertexWeights: Float64Array;
  faces: Uint32Array;
  /** For each face, of which face of the surface it is a part. */
  origins: Uint32Array;
  strands: Uint32Array;
  /** Faces of one number can be reached from one another without crossing the curve. */
  regions: Uint32Array;
  /** 1 or -1: other on the two sides of the curve where that can be, or else as nearestSides. */
  sides: Int32Array;
  nearestSides: Int32Array;
  along: Float64Array;
  faceDistances: Float64Array;
  cornerWeights: Float64Array;
  /** The curve, as vertices of the mesh. */
  lineVertices: Uint32Array;
  arcLengths: Float64Array;
  offsets: Uint32Array;
  lineStrands: Uint32Array;
  closed: Uint8Array;
  lengths: Float64Array;
}

/** A mesh of the shape of a flow's surface, cut along the flow's present curve, with edges of about `detail`. */
export function cutSurface(flow: Flow, detail?: number, middleLines?: boolean): CutSurface;

/** What fill() is asked for; also the options of FlowOptions but `preset` and `radius`. */
export interface Wish extends Omit<FlowOptions, "preset" | "radius"> {
  positions: Numbers;
  faces: Numbers;
  /** Of which polygon each face is a part, as readMesh has it. */
  polygons?: Numbers | null;
  /** Between neighbouring strands; left out: the automatic one. */
  spacing?: number;
  quality?: Preset;
  /** Left out: those of safeRepairs; null: none, and the mesh is refused where it has faults. */
  repairs?: SurfaceOptions | null;
  seed?: Seed | null;
  density?: Numbers | null;
  /** An array with three numbers for each vertex, or a kind that the library computes; see alignmentWeight. */
  directions?: Numbers | Directions | null;
  alignment?: Alignment;
  each?: ((flow: Flow) => boolean | void) | null;
}

/** Fills a mesh with a curve, and gives the curve. */
export function fill(wish: Wish): Polylines & {
  stopReason: StopReason;
  statistics: FlowStatistics;
  surface: SurfaceStatistics;
};

/** The spacing where nobody chose one. */
export function automaticSpacing(positions: Numbers, faces: Numbers): number;
/** Repairs that are safe, and change nothing of a mesh without faults. */
export function safeRepairs(positions: Numbers, spacing: number): SurfaceOptions;

export interface Mesh {
  positions: Float64Array;
  faces: Uint32Array;
  /** The polygon of each face; null: the faces themselves. */
  polygons: Uint32Array | null;
}

/** The mesh in the bytes of an OBJ, PLY or STL file, whose name says which. */
export function readMesh(bytes: Uint8Array | ArrayBuffer, name: string): Mesh;
/** The triangles of polygons: corners of one after the other, and where those of each end. */
export function triangulated(positions: Float64Array, corners: Uint32Array, ends: Uint32Array): Omit<Mesh, "positions">;

/** Bytes that the module has: what is freed is used again, and never given back. */
export function memoryInUse(): number;
/** For tests: a struct's size and offsets, as the library and as the binding has them. */
export function structLayout(name: string): { library: number[]; binding: number[] };

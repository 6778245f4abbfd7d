// SPDX-License-Identifier: GPL-3.0-or-later
import * as abi from "meander:abi";
import { checkedArray, oneForEach } from "./arrays.mjs";
import { calling, chosen, forgotten, Handle, namesOf } from "./calls.mjs";
import { native } from "./module.mjs";
import { optionsStruct } from "./options.mjs";
import { seedStruct } from "./seed.mjs";
import { spacingFor } from "./spacing.mjs";

export const STOP_REASONS = namesOf(abi.StopReason);
export const PHASES = namesOf(abi.Phase);
export const ALIGNMENTS = namesOf(abi.Alignment);

function addressOfNew(call, create) {
  const place = call.memory(4);
  call.check(create(place));
  return call.pointer(place);
}

/** A curve that grows on a surface, which may be closed once the flow is made. */
export class Flow extends Handle {
  #context;
  #vertexCount;

  constructor(surface, options = {}, seed = null, density = null) {
    const radius = options.radius || spacingFor(surface.statistics().area) / 2;
    const made = calling((call) => {
      const values =
        density == null
          ? null
          : oneForEach("density", density, Float64Array, surface.vertexCount, "vertices of the surface");
      const record = optionsStruct(call, { ...options, radius });
      const start = seedStruct(call, seed);
      const context = addressOfNew(call, (place) => native.meander_context_create(place, call.error.address));
      try {
        const flow = addressOfNew(call, (place) =>
          native.meander_flow_create(
            surface.address, start, call.copy(values), values?.length ?? 0, record.address, place, 0,
            call.error.address,
          ),
        );
        return { flow, context };
      } catch (problem) {
        native.meander_context_destroy(context);
        throw problem;
      }
    });
    super(made.flow, native.meander_flow_destroy);
    this.#context = made.context;
    this.#vertexCount = surface.vertexCount;
    forgotten.register(this, { free: native.meander_context_destroy, address: made.context }, this);
  }

  close() {
    if (this.#context) native.meander_context_destroy(this.#context);
    this.#context = 0;
    super.close(); // which unregisters both
  }

  /** Why a run would end now, one of STOP_REASONS. */
  get stopReason() {
    return STOP_REASONS[native.meander_flow_stop_reason(this.address)];
  }

  /** How far the steps have come towards the end, from 0 to 1: an estimate. */
  get progress() {
    return native.meander_context_progress(this.#context);
  }

  /** What the steps are about, one of PHASES. */
  get phase() {
    return PHASES[native.meander_context_phase(this.#context)];
  }

  /** Runs one iteration, whatever the stop reason says, and returns that. */
  step() {
    const context = this.#context;
    calling((call) => call.check(native.meander_flow_step(this.address, context, call.error.address)));
    return this.stopReason;
  }

  /** Steps until the flow ends; `each(flow)` is called after every step, and ends the run by returning false. */
  run(each = null) {
    native.meander_context_reset(this.#context);
    while (this.stopReason === "running") {
      this.step();
      if (each && each(this) === false) return "cancelled";
    }
    return this.stopReason;
  }

  #set(name, ...values) {
    calling((call) => {
      const given = values.map((value) => (ArrayBuffer.isView(value) ? call.copy(value) : value));
      call.check(name(this.address, ...given, call.error.address));
    });
    native.meander_context_reset(this.#context);
  }

  /** The field of lines that the option alignmentWeight refers to, before any step; null takes it back. */
  setDirections(directions, kind = "along") {
    const array = directions == null ? 0 : checkedArray("directions", directions, Float64Array, 3);
    const count = array ? array.length / 3 : 0;
    this.#set(native.meander_flow_set_directions, array, count, chosen("kind of alignment", kind, abi.Alignment));
  }

  /** Another radius, half the spacing, from here on. */
  setRadius(radius) {
    this.#set(native.meander_flow_set_radius, Number(radius));
  }

  /** Another density from here on; null is 1 everywhere. */
  setDensity(density) {
    const array = density == null ? 0 : checkedArray("density", density, Float64Array);
    this.#set(native.meander_flow_set_density, array, array ? array.length : 0);
  }

  /** Other options from here on, all of them. */
  setOptions(options) {
    calling((call) => {
      const record = optionsStruct(call, options);
      call.check(native.meander_flow_set_options(this.address, record.address, call.error.address));
    });
    native.meander_context_reset(this.#context);
  }

  /** Moves the vertices of the flow's surface, and the curve with it. */
  setVertices(positions) {
    const array = checkedArray("positions", positions, Float64Array, 3);
    calling((call) =>
      call.check(
        native.meander_flow_set_vertices(this.address, call.copy(array), array.length / 3, 0, call.error.address),
      ),
    );
    native.meander_context_reset(this.#context);
  }

  /** The present curve: every straight piece lies in one face. */
  polylines() {
    return calling((call) => {
      const found = call.result(abi.PolylinesRecord, native.meander_polylines_init);
      call.check(native.meander_flow_get_polylines(this.address, found.address, call.error.address));
      const strands = found.get("strand_count");
      return {
        positions: found.array("positions", 3 * found.get("point_count")),
        offsets: found.array("offsets", strands + 1),
        closed: found.array("closed", strands),
        guides: found.array("guides", strands),
      };
    });
  }

  /** The present nodes as points of the mesh, strand after strand. */
  nodes() {
    return calling((call) => {
      const found = call.result(abi.NodesRecord, native.meander_nodes_init);
      call.check(native.meander_flow_get_nodes(this.address, found.address, call.error.address));
      const count = found.get("count");
      return {
        faces: found.array("faces", count),
        barycentrics: found.array("barycentrics", 3 * count),
        radii: found.array("radii", 2 * count),
        fixed: found.array("fixed", count),
      };
    });
  }

  /** What is known of every point of the polylines, in their order; `normals` alone is cheap. */
  pointData(parts = "all") {
    const wanted = [parts].flat().reduce((sum, part) => sum | chosen("part of the data", part, abi.PointParts), 0);
    return calling((call) => {
      const found = call.result(abi.PointDataRecord, native.meander_point_data_init);
      call.check(native.meander_flow_compute_point_data(this.address, wanted, found.address, 0, call.error.address));
      const count = found.get("count");
      const data = {};
      if (wanted & abi.PointParts.arc_lengths) data.arcLengths = found.array("arc_lengths", count);
      if (wanted & abi.PointParts.normals) data.normals = found.array("normals", 3 * count);
      if (wanted & abi.PointParts.tangents) data.tangents = found.array("tangents", 3 * count);
      if (wanted & abi.PointParts.radii) data.radii = found.array("radii", 2 * count);
      if (wanted & abi.PointParts.places) {
        data.faces = found.array("faces", count);
        data.barycentrics = found.array("barycentrics", 3 * count);
      }
      return data;
    });
  }

  /** Figures of the present state. Costs a medial axis and a crossing test. */
  statistics() {
    return calling((call) => {
      const record = call.struct(abi.FlowStatisticsRecord, native.meander_flow_statistics_init);
      call.check(native.meander_flow_compute_statistics(this.address, record.address, 0, call.error.address));
      const figures = record.figures();
      return { ...figures, stopReason: STOP_REASONS[figures.stopReason], polishing: figures.polishing !== 0 };
    });
  }

  /** A record for every iteration so far, the oldest first. */
  history() {
    return calling((call) => {
      const { size, fields } = abi.IterationRecord;
      const count = call.memory(4);
      const records = (address, capacity) =>
        call.check(
          native.meander_flow_get_history(this.address, address, size, capacity, count, call.error.address),
        );
      records(0, 0);
      const length = call.pointer(count);
      const address = call.memory(size * length);
      records(address, length);
      const view = new DataView(native.memory.buffer, address);
      return Array.from({ length }, (_, i) => {
        const number = ([offset, kind]) =>
          kind === "double" ? view.getFloat64(i * size + offset, true) : view.getUint32(i * size + offset, true);
        return {
          iteration: number(fields.iteration),
          nodes: number(fields.nodes),
          length: number(fields.length),
          meanStep: number(fields.mean_step),
          energy: number(fields.energy),
          seconds: number(fields.seconds),
        };
      });
    });
  }

  /** The places that the present curve leaves empty, the largest first, and how much of the surface that is. */
  gaps(leastSize = 0) {
    return calling((call) => {
      const found = call.result(abi.GapsRecord, native.meander_gaps_init);
      call.check(native.meander_flow_find_gaps(this.address, leastSize, found.address, 0, call.error.address));
      const count = found.get("count");
      return {
        positions: found.array("positions", 3 * count),
        radii: found.array("radii", count),
        sizes: found.array("sizes", count),
        faces: found.array("faces", count),
        narrow: found.array("narrow", count),
        emptyShare: found.get("empty_share"),
        narrowShare: found.get("narrow_share"),
      };
    });
  }
}

// SPDX-License-Identifier: GPL-3.0-or-later
import * as abi from "meander:abi";
import { calling, camelCase, chosen, namesOf } from "./calls.mjs";
import { MeanderError } from "./errors.mjs";
import { native } from "./module.mjs";

export const PRESETS = namesOf(abi.Preset);

// Options whose numbers have names.
const CHOICES = {
  preset: abi.Preset,
  boundary_rule: abi.BoundaryRule,
  medial_axis: abi.MedialAxis,
  stop_rule: abi.StopRule,
  start: abi.Start,
};
const FIELDS = Object.entries(abi.FlowOptionsRecord.fields)
  .filter(([name, [, , length]]) => name !== "struct_size" && name !== "reserved32" && length === undefined)
  .map(([name, [, kind]]) => ({ name, key: camelCase(name), kind }));

function tuningNames() {
  const names = [];
  for (;;) {
    const address = native.meander_tuning_name(names.length) >>> 0;
    if (address === 0) return names;
    const bytes = new Uint8Array(native.memory.buffer, address);
    names.push(new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0))));
  }
}

/** The library's defaults for a preset; radius is 0, the automatic one. */
export function defaultOptions(preset = "even") {
  return calling((call) => {
    const record = call.struct(abi.FlowOptionsRecord, native.meander_flow_options_init, chosen("preset", preset, abi.Preset));
    const options = { tunings: {} };
    for (const { name, key } of FIELDS) {
      const value = record.get(name);
      options[key] = name in CHOICES ? namesOf(CHOICES[name])[value] : value;
    }
    const value = call.memory(8);
    for (const name of tuningNames()) {
      call.check(native.meander_flow_options_get_tuning(record.address, call.text(name), value, call.error.address));
      options.tunings[name] = call.read(Float64Array, value, 1)[0];
    }
    return options;
  });
}

function numberOf({ name, key, kind }, value) {
  if (name in CHOICES && typeof value === "string") return chosen(`option ${key}`, value, CHOICES[name]);
  const number = typeof value === "boolean" ? Number(value) : value;
  const whole = kind !== "double";
  if (typeof number !== "number" || (whole && !(Number.isInteger(number) && number >= 0 && number <= 0xffffffff))) {
    throw new MeanderError(`the option ${key} must be ${whole ? "a whole number, 0 or more" : "a number"}, not ${value}`);
  }
  return number;
}

/** The struct of options; what they do not name is as the preset has it. */
export function optionsStruct(call, options) {
  const record = call.struct(
    abi.FlowOptionsRecord,
    native.meander_flow_options_init,
    chosen("preset", options.preset ?? "even", abi.Preset),
  );
  for (const [key, value] of Object.entries(options)) {
    if (key === "preset" || key === "tunings" || value === undefined) continue;
    const field = FIELDS.find((field) => field.key === key);
    if (!field) {
      throw new MeanderError(`there is no option '${key}'; those there are: ${FIELDS.map((f) => f.key).join(", ")}`);
    }
    record.set(field.name, numberOf(field, value));
  }
  for (const [name, value] of Object.entries(options.tunings ?? {})) {
    call.check(native.meander_flow_options_set_tuning(record.address, call.text(name), value, call.error.address));
  }
  return record;
}

/** What is allowed but seldom meant in the options, one sentence each. */
export function optionWarnings(options) {
  return calling((call) => {
    const record = optionsStruct(call, options);
    const [size, room] = [call.memory(4), 4096];
    const text = call.memory(room);
    const warnings = [];
    for (;;) {
      call.check(
        native.meander_flow_options_get_warning(record.address, warnings.length, text, room, size, call.error.address),
      );
      const bytes = call.pointer(size);
      if (bytes === 0) return warnings;
      warnings.push(new TextDecoder().decode(call.read(Uint8Array, text, Math.min(bytes, room) - 1)));
    }
  });
}

/** What filling an extent costs, see Surface.extent: nodes, points, length, memory, processorSeconds. */
export function estimateCost(extent, options) {
  return calling((call) => {
    const given = call.struct(abi.ExtentRecord, native.meander_extent_init);
    for (const name of ["faces", "length_area", "node_area", "edge_density", "curvature"]) {
      given.set(name, extent[camelCase(name)]);
    }
    const cost = call.struct(abi.CostRecord, native.meander_cost_init);
    const record = optionsStruct(call, options);
    call.check(native.meander_extent_estimate_cost(given.address, record.address, cost.address, call.error.address));
    return cost.figures();
  });
}

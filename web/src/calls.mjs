// SPDX-License-Identifier: GPL-3.0-or-later
//
// One call of the library: its memory, its structs, its error.
import * as abi from "meander:abi";
import { MeanderError } from "./errors.mjs";
import { native } from "./module.mjs";

const ARRAYS = {
  "double*": Float64Array,
  "float*": Float32Array,
  "uint32_t*": Uint32Array,
  "int32_t*": Int32Array,
  "uint8_t*": Uint8Array,
};

export const namesOf = (numbers) => Object.keys(numbers);

/** point_count: pointCount. */
export const camelCase = (name) => name.replace(/_(\w)/g, (_, letter) => letter.toUpperCase());

/** The number of a name, as one that is not there is refused. */
export function chosen(what, name, numbers) {
  if (!Object.hasOwn(numbers, name)) {
    throw new MeanderError(`there is no ${what} '${name}'; choose one of ${namesOf(numbers).join(", ")}`);
  }
  return numbers[name];
}

/** A struct in the memory of the module, which may have grown since anything was last read. */
class Struct {
  constructor(address, record) {
    this.address = address;
    this.record = record;
  }

  get(name) {
    const [offset, kind] = this.record.fields[name];
    const view = new DataView(native.memory.buffer, this.address + offset);
    if (kind === "double") return view.getFloat64(0, true);
    if (kind === "float") return view.getFloat32(0, true);
    if (kind === "uint64_t") return Number(view.getBigUint64(0, true));
    return kind === "int32_t" ? view.getInt32(0, true) : view.getUint32(0, true);
  }

  set(name, value) {
    const [offset, kind] = this.record.fields[name];
    const view = new DataView(native.memory.buffer, this.address + offset);
    if (kind === "double") view.setFloat64(0, value, true);
    else view.setUint32(0, value, true);
  }

  /** A copy of the array that a field points to. */
  array(name, length) {
    const kind = this.record.fields[name][1];
    const address = this.get(name);
    if (kind === "uint64_t*") {
      const words = address ? new Uint32Array(native.memory.buffer, address, 2 * length) : new Uint32Array(2 * length);
      return Uint32Array.from({ length }, (_, i) => words[2 * i]); // offsets of arrays that fit into this memory
    }
    return address ? new ARRAYS[kind](native.memory.buffer, address, length).slice() : new ARRAYS[kind](length);
  }

  /** The numbers of all fields, by their names in JavaScript. */
  figures() {
    const found = {};
    for (const [name, [, kind, length]] of Object.entries(this.record.fields)) {
      if (!name.startsWith("reserved") && name !== "struct_size" && !kind.endsWith("*") && length === undefined) {
        found[camelCase(name)] = this.get(name);
      }
    }
    return found;
  }
}

export class Call {
  constructor() {
    this.blocks = [];
    this.results = [];
    this.error = this.struct(abi.ErrorRecord, native.meander_error_init);
  }

  /** Memory until the end of the call. */
  memory(size) {
    const address = native.malloc(Math.max(size, 1)) >>> 0;
    if (address === 0) throw new MeanderError("There is not enough memory; take a smaller mesh or a larger spacing.", "out_of_memory");
    this.blocks.push(address);
    return address;
  }

  /** The address of a copy of a typed array; 0 of none. */
  copy(array) {
    if (array == null) return 0;
    const address = this.memory(array.byteLength);
    new Uint8Array(native.memory.buffer, address, array.byteLength).set(
      new Uint8Array(array.buffer, array.byteOffset, array.byteLength),
    );
    return address;
  }

  text(value) {
    return this.copy(new TextEncoder().encode(`${value}\0`));
  }

  read(Array, address, length) {
    return new Array(native.memory.buffer, address, length).slice();
  }

  pointer(address) {
    return new DataView(native.memory.buffer).getUint32(address, true);
  }

  /** A struct that its _init function has prepared. */
  struct(record, init, ...more) {
    const struct = new Struct(this.memory(record.size), record);
    const status = init(struct.address, record.size, ...more);
    if (status !== 0) throw new MeanderError("This library is of another version than its binding.", "internal");
    return struct;
  }

  /** One whose arrays the library hands out: they are freed at the end of the call. */
  result(record, init) {
    const struct = this.struct(record, init);
    this.results.push(struct);
    return struct;
  }

  /** Throws what a call has reported. */
  check(status) {
    if (status === 0) return;
    const bytes = new Uint8Array(native.memory.buffer, this.error.address + abi.ErrorRecord.fields.text[0], 492);
    const sentence = new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0)));
    const kind = namesOf(abi.Element)[this.error.get("element_kind")];
    const [first, second] = [this.error.get("element_index"), this.error.get("element_index2")];
    const elements = kind === "none" ? [] : kind === "edge" || first !== second && kind === "seed_point" ? [first, second] : [first];
    const name = namesOf(abi.Status)[status] ?? "internal";
    throw new MeanderError(sentence || `The library failed (${name}).`, name, kind === "none" ? null : kind, elements);
  }

  end() {
    for (const struct of this.results) native.meander_result_destroy(struct.get("result"));
    for (const address of this.blocks) native.free(address);
  }
}

let broken = null;

/** What `work` gives, with the memory of its call freed. */
export function calling(work) {
  if (native === null) throw new MeanderError("The library has not been loaded yet; await ready first.");
  if (broken) throw broken;
  let call = null;
  try {
    call = new Call();
    return work(call);
  } catch (problem) {
    if (!(problem instanceof MeanderError) && !(problem instanceof TypeError)) {
      // A trap leaves the module's memory as it was in the middle of something.
      broken = new MeanderError(`The library failed (${problem.message}); load it again, and please report this.`, "internal");
      throw broken;
    }
    throw problem;
  } finally {
    if (!broken) call?.end();
  }
}

/** Frees what a program has forgotten. */
export const forgotten = new FinalizationRegistry(({ free, address }) => {
  if (!broken) free(address);
});

/** An object of the library's. */
export class Handle {
  #address;
  #free;

  constructor(address, free) {
    this.#address = address;
    this.#free = free;
    forgotten.register(this, { free, address }, this);
  }

  get address() {
    if (this.#address === 0) throw new MeanderError("this object has been closed; make another one");
    return this.#address;
  }

  /** Frees the memory at once, and not when the collector comes to it. */
  close() {
    if (this.#address === 0) return;
    forgotten.unregister(this);
    this.#free(this.#address);
    this.#address = 0;
  }
}

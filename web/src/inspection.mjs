// SPDX-License-Identifier: GPL-3.0-or-later
//
// What tests and hosts ask about the module itself.
import * as abi from "meander:abi";
import { calling } from "./calls.mjs";
import { native } from "./module.mjs";

/** Bytes that the module has; they never become fewer, and what is freed is used again. */
export const memoryInUse = () => native.memory.buffer.byteLength;

/** The size and the offsets of a struct as the library has them, and as the binding does. */
export function structLayout(name) {
  return calling((call) => {
    const text = call.text(name);
    const count = native.meander_struct_layout(text, 0, 0);
    const room = call.memory(4 * count);
    native.meander_struct_layout(text, room, count);
    const key = name.replace("meander_", "_").replace(/_(\w)/g, (_, letter) => letter.toUpperCase());
    const { size, fields } = abi[`${key}Record`];
    return {
      library: Array.from(call.read(Uint32Array, room, count)),
      binding: [size, ...Object.values(fields).map(([offset]) => offset)],
    };
  });
}

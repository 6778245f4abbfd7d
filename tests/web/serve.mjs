// SPDX-License-Identifier: GPL-3.0-or-later
//
// The library for tests/web/node_core.py: a line of JSON for every call, and one for what it gives.
import readline from "node:readline";
import * as meander from "../../build/web/meander.mjs";

const TYPES = { Float64Array, Uint32Array, Uint8Array };
const objects = [];

const given = (_key, value) => {
  if (value?.array) {
    const bytes = Uint8Array.from(Buffer.from(value.base64, "base64"));
    return new TYPES[value.array](bytes.buffer);
  }
  return value?.reference === undefined ? value : objects[value.reference];
};
const found = (_key, value) =>
  ArrayBuffer.isView(value)
    ? { array: value.constructor.name, base64: Buffer.from(value.buffer, value.byteOffset, value.byteLength).toString("base64") }
    : value;

await meander.ready;
for await (const line of readline.createInterface({ input: process.stdin })) {
  const { make, object, call, args } = JSON.parse(line, given);
  let answer = null;
  try {
    if (make) answer = { reference: objects.push(new meander[make](...args)) - 1 };
    else if (object) answer = object[call](...args);
    else answer = typeof meander[call] === "function" ? meander[call](...args) : meander[call];
  } catch (problem) {
    answer = { problem: problem.message };
  }
  process.stdout.write(`${JSON.stringify(answer ?? null, found)}\n`);
}

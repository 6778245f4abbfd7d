// SPDX-License-Identifier: GPL-3.0-or-later
//
// The WebAssembly module: where it comes from, and the few calls that it makes.
import { text } from "meander:wasm";

// The exports of the module, once `ready` has come true.
export let native = null;

// The bytes that a script cannot hold, by the characters that stand for them; every other byte is the low byte of its
// character (scripts/web/module_text.mjs).
const STAND_INS = { Y: 0, "[": 10, "^": 13, W: 34, Q: 92 };

function bytesOf(text) {
  const bytes = new Uint8Array(text.length);
  const low = new Uint8Array(512).map((_, code) => STAND_INS[String.fromCharCode(code)] ?? code);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = low[text.charCodeAt(i)];
  return bytes;
}

// What the C library asks of WASI. The library prints nothing, so that no file is ever there.
const NO_SUCH_FILE = 8;
const system = {
  clock_time_get(_clock, _precision, address) {
    const nanoseconds = BigInt(Math.round(performance.now() * 1e6));
    new DataView(native.memory.buffer).setBigUint64(address >>> 0, nanoseconds, true);
    return 0;
  },
  fd_close: () => NO_SUCH_FILE,
  fd_seek: () => NO_SUCH_FILE,
  fd_write: () => NO_SUCH_FILE,
};

async function load() {
  if (typeof WebAssembly !== "object") {
    throw new Error("There is no WebAssembly here; take another browser, or one without its strictest protection.");
  }
  const { instance } = await WebAssembly.instantiate(bytesOf(text), { wasi_snapshot_preview1: system });
  native = instance.exports;
  native._initialize();
}

/** Comes true when the library can be called. */
export const ready = load();

// SPDX-License-Identifier: GPL-3.0-or-later
//
// node --test tests/web/room.test.mjs: files that are too large are known by their beginning, or by their lines.
import assert from "node:assert/strict";
import test from "node:test";
import { tooLarge } from "../../web/page/room.mjs";

/** The sentence about bytes, of a file that is as long as `size`. */
function judged(name, bytes, size = bytes.length) {
  const file = new Uint8Array(bytes);
  let most = 0;
  const sentence = tooLarge(name, size, (begin, end) => {
    most = Math.max(most, end - begin);
    return file.subarray(begin, end);
  });
  assert.ok(most <= 1 << 20);
  return sentence;
}

const text = (letters) => new TextEncoder().encode(letters);
const TOO_MANY = /more than 2,000,000 faces, for which a tab has no room;/;

test("headers say how many faces there are", () => {
  const stl = (faces) => {
    const head = new Uint8Array(84);
    new DataView(head.buffer).setUint32(80, faces, true);
    return [head, 84 + 50 * faces];
  };
  assert.match(judged("a.stl", ...stl(2000001)), /^a\.stl has 2,000,001 faces, more/);
  assert.equal(judged("a.stl", ...stl(2000000)), null);
  const ply = (faces) => text(`ply\nformat ascii 1.0\nelement vertex 3\nelement face ${faces}\nend_header\n`);
  assert.match(judged("a.PLY", ply(5000000)), /5,000,000 faces/);
  assert.equal(judged("a.ply", ply(50)), null);
  const glb = (corners) => {
    const json = text(JSON.stringify({
      meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }, { attributes: { POSITION: 0 } }] }],
      accessors: [{ count: corners }, { count: 3 }],
    }));
    const file = new Uint8Array(20 + json.length);
    file.set(text("glTF"));
    new DataView(file.buffer).setUint32(12, json.length, true);
    file.set(json, 20);
    return file;
  };
  assert.match(judged("a.glb", glb(9e6)), /3,000,001 faces/);
  assert.equal(judged("a.glb", glb(9)), null);
});

test("lines of faces are counted in texts, however they are cut into pieces", () => {
  const enough = "f 1 2 3\n".repeat(2000000);
  assert.equal(judged("a.obj", text(enough)), null);
  assert.match(judged("a.obj", text(`${enough}\tf\t1 2 3`)), TOO_MANY);
  assert.equal(judged("a.obj", text(`${enough}fog 1\n# f 1\nvf 1\nf\n`)), null);
  assert.match(judged("a.stl", text("solid\n facet n\n".repeat(2000001))), TOO_MANY);
});

test("what is larger than memory is not looked into, and an odd file is left to its reader", () => {
  const never = () => assert.fail();
  assert.match(tooLarge("a.obj", 1e9, never), /1,000 MB/);
  for (const name of ["a.obj", "a.ply", "a.stl", "a.glb", "a.txt", "a"]) {
    assert.equal(judged(name, text("")), null);
    assert.equal(judged(name, text("glTF\0\0\0\0\0\0\0\0\xff\xff\xff\xff{")), null);
  }
});

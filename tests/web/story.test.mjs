// SPDX-License-Identifier: GPL-3.0-or-later
//
// node --test tests/web/story.test.mjs: the page's story in Chromium, from a folder, without a network: what a change
// is likely to break. The rest is in page.test.mjs.
import assert from "node:assert/strict";
import fs from "node:fs";
import path from "node:path";
import test from "node:test";
import {
  asked, atPicture, complaints, done, drop, load, page, pictured, profile, refill, refused, saved, sheet, shot, state, text,
  until,
} from "./browser.mjs";

test("a surface is there, and its line grows", async () => {
  await load();
  await pictured();
  const { mesh, least } = await state();
  assert.equal(mesh, "torus.obj");
  await shot("first");
  await until((least) => Number(document.body.dataset.points) > 5 * least, Number(least)); // a small loop
  assert.ok(asked.every((address) => /^(file|blob|data):/.test(address)), asked.join("\n"));
});

test("a mesh that is dropped is filled", async () => {
  await drop("sheet.obj", sheet(8));
  await until(() => document.body.dataset.mesh === "sheet.obj");
  await refill({ across: 12 });
  await done();
  assert.match(await text("status"), /^Done: [\d,]+ nodes/);
  assert.match(await text("facts"), /^sheet\.obj: 128 faces/);
  assert.match(await page.locator("#command").inputValue(), /^meander --input sheet\.obj --spacing 0\.08333 --quality even --output sheet_line\.obj$/);
});

test("the line is saved as what programs read", async () => {
  const points = Number((await state()).points);
  const obj = (await saved("obj")).toString();
  assert.equal(obj.match(/^v /gm).length, points);
  assert.ok(obj.match(/^l /gm).length >= 1);
  const svg = (await saved("svg")).toString();
  assert.match(svg, /^<svg [^>]*width="[\d.]+mm"/);
  assert.ok(svg.includes("<polyline"));
  assert.match((await saved("ply")).toString(), new RegExp(`element vertex ${points}\\n`));
  const glb = await saved("glb");
  assert.equal(glb.subarray(0, 4).toString(), "glTF");
  assert.equal(glb.readUInt32LE(8), glb.length);
  assert.equal((await saved("png")).subarray(1, 4).toString(), "PNG");
});

test("odd files are refused with a sentence, and what was there stays", async () => {
  const { mesh, points } = await state();
  assert.match(await refused(await drop("odd.obj", "f 1 2 3\n")), /^Line 1: /);
  assert.match(await refused(await drop("odd.ply", "\0\0\0\0")), /no PLY header/);
  assert.match(await refused(await drop("odd.glb", "glTF")), /no GLB file/);
  assert.match(await refused(await drop("odd.txt", "?")), /no OBJ, PLY or STL file/);
  assert.deepEqual([(await state()).mesh, (await state()).points], [mesh, points]);
});

test("a mesh too large for a tab is refused before it is read", async () => {
  const { mesh, points, problems } = await state();
  const large = path.join(profile, "large.stl");
  const head = Buffer.alloc(84);
  head.writeUInt32LE(3e6, 80);
  fs.writeFileSync(large, head);
  fs.truncateSync(large, 84 + 50 * 3e6); // nothing more is written
  await page.locator("#file").setInputFiles(large);
  assert.match(await refused(problems), /^large\.stl has 3,000,000 faces, more than a tab has room for/);
  assert.deepEqual([(await state()).mesh, (await state()).points], [mesh, points]);
});

test("a run is stopped by Esc, and its line is kept", async () => {
  await refill({ across: 100 });
  await atPicture(0, "Escape");
  await done();
  assert.match(await text("status"), /^Stopped: /);
  assert.match((await saved("obj")).toString(), /^l /m);
  assert.equal(await text("problem"), "");
  assert.deepEqual(complaints, []);
});

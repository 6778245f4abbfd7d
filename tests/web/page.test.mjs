// SPDX-License-Identifier: GPL-3.0-or-later
//
// node --test tests/web/page.test.mjs: what else the page does in Chromium, from a folder, without a network. The
// beginning of its story is in story.test.mjs.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import fs from "node:fs";
import http from "node:http";
import { createRequire } from "node:module";
import path from "node:path";
import test from "node:test";
import {
  atPicture, complaints, context, done, drop, load, page, profile, refill, refused, root, saved, set, sheet, shot, state, text,
  until,
} from "./browser.mjs";

// Rules of accessibility, WCAG's among them.
const AXE = createRequire(path.join(root, "build/web-tools/package.json")).resolve("axe-core/axe.min.js");

// The command of the Python package, from this checkout.
const COMMAND = `
import sys
sys.path.insert(0, "${path.join(root, "addon")}")
from meander.cli import command
from meander.cli.place import Place
sys.exit(command.main(sys.argv[1:], Place("meander", print)))`;

/** What in the page as it is now breaks a rule of accessibility. */
async function barriers() {
  if (!(await page.evaluate(() => "axe" in window))) await page.addScriptTag({ path: AXE });
  return page.evaluate(async () => {
    const { violations } = await window.axe.run();
    return violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html.slice(0, 120)).join("; ")}`);
  });
}

/** Until the picture is another one than `before`. */
async function differs(before) {
  const picture = () => page.locator("#canvas").screenshot();
  for (let again = 0; again < 100; again++) {
    if (!before.equals(await picture())) return;
    await page.waitForTimeout(100);
  }
  assert.fail("the picture is the same");
}

test("the surface that is there is filled", async () => {
  await load();
  await done();
  assert.match(await text("status"), /^Done: [\d,]+ nodes/);
  await shot("done");
});

test("no rule of accessibility is broken, and the picture turns by keys", async () => {
  assert.deepEqual(await barriers(), []);
  const before = await page.locator("#canvas").screenshot();
  await page.locator("#canvas").focus();
  for (let k = 0; k < 5; ++k) await page.keyboard.press("ArrowLeft");
  await differs(before);
});

test("a mesh that is dropped is filled", async () => {
  await drop("sheet.obj", sheet(8));
  await until(() => document.body.dataset.mesh === "sheet.obj");
  await done();
  assert.match(await text("facts"), /^sheet\.obj: 128 faces/);
  assert.match(await page.locator("#command").inputValue(), /^meander --input sheet\.obj --spacing 0\.03846 --quality even --output sheet_line\.obj$/);
});

test("what is saved is what the command writes and reads", async () => {
  const obj = (await saved("obj")).toString();
  const mesh = (await saved("mesh")).toString();
  assert.equal(mesh.match(/^v /gm).length, 81);
  assert.equal(mesh.match(/^f /gm).length, 128);
  // The command that the page shows gives the same line.
  fs.writeFileSync(path.join(profile, "sheet.obj"), sheet(8));
  const words = (await page.locator("#command").inputValue()).split(" ").slice(1);
  execFileSync("/usr/bin/python3", ["-c", COMMAND, ...words, "--quiet"], { cwd: profile });
  const numbers = (text) => text.match(/^v .*$/gm).map((row) => row.split(" ").slice(1).map(Number));
  assert.deepEqual(numbers(fs.readFileSync(path.join(profile, "sheet_line.obj"), "utf8")), numbers(obj));
  // What is saved as GLB is a mesh, too.
  await drop("tube.glb", await saved("glb"));
  await until(() => document.body.dataset.mesh === "tube.glb");
  await until(() => document.body.dataset.run === "running" || document.body.dataset.run === "done");
  await page.keyboard.press("Escape");
});

test("rows, qualities and the spacing are taken, and looks change no line", async () => {
  await drop("sheet.obj", sheet(8));
  await until(() => document.body.dataset.mesh === "sheet.obj");
  await refill({ rows: "x", across: 12 });
  assert.match(await page.locator("#command").inputValue(), /--quality rows --direction x/);
  await done();
  const { pictures, points } = await state();
  await set({ colours: "ink", thickness: 0.9 });
  assert.deepEqual([(await state()).pictures, (await state()).points], [pictures, points]);
  await shot("rows");
  await refill({ rows: "", quality: "flowing" });
  await done();
});

test("a seed is drawn on the surface", async () => {
  await page.locator("#draw").click();
  const box = await page.locator("#canvas").boundingBox();
  const at = (x, y) => [box.x + box.width * x, box.y + box.height * y];
  await page.mouse.move(...at(0.42, 0.5));
  await page.mouse.down();
  for (let k = 0; k <= 10; ++k) await page.mouse.move(...at(0.42 + 0.016 * k, 0.5));
  await page.mouse.up();
  await until(() => !document.getElementById("clear").disabled);
  assert.match(await page.locator("#command").inputValue(), /--seed sheet_seed\.obj/);
  await done();
  assert.equal(await text("problem"), "");
  assert.match((await saved("seed")).toString(), /^l 1 2 3/m);
  await page.keyboard.press("Escape"); // leaves the drawing
  assert.equal(await page.locator("#draw").getAttribute("aria-pressed"), "false");
});

test("a seed is drawn by keys", async () => {
  await page.locator("#clear").click();
  await done();
  await page.locator("#draw").focus();
  await page.keyboard.press("Enter");
  assert.equal(await page.evaluate(() => document.activeElement.id), "canvas");
  await page.keyboard.press("Space");
  assert.equal(await text("status"), "The pen is down.");
  for (let k = 0; k < 10; ++k) await page.keyboard.press("ArrowRight");
  await shot("pen");
  await page.keyboard.press("Space");
  await until(() => !document.getElementById("clear").disabled);
  await done();
  assert.match((await saved("seed")).toString(), /^l 1 2 3/m);
  await page.locator("#canvas").focus();
  await page.keyboard.press("Backspace");
  assert.ok(await page.locator("#clear").isDisabled());
  await page.keyboard.press("Escape"); // leaves the drawing, for where it was asked for
  assert.equal(await page.evaluate(() => document.activeElement.id), "draw");
  await done();
});

test("a run is paused, goes on, and is stopped by Esc", async () => {
  await refill({ example: "knot" });
  await refill({ quality: "even", across: 100 });
  await atPicture(0, "pause");
  // What the worker answers to what it is told later comes after all that it has said before the pause.
  await saved("mesh");
  const paused = await state();
  assert.equal(paused.run, "paused");
  await page.waitForTimeout(300); // a run that went on would come to another picture
  await saved("mesh");
  assert.deepEqual(await state(), paused);
  await shot("grows");
  const stopped = atPicture(Number(paused.pictures), "Escape");
  await page.locator("#pause").dispatchEvent("click");
  await stopped;
  await done();
  assert.match(await text("status"), /^Stopped: /);
  assert.ok((await saved("obj")).length > 0);
});

test("Esc is heard while the library computes, and the page goes on", async () => {
  await refill({ across: 26 });
  await done();
  await refill({ quality: "flowing", across: 120 }); // the first step of a full start of so many nodes takes seconds
  await page.waitForTimeout(300);
  await page.keyboard.press("Escape");
  await done();
  assert.match(await text("status"), /^Stopped/);
  assert.ok(Number((await state()).points) < 20000, (await state()).points); // the step lays ten times as many
  // Other settings are heard as well.
  await page.locator("#again").click();
  await page.waitForTimeout(300);
  await refill({ across: 20 });
  assert.equal(await text("across-value"), "20");
  await done();
  assert.match(await text("status"), /^Done: /);
  assert.equal(await text("problem"), "");
});

test("a line that is done parts its surface in two colours", async () => {
  await refill({ example: "pebble" });
  await refill({ quality: "even" });
  await done();
  const before = await page.locator("#canvas").screenshot();
  await set({ colours: "sides" });
  await until(() => document.body.dataset.sides);
  await differs(before);
  await shot("sides");
  await set({ colours: "clay" });
});

test("text too large for a tab is refused before all of it is read", async () => {
  const { mesh, points } = await state();
  const file = async (name, head, size) => {
    const problems = (await state()).problems ?? "0";
    const large = path.join(profile, name);
    fs.writeFileSync(large, head);
    fs.truncateSync(large, size); // nothing more is written
    await page.locator("#file").setInputFiles(large);
    return refused(problems);
  };
  assert.match(await file("large.obj", "v 0 0 0\n", 400e6), /^large\.obj has 400 MB, more than a tab/);
  const lines = "f 1 2 3\n".repeat(2.1e6);
  assert.match(await file("lines.obj", lines, lines.length), /^lines\.obj has more than 2,000,000 faces/);
  assert.deepEqual([(await state()).mesh, (await state()).points], [mesh, points]); // what was there stays
});

test("it fits a narrow window, in the dark", async () => {
  await page.setViewportSize({ width: 380, height: 760 });
  await page.emulateMedia({ colorScheme: "dark" });
  const wide = await page.evaluate(() => document.documentElement.scrollWidth);
  assert.ok(wide <= 380, String(wide));
  await shot("narrow");
  assert.deepEqual(await barriers(), []);
  assert.deepEqual(complaints, []);
});

test("the lines of docs/web.md fill a mesh in a page of one's own", async () => {
  const lines = /^```html\n([\s\S]*?)^```$/m.exec(fs.readFileSync(path.join(root, "docs/web.md"), "utf8"))[1];
  const files = {
    "/": ["text/html", `<!doctype html><link rel="icon" href="data:,">${lines}`],
    "/meander.mjs": ["text/javascript", fs.readFileSync(path.join(root, "build/web/meander.mjs"))],
    "/spot.obj": ["text/plain", sheet(4)],
  };
  const server = http.createServer(({ url }, response) => {
    const [type, contents] = files[url] ?? ["text/plain", ""];
    response.writeHead(url in files ? 200 : 404, { "content-type": `${type}; charset=utf-8` }).end(contents);
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  try {
    const own = await context.newPage();
    const problems = [];
    own.on("pageerror", (problem) => problems.push(String(problem)));
    const said = own.waitForEvent("console", { timeout: 60000 });
    await own.goto(`http://127.0.0.1:${server.address().port}/`);
    const [points, closed] = (await said).args();
    assert.ok((await points.evaluate(({ length }) => length)) > 100);
    assert.ok([0, 1].includes(await closed.jsonValue()));
    assert.deepEqual(problems, []);
    await own.close();
  } finally {
    server.close();
  }
});

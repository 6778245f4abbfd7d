// SPDX-License-Identifier: GPL-3.0-or-later
//
// node --test tests/web/page.test.mjs: the page's story in Chromium, from a folder, without a network.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import fs from "node:fs";
import http from "node:http";
import { createRequire } from "node:module";
import os from "node:os";
import path from "node:path";
import test, { after, before } from "node:test";
import { fileURLToPath, pathToFileURL } from "node:url";

const root = fileURLToPath(new URL("../..", import.meta.url));
const require = createRequire(path.join(root, "build/web-tools/package.json"));
const { chromium } = require("playwright-core");
const AXE = require.resolve("axe-core/axe.min.js"); // rules of accessibility, WCAG's among them
const PICTURES = process.env.MEANDER_PICTURES; // a folder for pictures of the page

// The command of the Python package, from this checkout.
const COMMAND = `
import sys
sys.path.insert(0, "${path.join(root, "addon")}")
from meander.cli import command
from meander.cli.place import Place
sys.exit(command.main(sys.argv[1:], Place("meander", print)))`;

const profile = fs.mkdtempSync(path.join(os.tmpdir(), "meander-page-"));
let context = null;
let page = null;
const asked = []; // addresses that the page has loaded
const complaints = [];

before(async () => {
  context = await chromium.launchPersistentContext(path.join(profile, "profile"), {
    executablePath: process.env.MEANDER_CHROMIUM ?? "/usr/bin/chromium",
    headless: true,
    acceptDownloads: true,
    viewport: { width: 1200, height: 800 },
    args: ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
      "--disable-component-update", "--disable-sync", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
  });
  page = await context.newPage();
  page.on("request", (request) => asked.push(request.url()));
  page.on("pageerror", (problem) => complaints.push(String(problem)));
  page.on("console", (message) => message.type() === "error" && complaints.push(message.text()));
});

after(async () => {
  await context?.close();
  fs.rmSync(profile, { recursive: true, force: true });
});

const state = () => page.evaluate(() => ({ ...document.body.dataset }));
const text = (id) => page.locator(`#${id}`).textContent();
const until = (what, argument) => page.waitForFunction(what, argument, { timeout: 120000, polling: 50 });
const done = () => until(() => document.body.dataset.run === "done");
const running = () => until(() => document.body.dataset.run === "running" && document.body.dataset.pictures > 0);
const shot = (name) => PICTURES && page.screenshot({ path: path.join(PICTURES, `${name}.png`) });

/** Sets a slider or a choice as a person does. */
const set = (id, value) =>
  page.locator(`#${id}`).evaluate((control, value) => {
    control.value = value;
    control.dispatchEvent(new Event("input", { bubbles: true }));
    control.dispatchEvent(new Event("change", { bubbles: true }));
  }, String(value));

/** Drops a file of this name onto the page. */
async function drop(name, contents) {
  const problems = (await state()).problems ?? "0";
  const data = await page.evaluateHandle(
    ([name, base64]) => {
      const transfer = new DataTransfer();
      const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
      transfer.items.add(new File([bytes], name));
      return transfer;
    },
    [name, Buffer.from(contents).toString("base64")],
  );
  await page.dispatchEvent("#view", "drop", { dataTransfer: data });
  return problems;
}

const refused = async (problems) => {
  await until((problems) => (document.body.dataset.problems ?? "0") !== problems, problems);
  return text("problem");
};

/** A sheet of n x n quads, as an OBJ file. */
function sheet(n) {
  const lines = [];
  for (let j = 0; j <= n; ++j) for (let i = 0; i <= n; ++i) lines.push(`v ${i / n} 0 ${j / n}`);
  for (let j = 0; j < n; ++j) {
    for (let i = 1; i <= n; ++i) lines.push(`f ${j * (n + 1) + i} ${j * (n + 1) + i + 1} ${(j + 1) * (n + 1) + i + 1} ${(j + 1) * (n + 1) + i}`);
  }
  return lines.join("\n");
}

/** What in the page as it is now breaks a rule of accessibility. */
async function barriers() {
  if (!(await page.evaluate(() => "axe" in window))) await page.addScriptTag({ path: AXE });
  return page.evaluate(async () => {
    const { violations } = await window.axe.run();
    return violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html.slice(0, 120)).join("; ")}`);
  });
}

async function saved(kind) {
  const [download] = await Promise.all([page.waitForEvent("download"), page.locator(`.save[data-kind=${kind}]`).click()]);
  const file = path.join(profile, download.suggestedFilename());
  await download.saveAs(file);
  return fs.readFileSync(file);
}

test("a surface is there, and its line grows", async () => {
  await page.goto(pathToFileURL(path.join(root, "build/web/index.html")).href);
  await running();
  const first = await state();
  assert.equal(first.mesh, "torus.obj");
  await shot("first");
  await done();
  assert.ok(Number((await state()).points) > 5 * Number(first.least)); // of the first picture, a small loop
  assert.match(await text("status"), /^Done: [\d,]+ nodes/);
  assert.ok(asked.every((address) => /^(file|blob|data):/.test(address)), asked.join("\n"));
  await shot("done");
});

test("no rule of accessibility is broken, and the picture turns by keys", async () => {
  assert.deepEqual(await barriers(), []);
  const before = await page.locator("#canvas").screenshot();
  await page.locator("#canvas").focus();
  for (let k = 0; k < 5; ++k) await page.keyboard.press("ArrowLeft");
  await page.waitForTimeout(300);
  assert.ok(!before.equals(await page.locator("#canvas").screenshot()));
});

test("a mesh that is dropped is filled", async () => {
  await drop("sheet.obj", sheet(8));
  await until(() => document.body.dataset.mesh === "sheet.obj");
  await done();
  assert.match(await text("facts"), /^sheet\.obj: 128 faces/);
  assert.match(await page.locator("#command").inputValue(), /^meander --input sheet\.obj --spacing 0\.03846 --quality even --output sheet_line\.obj$/);
});

test("the line is saved as what programs read", async () => {
  const obj = (await saved("obj")).toString();
  const points = obj.match(/^v /gm).length;
  assert.equal(points, Number((await state()).points));
  assert.ok(obj.match(/^l /gm).length >= 1);
  const svg = (await saved("svg")).toString();
  assert.match(svg, /^<svg [^>]*width="[\d.]+mm"/);
  assert.ok(svg.includes("<polyline"));
  const ply = (await saved("ply")).toString();
  assert.match(ply, new RegExp(`element vertex ${points}\\n`));
  const glb = await saved("glb");
  assert.equal(glb.subarray(0, 4).toString(), "glTF");
  assert.equal(glb.readUInt32LE(8), glb.length);
  assert.equal((await saved("png")).subarray(1, 4).toString(), "PNG");
  const mesh = (await saved("mesh")).toString();
  assert.equal(mesh.match(/^v /gm).length, 81);
  assert.equal(mesh.match(/^f /gm).length, 128);
  // The command that the page shows gives the same line.
  fs.writeFileSync(path.join(profile, "sheet.obj"), sheet(8));
  const words = (await page.locator("#command").inputValue()).split(" ").slice(1);
  execFileSync("/usr/bin/python3", ["-c", COMMAND, ...words, "--quiet"], { cwd: profile });
  const numbers = (text) => text.match(/^v .*$/gm).map((row) => row.split(" ").slice(1).map(Number));
  assert.deepEqual(numbers(fs.readFileSync(path.join(profile, "sheet_line.obj"), "utf8")), numbers(obj));
  // What was saved as GLB is a mesh, too.
  await drop("tube.glb", glb);
  await until(() => document.body.dataset.mesh === "tube.glb");
  await until(() => document.body.dataset.run === "running" || document.body.dataset.run === "done");
  await page.keyboard.press("Escape");
});

test("rows, qualities and the spacing are taken, and looks change no line", async () => {
  await drop("sheet.obj", sheet(8));
  await until(() => document.body.dataset.mesh === "sheet.obj");
  await set("rows", "x");
  await set("across", 12);
  await until(() => document.getElementById("command").value.includes("--quality rows --direction x"));
  await page.waitForTimeout(300);
  await done();
  const { pictures, points } = await state();
  await set("colours", "ink");
  await set("thickness", 0.9);
  assert.deepEqual([(await state()).pictures, (await state()).points], [pictures, points]);
  await shot("rows");
  await set("rows", "");
  await set("quality", "flowing");
  await page.waitForTimeout(300);
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
  await set("example", "knot");
  await until(() => document.body.dataset.mesh === "knot.obj");
  await set("quality", "even");
  await set("across", 100);
  await page.waitForTimeout(300);
  await running();
  const press = () => page.locator("#pause").dispatchEvent("click"); // without waiting for pictures to stand still
  await press();
  let paused = await state(); // a step that went on ends first
  for (let again = 0; again < 40; again++) {
    await page.waitForTimeout(300);
    const now = await state();
    if (JSON.stringify(now) === JSON.stringify(paused) && now.run === "paused") break;
    paused = now;
  }
  await page.waitForTimeout(300);
  assert.deepEqual(await state(), paused);
  assert.equal(paused.run, "paused");
  await shot("grows");
  await press();
  await until((pictures) => Number(document.body.dataset.pictures) > pictures, Number(paused.pictures));
  await page.keyboard.press("Escape");
  await done();
  assert.match(await text("status"), /^Stopped: /);
  assert.ok((await saved("obj")).length > 0);
});

test("Esc is heard while the library computes, and the page goes on", async () => {
  await set("across", 26);
  await page.waitForTimeout(300);
  await done();
  await set("quality", "flowing");
  await set("across", 120); // the first step of a full start of so many nodes takes seconds
  await until(() => document.body.dataset.run === "running");
  await page.waitForTimeout(300);
  await page.keyboard.press("Escape");
  await done();
  assert.match(await text("status"), /^Stopped/);
  assert.ok(Number((await state()).points) < 20000, (await state()).points); // the step lays ten times as many
  // Other settings are heard as well.
  await page.locator("#again").click();
  await page.waitForTimeout(300);
  await set("across", 20);
  await until(() => document.getElementById("across-value").textContent === "20");
  await page.waitForTimeout(300);
  await done();
  assert.match(await text("status"), /^Done: /);
  assert.equal(await text("problem"), "");
});

test("a line that is done parts its surface in two colours", async () => {
  await set("example", "pebble");
  await until(() => document.body.dataset.mesh === "pebble.obj");
  await set("quality", "even");
  await done();
  const before = await page.locator("#canvas").screenshot();
  await set("colours", "sides");
  await until(() => document.body.dataset.sides);
  await page.waitForTimeout(300);
  assert.ok(!before.equals(await page.locator("#canvas").screenshot()));
  await shot("sides");
  await set("colours", "clay");
});

test("odd files are refused with a sentence, and the page goes on", async () => {
  assert.match(await refused(await drop("odd.obj", "f 1 2 3\n")), /^Line 1: /);
  assert.match(await refused(await drop("odd.ply", "\0\0\0\0")), /no PLY header/);
  assert.match(await refused(await drop("odd.glb", "glTF")), /no GLB file/);
  assert.match(await refused(await drop("odd.txt", "?")), /no OBJ, PLY or STL file/);
  await drop("sheet.obj", sheet(4));
  await until(() => document.body.dataset.mesh === "sheet.obj");
  await done();
  assert.equal(await text("problem"), "");
});

test("a mesh too large for a tab is refused before it is read", async () => {
  const { mesh, points } = await state();
  const stl = Buffer.alloc(84);
  stl.writeUInt32LE(3e6, 80);
  const file = async (name, head, size) => {
    const problems = (await state()).problems ?? "0";
    const large = path.join(profile, name);
    fs.writeFileSync(large, head);
    fs.truncateSync(large, size); // nothing more is written
    await page.locator("#file").setInputFiles(large);
    return refused(problems);
  };
  assert.match(await file("large.stl", stl, 84 + 50 * 3e6), /^large\.stl has 3,000,000 faces, more than a tab has room for/);
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
  await page.waitForTimeout(200);
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

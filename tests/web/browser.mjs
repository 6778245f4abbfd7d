// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the stories of the page share: Chromium with the page's folder and no network, and what a person does in it.
import fs from "node:fs";
import { createRequire } from "node:module";
import os from "node:os";
import path from "node:path";
import { after, before } from "node:test";
import { fileURLToPath, pathToFileURL } from "node:url";

export const root = fileURLToPath(new URL("../..", import.meta.url));
const require = createRequire(path.join(root, "build/web-tools/package.json"));
const { chromium } = require("playwright-core");
const PICTURES = process.env.MEANDER_PICTURES; // a folder for pictures of the page

export const profile = fs.mkdtempSync(path.join(os.tmpdir(), "meander-page-"));
export let context = null;
export let page = null;
export const asked = []; // addresses that the page has loaded
export const complaints = [];

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

export const state = () => page.evaluate(() => ({ ...document.body.dataset }));
export const text = (id) => page.locator(`#${id}`).textContent();
export const until = (what, argument) => page.waitForFunction(what, argument, { timeout: 120000, polling: 50 });
export const done = () => until(() => document.body.dataset.run === "done");
/** A picture of the line is there; the run may have ended since, where the page draws more slowly than it computes. */
export const pictured = () => until(() => document.body.dataset.pictures > 0);
export const shot = (name) => PICTURES && page.screenshot({ path: path.join(PICTURES, `${name}.png`) });

/** Sets sliders and choices as a person does, all of them before the page hears of one. */
export const set = (values) =>
  page.evaluate((values) => {
    for (const [id, value] of Object.entries(values)) {
      const control = document.getElementById(id);
      control.value = value;
      for (const kind of ["input", "change"]) control.dispatchEvent(new Event(kind, { bubbles: true }));
    }
  }, values);

/** The same, until the surface is filled anew with them. */
export async function refill(values) {
  const { fill } = await state();
  await set(values);
  await until((fill) => document.body.dataset.fill !== fill, fill);
}

/**
 * Presses this key or button with the first picture of a run after so many. The page does it by itself: where the
 * processors draw, what is pressed from here may come many seconds later.
 */
export const atPicture = (pictures, what) =>
  page.evaluate(
    ([pictures, what]) =>
      new Promise((resolve) => {
        const observer = new MutationObserver(press);
        function press() {
          const { run, pictures: shown } = document.body.dataset;
          if (run !== "running" || Number(shown) <= pictures) return;
          observer.disconnect();
          if (what === "Escape") document.dispatchEvent(new KeyboardEvent("keydown", { key: what }));
          else document.getElementById(what).click();
          resolve();
        }
        observer.observe(document.body, { attributes: true });
        press();
      }),
    [pictures, what],
  );

/** Drops a file of this name onto the page; gives what refused() takes. */
export async function drop(name, contents) {
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

/** The sentence that comes after `problems`. */
export const refused = async (problems) => {
  await until((problems) => (document.body.dataset.problems ?? "0") !== problems, problems);
  return text("problem");
};

/** A sheet of n x n quads, as an OBJ file. */
export function sheet(n) {
  const lines = [];
  for (let j = 0; j <= n; ++j) for (let i = 0; i <= n; ++i) lines.push(`v ${i / n} 0 ${j / n}`);
  for (let j = 0; j < n; ++j) {
    for (let i = 1; i <= n; ++i) lines.push(`f ${j * (n + 1) + i} ${j * (n + 1) + i + 1} ${(j + 1) * (n + 1) + i + 1} ${(j + 1) * (n + 1) + i}`);
  }
  return lines.join("\n");
}

export async function saved(kind) {
  const [download] = await Promise.all([page.waitForEvent("download"), page.locator(`.save[data-kind=${kind}]`).click()]);
  const file = path.join(profile, download.suggestedFilename());
  await download.saveAs(file);
  return fs.readFileSync(file);
}

/** Opens the page from its folder. */
export const load = () => page.goto(pathToFileURL(path.join(root, "build/web/index.html")).href);

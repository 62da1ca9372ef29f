// What the tests of the pages have in common: the browser, the commands of yars, waits, accessibility, the run of the tests.
// usage of a test: node TEST.mjs ADDRESS YARS SESSION
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { chromium } from "playwright-core";

const [address, yars, session] = process.argv.slice(2);
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

export { address };
export const call = (...words) => execFileSync(yars, ["--session", session, ...words], { encoding: "utf8" });
export const watch = () => JSON.parse(call("watch", "--json", "--once"));

const WATCHDOG_MS = 60000; // of a wait; a busy machine takes long

export async function until(what, check) {
  const end = performance.now() + WATCHDOG_MS;
  while (!await check()) {
    if (performance.now() > end) assert.fail(`expected within ${WATCHDOG_MS / 1000} s: ${what}`);
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
}

export const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--no-sandbox"] });
export const faults = []; // errors in the console of the pages

// A page that shows its first state.
export async function open(width, height, path) {
  const page = await browser.newPage({ viewport: { width, height } });
  page.setDefaultTimeout(WATCHDOG_MS);
  page.on("console", (message) => message.type() === "error" && faults.push(message.text()));
  page.on("pageerror", (error) => faults.push(String(error)));
  await page.goto(address + path);
  await page.waitForFunction(() => document.body.dataset.state === "shown");
  return page;
}

export async function hasNoSeriousFault(page) {
  await page.evaluate(axe);
  const { violations } = await page.evaluate(() => globalThis.axe.run());
  const serious = violations.filter(({ impact }) => impact === "serious" || impact === "critical");
  assert.deepEqual(serious.map(({ id, nodes }) => [id, nodes.map(({ html }) => html)]), []);
}

// Phone, tablet, and the phone on its side: no page scrolls sideways. `check` sees each page.
export async function fitsSmallScreens(path, check = async () => {}) {
  for (const [width, height] of [[390, 844], [820, 1180], [844, 390]]) {
    const page = await open(width, height, path);
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `${width} x ${height}`);
    await check(page);
    await page.close();
  }
}

// Runs all tests on a page, one after the other, and ends the program. `tests`: functions by name.
export async function run(tests, page) {
  let failed = 0;
  for (const [name, test] of Object.entries(tests)) {
    const began = performance.now();
    try {
      await test(page);
      console.log(`passed: ${name}, ${((performance.now() - began) / 1000).toFixed(1)} s`);
    } catch (error) {
      ++failed;
      console.log(`FAILED: ${name}: ${error.stack}`);
    }
  }
  if (faults.length > 0) console.log(`FAILED: errors in the browser's console: ${faults.join("; ")}`);
  await browser.close();
  process.exit(failed + faults.length > 0 ? 1 : 0);
}

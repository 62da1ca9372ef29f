// What the tests of the pages have in common: the browser, the commands of yars, waits, accessibility, the run of the
// tests.
// usage of a test: node TEST.mjs ADDRESS YARS SESSION
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { chromium } from "playwright-core";

const [address, yars, session] = process.argv.slice(2);
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

export { address, session };
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

export const browser = await chromium.launch(
  { executablePath: "/usr/bin/chromium-headless-shell", args: ["--no-sandbox"] });
export const faults = []; // errors in the console of the pages

// A page that shows its first state. `before`: a script that runs in the page before its own.
export async function open(width, height, path, before) {
  const page = await browser.newPage({ viewport: { width, height } });
  if (before) await page.addInitScript(before);
  page.setDefaultTimeout(WATCHDOG_MS);
  page.on("console", (message) => message.type() === "error" && faults.push(message.text()));
  page.on("pageerror", (error) => faults.push(String(error)));
  await page.goto(address + path);
  await page.waitForFunction(() => document.body.dataset.state === "shown");
  return page;
}

// axe-core finds nothing, whatever its weight.
export async function hasNoFinding(page) {
  await page.evaluate(axe);
  const { violations } = await page.evaluate(() => globalThis.axe.run());
  assert.deepEqual(violations.map(({ id, nodes }) => [id, nodes.map(({ html }) => html)]), []);
}

const TOUCH_PX = 44;

// Things to press that are smaller than a finger: their words and sizes.
export const tooSmall = (page) => page.evaluate((least) => [
  ...document.querySelectorAll("button, select, input, summary, a")]
  .filter((target) => target.checkVisibility()).map((target) => [target, target.getBoundingClientRect()])
  .filter(([, { width, height }]) => Math.min(width, height) < least - 0.01)
  .map(([target, { width, height }]) => `${target.id || target.textContent}: ${width} x ${height}`), TOUCH_PX);

// Desktop and phone; with YARS_TEST_FULL a tablet and the phone on its side, too.
export const screens = [[1440, 900], [390, 844], ...process.env.YARS_TEST_FULL ? [[820, 1180], [844, 390]] : []];

// On each screen no page scrolls sideways, a finger meets everything, and accessibility has no finding. `check` sees
// each page.
export async function fitsAllScreens(path, check = async () => {}) {
  for (const [width, height] of screens) {
    const page = await open(width, height, path);
    const size = `${width} x ${height}`;
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), size);
    assert.deepEqual(await tooSmall(page), [], size);
    await hasNoFinding(page);
    await check(page, width, height);
    await page.close();
  }
}

// Whether an element lies wholly in the window, and nothing covers its middle.
export const inSight = (page, selector) => page.locator(selector).first().evaluate((found) => {
  const { left, top, right, bottom } = found.getBoundingClientRect();
  const upmost = document.elementFromPoint((left + right) / 2, (top + bottom) / 2);
  return left >= 0 && top >= 0 && right <= innerWidth && bottom <= innerHeight &&
    (found === upmost || found.contains(upmost));
});

// The page names the product, has an icon, and leads to the pages of `links`, each of which answers.
export async function hasNameIconAndLinks(page, links) {
  assert.match(await page.title(), /YARS/);
  assert.match(await page.textContent("h1"), /YARS/);
  const icons = await page.$$eval("link[rel=icon]", (list) => list.map(({ href }) => href));
  for (const icon of [...icons, `${address}/favicon.ico`]) {
    const answer = await page.request.get(icon);
    assert.ok(answer.ok(), icon);
    assert.match(answer.headers()["content-type"], /^image\/(svg\+xml|x-icon)$/, icon);
  }
  const found = await page.$$eval("header nav a", (list) => list.map((link) => new URL(link.href).pathname));
  assert.deepEqual(found, links);
  for (const link of links) assert.ok((await page.request.get(address + link)).ok(), link);
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

// The display page as a pilot uses it. usage: node pages.mjs ADDRESS YARS SESSION
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { chromium } from "playwright-core";

const [address, yars, session] = process.argv.slice(2);
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const watch = () => JSON.parse(execFileSync(yars, ["--session", session, "watch", "--json", "--once"], { encoding: "utf8" }));

async function until(what, check) {
  for (let turn = 0; turn < 100; ++turn) {
    if (await check()) return;
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
  assert.fail(`expected within 10 s: ${what}`);
}

const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--no-sandbox"] });
const faults = [];
async function open(width, height) {
  const page = await browser.newPage({ viewport: { width, height } });
  page.on("console", (message) => message.type() === "error" && faults.push(message.text()));
  page.on("pageerror", (error) => faults.push(String(error)));
  await page.goto(address);
  await page.waitForFunction(() => document.body.dataset.state === "shown" && document.getElementById("picture").dataset.frame);
  return page;
}

const legendsOf = (page) => page.evaluate(() => Object.fromEntries(Array.from({ length: 20 }, (_, at) => at + 1)
  .map((number) => [number, document.getElementById(`pb${number}`).innerText]).filter(([, legend]) => legend !== "")));

async function legendsAgree(page) {
  await until("the legends of the page are those of yars watch", async () =>
    JSON.stringify(await legendsOf(page)) === JSON.stringify(watch().legends));
}

const tests = {
  async "keys act as in the window"(page) {
    const range = watch().range_nm;
    await page.click("h1");
    await page.keyboard.press("d");
    await until("a greater range", () => watch().range_nm !== range);
    await page.keyboard.press("e");
    await until("the range from before", () => watch().range_nm === range);
  },
  async "a click on the picture puts the cursor there"(page) {
    const before = watch().events_applied;
    await page.click("#picture", { position: { x: 200, y: 150 } });
    await until("cursor, press and release", () => watch().events_applied >= before + 3);
  },
  async "the picture has the pixels of a frame and moves"(page) {
    const first = await page.getAttribute("#picture", "data-frame");
    await until("another frame", async () => await page.getAttribute("#picture", "data-frame") !== first);
    const green = await page.evaluate(() => {
      const canvas = document.getElementById("picture");
      const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
      let count = 0;
      for (let at = 0; at < data.length; at += 4) if (data[at + 1] > 40) ++count;
      return count;
    });
    assert.ok(green > 2000, `expected a picture, found ${green} green pixels`);
  },
  async "no serious fault of accessibility"(page) {
    await page.evaluate(axe);
    const { violations } = await page.evaluate(() => globalThis.axe.run());
    const serious = violations.filter(({ impact }) => impact === "serious" || impact === "critical");
    assert.deepEqual(serious.map(({ id, nodes }) => [id, nodes.map(({ html }) => html)]), []);
  },
  async "every button does what its event does, and legends follow"(page) {
    await until("power is on", () => watch().power === "OPR");
    for (let number = 1; number <= 20; ++number) {
      const before = watch().events_applied;
      await page.click(`#pb${number}`);
      await until(`PB ${number} is applied`, () => watch().events_applied === before + 1);
      await legendsAgree(page);
      const words = await page.getAttribute(`#pb${number}`, "aria-label");
      assert.match(words, new RegExp(`^PB ${number} `));
      if (number === 11) await page.click("#pb11"); // out of the main menu again
    }
  },
  async "the page comes back when the server was killed"(page) {
    const { pid } = watch().processes.station;
    await page.evaluate(() => { document.getElementById("picture").dataset.frame = "none"; });
    process.kill(pid, "SIGKILL");
    await page.waitForFunction(() => document.body.dataset.connection === "lost");
    await page.waitForFunction(() => document.body.dataset.connection === "open");
    await page.waitForFunction(() => document.getElementById("picture").dataset.frame !== "none");
    await legendsAgree(page);
    faults.length = 0; // the browser logs refused connections
  },
  async "phone and tablet show it without scrolling sideways"() {
    for (const [width, height] of [[390, 844], [820, 1180], [844, 390]]) {
      const page = await open(width, height);
      assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `${width} x ${height}`);
      const smallest = await page.evaluate(() => Math.min(...[...document.querySelectorAll(".pb")].map((button) => button.getBoundingClientRect().width)));
      assert.ok(smallest >= 24, `expected buttons of 24 pixels or more, found ${smallest}`); // WCAG 2.2, 2.5.8
      await page.close();
    }
  },
};

const page = await open(1280, 900);
let failed = 0;
for (const [name, test] of Object.entries(tests)) {
  try {
    await test(page);
    console.log(`passed: ${name}`);
  } catch (error) {
    ++failed;
    console.log(`FAILED: ${name}: ${error.stack}`);
  }
}
if (faults.length > 0) console.log(`FAILED: errors in the browser's console: ${faults.join("; ")}`);
await browser.close();
process.exit(failed + faults.length > 0 ? 1 : 0);

// The display page as a pilot uses it.
import assert from "node:assert/strict";
import { fitsSmallScreens, faults, hasNoSeriousFault, open, run, until, watch } from "./browser.mjs";

const path = "/display.html";

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
  async "the table of keys is that of the help over the display"(page) {
    const rows = await page.$$eval("#keys tr", (list) => list.map((row) => [...row.cells].map(({ textContent }) => textContent)));
    assert.deepEqual(rows.find(([keys]) => keys === "Space"), ["Space", "freeze"]);
    assert.ok(rows.length >= 10, JSON.stringify(rows));
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
    await hasNoSeriousFault(page);
  },
  async "without a recorder the remedy names the button of the page that starts one"(page) {
    await until("power is on", () => watch().power === "OPR");
    await page.click("#pb12");
    const set = () => page.textContent("#set");
    await until("the message and its remedy", async () => /NO RECORDER · start one: Record in the browser/.test(await set()));
    await page.click("button:text-is('Record')");
    await until("VTR is boxed", () => watch().boxed.includes(12));
    await until("no button that starts another", async () => !await page.isVisible("#record"));
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
      if (number !== 11) continue;
      await page.click("#pb11"); // out of the main menu again
      await until("out of the main menu", () => watch().events_applied === before + 2);
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
    await fitsSmallScreens(path, async (page) => {
      const smallest = await page.evaluate(() => Math.min(...[...document.querySelectorAll(".pb")].map((button) => button.getBoundingClientRect().width)));
      assert.ok(smallest >= 24, `expected buttons of 24 pixels or more, found ${smallest}`); // WCAG 2.2, 2.5.8
    });
  },
};

const page = await open(1280, 900, path);
await page.waitForFunction(() => document.getElementById("picture").dataset.frame);
await run(tests, page);

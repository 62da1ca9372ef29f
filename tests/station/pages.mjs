// The display page as a pilot uses it.
import assert from "node:assert/strict";
import { address, browser, faults, fitsAllScreens, hasNameIconAndLinks, hasNoFinding, inSight,
  open, run, session, until, watch } from "./browser.mjs";

const path = "/display.html";

// Names of the buttons up to what they do, as a screen reader says them. The glass has the legends, as in the window.
const namesOf = (page) =>
  page.$$eval(".pb", (list) => list.map((button) => button.getAttribute("aria-label").split(": ")[0]).sort());
const ARROWS = { "^": "up arrow", v: "down arrow" };
function namesWanted() {
  const { legends, boxed } = watch();
  return Array.from({ length: 20 }, (_, at) => at + 1).map((number) => {
    const legend = legends[number] ?? "";
    return [`PB ${number}`, ARROWS[legend] ?? legend, boxed.includes(number) ? "on" : ""]
      .filter((text) => text !== "").join(", ");
  }).sort();
}

async function legendsAgree(page) {
  await until("the names of the buttons have the legends of yars watch", async () =>
    JSON.stringify(await namesOf(page)) === JSON.stringify(namesWanted()));
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
    const rows = await page.$$eval("#keys tr",
      (list) => list.map((row) => [...row.cells].map(({ textContent }) => textContent)));
    assert.deepEqual(rows.find(([keys]) => keys === "Space"), ["Space", "freeze"]);
    assert.ok(rows.length >= 10, JSON.stringify(rows));
  },
  async "the buttons show numbers, because the glass has the legends"(page) {
    await legendsAgree(page);
    assert.deepEqual(await page.$$eval(".pb", (list) => list.map(({ id, innerText }) => id === `pb${innerText}`)),
      Array(20).fill(true));
    const names = await namesOf(page);
    assert.ok(names.includes("PB 13, up arrow") || names.includes("PB 14, down arrow"), names.join());
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
    assert.ok(green > 500, `expected a picture, found ${green} green pixels`);
  },
  async "the page has its name, its icon and the way to the instructor's page, in the same session"(page) {
    await hasNameIconAndLinks(page, ["/instructor.html"]);
    const named = await open(1280, 900, `${path}?session=${session}`);
    assert.equal(await named.getAttribute("header nav a", "href"), `instructor.html?session=${session}`);
    await named.close();
  },
  async "a page says that it only looks, if the station calls it a viewer"(page) {
    assert.equal(await page.textContent("#right"), "");
    for (const name of ["display", "instructor"]) {
      const viewer = await browser.newPage();
      await viewer.routeWebSocket(/socket/, (socket) => { // the station of this test has no tokens
        socket.connectToServer().onMessage(
          (message) => socket.send(/^\{"right"/.test(message) ? '{"right":"viewer"}' : message));
      });
      await viewer.goto(`${address}/${name}.html`);
      await until(`${name}: the line`,
        async () => /^You only look/.test(await viewer.textContent("#right")) && await inSight(viewer, "#right"));
      await viewer.close();
    }
  },
  async "accessibility has no finding with the keys open"(page) {
    await page.click("summary");
    await hasNoFinding(page);
    await page.click("summary");
  },
  async "without a recorder the remedy names the button of the page that starts one"(page) {
    await until("power is on", () => watch().power === "OPR");
    await page.click("#pb12");
    const set = () => page.textContent("#set");
    await until("the message and its remedy",
      async () => /NO RECORDER · start one: Record in the browser/.test(await set()));
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
      assert.match(words, new RegExp(`^PB ${number}\\b`));
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
  async "each screen shows the picture as large as it can be, and all buttons and switches, without scrolling"() {
    await fitsAllScreens(path, async (page, width, height) => {
      const size = `${width} x ${height}`;
      for (const button of await page.$$eval(".mpd button, .controls button:not([hidden])",
        (list) => list.map(({ id, dataset }) => (id ? `#${id}` : `[data-event='${dataset.event}']`))))
        assert.ok(await inSight(page, button), `${size}: ${button} is in sight`);
      assert.ok(await inSight(page, "#picture"), size);
      const edge = await page.$eval("#picture", (picture) => picture.getBoundingClientRect().width);
      // Two rows of buttons take 44 pixels each of the shorter edge, or 9 % where the screen is large.
      const least = Math.min(Math.min(width, height) - 88, 0.82 * Math.min(width, height));
      assert.ok(edge >= least - 0.5, `${size}: expected a picture of ${least} pixels or more, found ${edge}`);
    });
  },
  async "two displays beside each other fit on each screen"() {
    await fitsAllScreens("/beside.html",
      async (page) => hasNameIconAndLinks(page, ["/display.html", "/instructor.html"]));
  },
};

const page = await open(1280, 900, path);
await page.waitForFunction(() => document.getElementById("picture").dataset.frame);
await run(tests, page);

// The instructor's page as an instructor uses it.
import assert from "node:assert/strict";
import { address, browser, call, faults, fitsAllScreens, hasNameIconAndLinks, hasNoFinding,
  inSight, open, run, screens, tooSmall, until, watch } from "./browser.mjs";

const path = "/instructor.html";
const world = () => JSON.parse(call("world", "--json"));
const status = () => { // exit code 3: degraded
  try {
    return JSON.parse(call("status", "--json"));
  } catch (error) {
    return JSON.parse(error.stdout);
  }
};
const near = (value, expected, tolerance) => Math.abs(value - expected) <= tolerance;
// What the list "On the map" has can be pressed and dragged on the map. The world's record has it some 0.1 s earlier.
const onMap = (page, word) => page.waitForSelector(`#things li:has-text('${word}')`);
// The line beside the button Undo.
// The page offers an undo when the answer to the command has come, after the world has changed.
const said = (page, text) => until(`the line ${text}`, async () => text.test(await page.textContent("#undo_text")));
// Two states that the page has received after now: the first may have been under way.
async function twoStates(page) {
  for (let turn = 0; turn < 2; ++turn) {
    const before = await page.textContent("#clock");
    await until("another sim time on the page", async () => await page.textContent("#clock") !== before);
  }
}
const noProblem = async (page) => assert.equal(await page.textContent("#problem"), "");

// Mean of the green of the radar picture in a part of it: x, y, width, height in shares of its edge.
const brightness = (page, part) => page.evaluate(([left, top, width, height]) => {
  const canvas = document.getElementById("picture");
  const { data } = canvas.getContext("2d").getImageData(left * canvas.width, top * canvas.height,
    width * canvas.width, height * canvas.height);
  let sum = 0;
  for (let at = 1; at < data.length; at += 4) sum += data[at];
  return (4 * sum) / data.length;
}, part);

const tests = {
  async "time is frozen, stepped, run, set to a rate and reset"(page) {
    await page.click("#run:text-is('Freeze')");
    await until("frozen", () => !watch().running);
    const before = watch().sim_time;
    await page.fill("#ticks", "200");
    await page.click("#step_form button");
    await until("one second later", () => near(watch().sim_time, before + 1, 0.0051));
    await page.selectOption("#rate", "2");
    await until("rate 2", () => watch().rate === 2);
    await page.click("#run:text-is('Run')");
    await until("running", () => watch().running);
    await page.selectOption("#rate", "1");
    await until("rate 1", () => watch().rate === 1);
    const { epoch } = watch();
    await page.fill("#time", "500");
    await page.click("#reset_form button");
    await until("a new epoch from 500 s", () => {
      const after = watch();
      return after.epoch === epoch + 1 && after.sim_time >= 500;
    });
    await noProblem(page);
  },
  async "the form moves the aircraft, and a speed lets it fly straight"(page) {
    const values = { lat: "37.5", lon: "-122.9", alt: "20000", heading: "45", speed: "300" };
    for (const [id, value] of Object.entries(values)) await page.fill(`#${id}`, value);
    await page.click("#aircraft_form button:not([type])");
    let ownship;
    await until("there", () => {
      ({ ownship } = watch());
      return ownship && near(ownship.lat, 37.5, 0.1) && near(ownship.lon, -122.9, 0.1);
    });
    assert.ok(near(ownship.ground_speed_kt, 300, 1) && near(ownship.heading_deg, 45, 1) &&
      near(ownship.alt_ft, 20000, 1), JSON.stringify(ownship));
    await noProblem(page);
  },
  async "the aircraft is dragged to another place"(page) {
    await page.fill("#speed", "30"); // it stays about where it is put
    assert.equal(await page.getAttribute("#follow", "aria-pressed"), "true");
    await until("the page shows the repositioned aircraft, which is in the middle of its map", async () =>
      /^37\.\d+, -122\.\d+ .* heading 45 .* 300 kt/.test(await page.textContent("#flight")));
    const before = watch().ownship;
    const box = await (await page.$("#map")).boundingBox();
    const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x - 60, y - 40, { steps: 5 });
    await page.mouse.up();
    await until("north-west of where it was", () => {
      const { ownship } = watch();
      return ownship && ownship.lat > before.lat + 0.01 && ownship.lon < before.lon - 0.01;
    });
    await noProblem(page);
  },
  async "errors of the navigators are set"(page) {
    await page.click("text=Navigator errors");
    await page.selectOption("#navigator", "ins");
    await page.fill("#north", "500");
    await page.fill("#east", "-250");
    await page.click("#nav_form button");
    await until("the errors in the state",
      async () => /INS 5\d\d ft north, -2\d\d ft east/.test(await page.textContent("#errors")));
  },
  async "sea state and wind are set"(page) {
    await page.selectOption("#sea", "5");
    await until("sea state 5", () => world().sea_state === 5);
    await page.selectOption("#sea", "");
    await until("sea state by the wind", () => world().sea_state === null);
    await page.fill("#wind", "25");
    await page.fill("#wind_from", "200");
    await page.click("#wind_form button");
    await until("the wind", () => near(world().wind_kt, 25, 0.01) && world().wind_from_deg === 200);
    await noProblem(page);
  },
  async "rain over a town is seen on the map and darkens what lies behind it"(page) {
    const values = { lat: "37.0", lon: "-122.6", alt: "15000", heading: "90", speed: "30" };
    for (const [id, value] of Object.entries(values)) await page.fill(`#${id}`, value);
    await page.click("#aircraft_form button:not([type])");
    await until("there", () => watch().ownship && near(watch().ownship.lon, -122.6, 0.05));
    const far = [0.4, 0.2, 0.2, 0.2]; // ahead, in the farther half
    const { scan } = status().model;
    await until("two whole scans from there", () => status().model.scan >= scan + 3);
    const scanned_s = watch().sim_time;
    await until("their picture", async () => Number(await page.getAttribute("#picture", "data-sim-time")) >= scanned_s);
    const before = await brightness(page, far);
    assert.ok(before > 12, `expected land ahead, found brightness ${before}`);
    await page.click("#add_rain");
    await page.click("#add_rain"); // where the middle of the map is: at the aircraft
    await until("a rain cell", () => world().rain.length === 1);
    await page.click("#things li:has-text('rain') button");
    await page.fill("#thing_rate_mmh", "100");
    await page.fill("#thing_radius_nm", "8");
    await page.fill("#thing_top_ft", "40000");
    await page.click("#thing_form button");
    await until("changed rain", () => world().rain[0].rate_mmh === 100);
    await until("a darker picture behind it", async () => await brightness(page, far) < 0.6 * before);
    await page.click("#things button[aria-label^='Remove']");
    await until("no rain", () => world().rain.length === 0);
    await until("the picture from before", async () => await brightness(page, far) > 0.8 * before);
    await noProblem(page);
  },
  async "sequence points are added, named, selected, dragged, removed and brought back"(page) {
    await page.click("#reset_world");
    await said(page, /^Reset the world/);
    const configured = world().points.length;
    await page.click("#add_points");
    await page.mouse.click(...await middle(page, 70, -60));
    await until("a sequence point", () => world().points.length === configured + 1);
    const { id } = world().points[configured];
    const point = () => world().points.find((one) => one.id === id);
    await page.click(`#things li:has-text("point ${point().name}") button`);
    await page.fill("#thing_name", "90.");
    await page.fill("#thing_elevation_ft", "250");
    await page.click("#thing_form button");
    await until("a target with an elevation", () => point().name === "90." && point().kind === "target" &&
      near(point().elevation_ft, 250, 0.01));
    await page.selectOption("#points", "90.");
    await page.click("#steer_form button");
    await until("the pilot's selected point",
      () => watch().sequence_point === "90." && watch().points_drawn.includes("90."));
    await until("the page names the pilot's point",
      async () => /90\. \(selected\)/.test(await page.textContent("#points")));
    await page.selectOption("#places", { label: "sequence point 90." });
    await until("the map at the point", async () => await page.getAttribute("#follow", "aria-pressed") === "false");
    const before = point();
    await page.mouse.move(...await middle(page, 0, 0));
    await page.mouse.down();
    await page.mouse.move(...await middle(page, -90, 20), { steps: 5 });
    await page.mouse.up();
    await until("farther west", () => point().longitude_deg < before.longitude_deg - 0.001);
    const moved = point();
    await page.click("#things button[aria-label='Remove point 90.']");
    await until("no such point", () => point() === undefined);
    await said(page, /^Removed point 90\./);
    await page.click("#undo_button");
    await until("the same point", () => JSON.stringify(point()) === JSON.stringify(moved));
    await page.click("#reset_world");
    await until("the configured points", () => world().points.length === configured);
    await noProblem(page);
  },
  async "entries of all lists are added, dragged, changed and removed"(page) {
    const lists = Object.keys(world()).filter((name) => Array.isArray(world()[name]));
    const configured = lists.map((list) => world()[list].length);
    for (const list of lists) {
      const known = world()[list].map(({ id }) => id);
      const added = () => world()[list].find(({ id }) => !known.includes(id));
      await page.click(`#add_${list}`);
      await page.mouse.click(...await middle(page, 80, 60));
      await until(`one more of ${list}`, added);
      const before = added();
      await onMap(page, list === "points" ? `point ${before.name}` : list.replace(/s$/, ""));
      await page.mouse.move(...await middle(page, 80, 60));
      await page.mouse.down();
      await page.mouse.move(...await middle(page, -80, 90), { steps: 5 });
      await page.mouse.up();
      await until("moved", () => added().longitude_deg < before.longitude_deg - 0.001);
    }
    await page.click("#things li:has-text('mover') button");
    await page.fill("#thing_speed_kt", "25");
    await page.fill("#thing_heading_deg", "270");
    await page.click("#thing_form button");
    await until("the mover's way",
      () => near(world().movers[0].speed_kt, 25, 0.01) && near(world().movers[0].heading_deg, 270, 0.1));
    await page.click("#reset_world");
    await until("the configured world", () => lists.every((list, at) => world()[list].length === configured[at]));
    await noProblem(page);
  },
  async "what was removed comes back as it was"(page) {
    await page.click("#add_jammers");
    await page.click("#add_jammers"); // in the middle of the map
    await until("a jammer", () => world().jammers.length === 1);
    await page.click("#things li:has-text('jammer') button");
    await page.fill("#thing_power_w", "33");
    await page.click("#thing_form button");
    await until("33 W", () => world().jammers[0].power_w === 33);
    const before = world().jammers;
    await page.focus("#things button[aria-label^='Remove jammer']");
    await page.keyboard.press("Enter");
    await until("no jammer", () => world().jammers.length === 0);
    await said(page, /^Removed jammer/);
    assert.equal(await page.getAttribute("#undo_text", "role"), "status");
    assert.equal(await page.evaluate(() => document.activeElement.id), "undo_button");
    await page.keyboard.press("Enter");
    await until("the same jammer", () => JSON.stringify(world().jammers) === JSON.stringify(before));
    await said(page, /jammer .* is back/);
    // The last removal is taken back first; a key does it too.
    await page.click("#things button[aria-label^='Remove jammer']");
    await until("no jammer", () => world().jammers.length === 0);
    await said(page, /^Removed jammer/);
    await page.click("#add_movers");
    await page.click("#add_movers");
    await until("a mover", () => world().movers.length === 1);
    await page.click("#things button[aria-label^='Remove mover']");
    await until("no mover", () => world().movers.length === 0);
    await said(page, /^Removed mover/);
    await page.keyboard.press("Control+z");
    await until("the mover", () => world().movers.length === 1);
    await said(page, /mover .* is back/);
    assert.equal(world().jammers.length, 0);
    await page.keyboard.press("Control+z");
    await until("the jammer", () => JSON.stringify(world().jammers) === JSON.stringify(before));
    await noProblem(page);
  },
  async "a removal is undone after a reset of the world, and so is the reset"(page) {
    const before = world();
    const isBack = () => JSON.stringify(world().jammers) === JSON.stringify(before.jammers);
    await page.click("#things button[aria-label^='Remove jammer']");
    await said(page, /^Removed jammer/);
    assert.equal(world().jammers.length, 0);
    await page.click("#reset_world");
    await said(page, /^Reset the world/);
    assert.equal(world().movers.length, 0);
    await page.click("#undo_button");
    await said(page, /^The changed world is back/);
    assert.ok(world().movers.length === 1 && world().jammers.length === 0);
    await page.click("#undo_button");
    await said(page, /^jammer .* is back/);
    assert.ok(isBack());
    await page.click("#things button[aria-label^='Remove jammer']");
    await said(page, /^Removed jammer/);
    assert.equal(world().jammers.length, 0);
    call("world", "reset");
    await page.click("#undo_button");
    await said(page, /^jammer .* is back/);
    assert.ok(isBack(), "after a reset from elsewhere");
    await noProblem(page);
    await page.click("#reset_world");
    await said(page, /^Reset the world/);
    assert.equal(world().jammers.length, 0);
    call("world", "sea", "4");
    await page.click("#undo_button");
    await until("a reset that others have built upon stays",
      async () => /no change of the world since/.test(await page.textContent("#problem")));
    await until("an undo that failed is offered again", async () => await page.isVisible("#undo_button"));
    await page.click("#reset_world");
    await said(page, /^Reset the world/);
    await page.click("#undo_close");
    await until("no line", async () => !await page.isVisible("#undo"));
  },
  async "a killed role is started again, and the world stays"(page) {
    await page.selectOption("#sea", "3");
    await until("sea state 3", () => world().sea_state === 3);
    const before = watch().processes["radar-model"].pid;
    await kill(page, "radar-model");
    await until("another process",
      () => watch().processes["radar-model"] && watch().processes["radar-model"].pid !== before);
    await until("sea state 3 in effect", () => world().sea_state === 3);
    await page.click("#reset_world");
    await said(page, /^Reset the world/);
  },
  async "the dial of fidelity changes the preset of the next scan"(page) {
    await page.selectOption("#fidelity", "draft");
    await until("draft", () => status().model.fidelity === "draft");
    await until("the page says so", async () => /in use: draft/.test(await page.textContent("#fidelity_error")));
    await page.selectOption("#fidelity",
      await page.$eval("#fidelity option:has-text('configured')", (option) => option.value));
    await until("standard", () => status().model.fidelity === "standard");
  },
  async "notes are written"(page) {
    await page.fill("#note", "a note of the test");
    await page.click("#note_form button");
    await until("the note", async () => /a note of the test/.test(await page.textContent("#notes")));
    assert.ok(status().notes.some(({ text }) => text.includes("a note of the test")));
  },
  async "a recording is made, played, scrubbed, and flown out of"(page) {
    await page.click("#record:text-is('Record')");
    await until("the recorder writes", () => status().recorder?.writing);
    const end = watch().sim_time + 4;
    await until("four seconds of it", () => watch().sim_time >= end);
    await page.click("#record:text-is('Pause recording')");
    await until("the recorder stands", () => status().recorder?.writing === false);
    await page.click("#machine summary");
    await until("a recording in the list", async () => {
      await page.click("#list");
      return await page.$("#recordings li button") !== null;
    });
    await page.click("#recordings li button");
    await page.click("#play");
    await page.waitForFunction(() => document.getElementById("replay_picture").dataset.frame);
    await until("it plays", async () => await page.textContent("#play") === "Pause");
    await page.click("#play");
    await until("the replay stands", async () => await page.textContent("#play") === "Go on");
    const at = Math.round((end - 2) * 10) / 10;
    const frame = await page.getAttribute("#replay_picture", "data-frame");
    assert.equal(await page.locator("#machine input[type=range]").count(), 1, "one slider");
    await page.$eval("#at", (scrub, value) => {
      scrub.value = String(value);
      scrub.dispatchEvent(new Event("input"));
      scrub.dispatchEvent(new Event("change"));
    }, at);
    await until("another picture of that time",
      async () => await page.getAttribute("#replay_picture", "data-frame") !== frame &&
      near(Number(await page.getAttribute("#replay_picture", "data-sim-time")), at, 0.3));
    await page.click("button[data-step='-1']");
    await until("a second before",
      async () => near(Number(await page.getAttribute("#replay_picture", "data-sim-time")), at - 1, 0.3));
    await page.click("button[data-step='1']");
    await page.click("#fly_out");
    await until("a branch", async () => await page.$("#sets li:has-text('branch') a") !== null);
    const branch = /session=([\w-]+)/.exec(await page.getAttribute("#sets li:has-text('branch') a", "href"))[1];
    const beside = await browser.newPage();
    await until("the branch flies", async () => {
      const answer = await beside.goto(`${address}/beside.html?right=${branch}`);
      if (!answer.ok()) return false;
      try {
        await beside.waitForFunction((from) => parseFloat(document.getElementById("right_words").textContent) > from &&
          document.getElementById("right_picture").dataset.frame, at, { timeout: 3000 });
        return true;
      } catch {
        return false;
      }
    });
    await beside.close();
    await page.click(`button[aria-label='End ${branch}']`);
    await until("the branch has ended", async () => await page.$(`button[aria-label='End ${branch}']`) === null);
    await page.click("#stop");
    await until("no replay", async () => !await page.isVisible("#replay_picture"));
    await page.click("button[aria-label='End the recorder']");
    await until("no recorder", () => status().recorder === null);
    await until("nothing is being written", async () => !/being written/.test(await page.textContent("#recordings")));
    faults.length = 0; // a page that waits for a session logs refused connections
    await noProblem(page);
  },
  async "a recording whose recorder was killed is no longer being written"(page) {
    await page.click("#record:text-is('Record')");
    await until("the recorder writes", () => status().recorder?.writing);
    await until("being written", async () => /being written/.test(await page.textContent("#recordings")));
    await until("a part of it is on the disk", () => status().recorder.bytes > 2000);
    await kill(page, "recorder");
    await until("cut short",
      async () => /cut short: its recorder was killed/.test(await page.textContent("#recordings")));
    assert.doesNotMatch(await page.textContent("#recordings"), /being written/);
    await noProblem(page);
  },
  async "the form of the aircraft shows present values until others are typed"(page) {
    const latitude = () => page.$eval("#lat", (field) => field.value);
    await page.click("h1");
    const before = await latitude();
    await page.fill("#lat", "");
    await twoStates(page);
    assert.equal(await latitude(), "", "an empty field stays empty");
    const { epoch } = watch();
    await page.click("#aircraft_form button:not([type])");
    await page.fill("#note", "after the empty field"); // commands of a page are done in their order
    await page.click("#note_form button");
    await until("the note", async () => /after the empty field/.test(await page.textContent("#notes")));
    assert.equal(watch().epoch, epoch, "and moves nothing");
    await page.click("#copy");
    assert.ok(near(Number(await latitude()), Number(before), 1));
  },
  async "accessibility has no finding with all sections open"(page) {
    await page.$$eval("details", (list) => { for (const one of list) one.open = true; });
    await hasNoFinding(page);
  },
  async "the page has its name, its icon and the way to the display"(page) {
    await hasNameIconAndLinks(page, ["/display.html"]);
  },
  async "each screen shows it without scrolling sideways, with all sections open"() {
    await fitsAllScreens(path, async (page, width, height) => {
      assert.ok(await inSight(page, "#map"), `${width} x ${height}`);
      await page.$$eval("details", (list) => { for (const one of list) one.open = true; });
      assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `${width} x ${height}`);
      assert.ok(await page.$eval("aside", (panel) => panel.scrollWidth <= panel.clientWidth),
        `${width} x ${height}: the panel`);
      assert.deepEqual(await tooSmall(page), [], `${width} x ${height}`);
    });
  },
  async "labels of the map lie on no symbol and no other label, and the list has straight rows"() {
    // A crowd: six things in a square of 2 NM.
    const { lat, lon } = watch().ownship;
    for (let at = 0; at < 6; ++at)
      call("world", "mover", "add", String(lat + 0.02 * (at % 3) - 0.02), String(lon + 0.02 * Math.floor(at / 3)),
        "--name", `crowded ship ${at}`);
    call("world", "jammer", "add", String(lat), String(lon - 0.01), "--name", "SA-X");
    const page = await open(1400, 1000, path, recordDrawings);
    await onMap(page, "crowded ship 5");
    await until("a drawing of the crowd", async () =>
      (await page.evaluate(() => globalThis.drawing.symbols.length)) > 3);
    const overlaps = () => page.evaluate(() => {
      const { symbols, texts } = globalThis.drawing;
      const meet = (one, other) => one[0] < other[2] && other[0] < one[2] && one[1] < other[3] && other[1] < one[3];
      return texts.flatMap(({ text, box, symbolsBefore }, at) => [
        ...symbols.filter((symbol) => meet(symbol, box)).map((symbol) => `${text} ${box} on a symbol ${symbol}`),
        ...texts.slice(0, at).filter((other) => meet(other.box, box)).map((other) => `${text} on ${other.text}`),
        ...(symbolsBefore < symbols.length ? [`${text} lies below a symbol`] : []),
      ]);
    });
    assert.deepEqual(await overlaps(), []);
    for (let turn = 0; turn < 3; ++turn) {
      await page.click("#zoom_in");
      await twoStates(page);
      assert.deepEqual(await overlaps(), [], `nearer: ${turn}`);
    }
    assert.ok(await page.evaluate(() => globalThis.drawing.symbols.length > 3 && globalThis.drawing.texts.length > 3 &&
      globalThis.drawing.texts.some(({ text }) => text === "SA-X")));
    const rows = await page.$$eval("#things li", (list) => list.map((row) =>
      [...row.querySelectorAll("button")].map((button) => {
        const { left, right } = button.getBoundingClientRect();
        return [left, right].map(Math.round).join();
      })));
    const [names, removals] = [0, 1].map((column) =>
      new Set(rows.map((row) => row[column]).filter((edges) => edges !== undefined)));
    assert.ok(rows.length >= 8 && names.size === 1 && removals.size === 1, JSON.stringify(rows));
    await page.close();
    call("world", "reset");
  },
  async "the hint after Add rain is in sight, with buttons for what a finger cannot do otherwise"() {
    for (const [width, height] of screens) {
      const page = await open(width, height, path);
      const cells = world().rain.length;
      await page.click("#add_rain");
      for (const shown of ["#adding", "#add_middle", "#add_cancel"])
        assert.ok(await inSight(page, shown), `${width} x ${height}: ${shown}`);
      assert.match(await page.textContent("#adding"), /Press on the map where the rain/);
      assert.equal(await page.getAttribute("#adding", "role"), "status");
      await page.click("#add_cancel");
      assert.equal(await page.textContent("#adding"), "");
      assert.equal(await page.isVisible("#add_middle"), false);
      await page.click("#add_rain");
      await page.click("#add_middle");
      await until("one more rain cell", () => world().rain.length === cells + 1);
      await onMap(page, "rain");
      await page.close();
    }
    call("world", "reset");
  },
  async "Kill has a place of its own, and does nothing until a role is chosen"(page) {
    assert.deepEqual(await page.$$eval("#roles button, #roles a", (list) => list.length), 0,
      "no button stands in the table");
    assert.deepEqual(await page.$$eval("#kill_form button", (list) => list.map(({ textContent }) => textContent)),
      ["Kill"]);
    const { processes } = watch();
    assert.equal(await page.inputValue("#kill_role"), "");
    await page.click("#kill_form button");
    await twoStates(page);
    assert.equal(watch().processes["radar-model"].pid, processes["radar-model"].pid);
    await page.selectOption("#kill_role", "radar-model");
    await twoStates(page);
    assert.equal(await page.inputValue("#kill_role"), "radar-model", "a choice stays while states come");
    await page.selectOption("#kill_role", "");
    await noProblem(page);
  },
  async "what is chosen on the map shows its values"(page) {
    await page.click("#add_jammers");
    await page.mouse.click(...await middle(page, 120, 90));
    await onMap(page, "jammer");
    await page.evaluate(() => { document.querySelector("aside").scrollTop = 0; });
    await page.mouse.click(...await middle(page, 120, 90));
    await until("the form of the jammer in sight",
      async () => await page.isVisible("#thing_power_w") && await inSight(page, "#thing_power_w"));
    call("world", "reset");
  },
  async "links lead to the sections of the page on a phone, and stay in view"() {
    const page = await open(390, 844, path);
    for (const [name, id] of [["Replay", "machine"], ["World", "world_section"], ["Map", "theatre"]]) {
      await page.click(`#sections a:text-is("${name}")`);
      const [section, links] = await page.evaluate((id) =>
        [document.getElementById(id), document.getElementById("sections")]
        .map((found) => found.getBoundingClientRect()).map(({ top, bottom }) => ({ top, bottom })), id);
      assert.ok(section.top >= links.bottom - 2 && section.top < 844 - 60,
        `${name}: ${JSON.stringify([section, links])}`);
      assert.ok(links.top >= 0, `the links are in view: ${links.top}`);
      assert.ok(await page.evaluate((id) => document.getElementById(id).contains(document.activeElement), id),
        `the focus is in ${name}`);
    }
    assert.ok(await page.evaluate(() => document.getElementById("machine").open), "Replay opened its section");
    await page.close();
    const desktop = await open(1400, 1000, path);
    assert.equal(await desktop.isVisible("#sections"), false, "a desktop shows all sections without links");
    await desktop.close();
  },
};

// Records what the map draws last: boxes of small shapes, which are symbols, and those of labels, in CSS pixels.
function recordDrawings() {
  const { prototype } = CanvasRenderingContext2D;
  let next = { symbols: [], texts: [] }, path = [];
  globalThis.drawing = next;
  const around = (name, record) => {
    const draw = prototype[name];
    prototype[name] = function (...values) {
      if (this.canvas.id === "map") record(this, values);
      return draw.apply(this, values);
    };
  };
  const to = (context, x, y) => {
    const { a, b, c, d, e, f } = context.getTransform();
    path.push([(a * x + c * y + e) / devicePixelRatio, (b * x + d * y + f) / devicePixelRatio]);
  };
  around("fillRect", (context, [left, top]) => {
    if (left !== 0 || top !== 0) return; // the ground, with which a drawing begins
    globalThis.drawing = next;
    next = { symbols: [], texts: [] };
  });
  around("beginPath", () => { path = []; });
  around("moveTo", (context, [x, y]) => to(context, x, y));
  around("lineTo", (context, [x, y]) => to(context, x, y));
  around("rect", (context, [x, y, width, height]) => { to(context, x, y); to(context, x + width, y + height); });
  around("arc", (context, [x, y, radius]) => {
    to(context, x - radius, y - radius);
    to(context, x + radius, y + radius);
  });
  around("fill", (context) => {
    if (context.fillStyle instanceof CanvasGradient) return; // the extent of a rain cell
    const edges = [Math.min(...path.map(([x]) => x)), Math.min(...path.map(([, y]) => y)),
      Math.max(...path.map(([x]) => x)), Math.max(...path.map(([, y]) => y))];
    if (edges[2] - edges[0] < 40 && edges[3] - edges[1] < 40) next.symbols.push(edges);
  });
  around("fillText", (context, [text, x, y]) => {
    if (/^[0-9.]+ NM$/.test(text)) return; // the scale
    const half = context.measureText(text).width / 2;
    next.texts.push({ text, box: [x - half, y - 9, x + half, y + 2], symbolsBefore: next.symbols.length });
  });
}

async function kill(page, role) {
  await page.selectOption("#kill_role", role);
  await page.click("#kill_form button");
}

async function middle(page, right, down) {
  const box = await (await page.$("#map")).boundingBox();
  return [box.x + box.width / 2 + right, box.y + box.height / 2 + down];
}

await run(tests, await open(1400, 1000, path));

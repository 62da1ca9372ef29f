// The page of the display: the MPD with its twenty buttons, keys, touch, and the state of the connection.
import { Connection, sessionOfPage } from "./connection";
import { State, Theatre } from "./messages";
import { element, keepSession, onClick, say, sayRight } from "./page";
import { Picture } from "./picture";

const BUTTONS = 20;
const STALE_MS = 2000; // a display that is silent for longer is dead
const ARROWS: Record<string, string> = { "^": "up arrow", v: "down arrow" }; // legends that the picture draws as arrows
const SIDES = ["left", "bottom", "right_side", "top"] as const; // of PB 1-5, 6-10, 11-15, 16-20

// Keys that the browser would act on itself. Others with Ctrl, Alt or Meta stay the browser's.
const SENT = new Set(["ArrowUp", "ArrowDown", "ArrowLeft", "ArrowRight", "Enter", "Tab", "PageUp", "PageDown", " ",
  "F4", "F5", "F6", "F7", "[", "]"]);

class DisplayPage {
  private readonly picture = new Picture(element<HTMLCanvasElement>("picture"));
  private readonly buttons: HTMLButtonElement[] = [];
  private readonly status = element("status");
  private readonly age = element("age");
  private readonly words = element("words");
  private readonly connection: Connection;
  private pointing = false;
  private explained = 0; // push button whose words are shown; 0: none
  private waiting: { x: number; y: number } | undefined;
  private lastFrame_ms = 0;
  private display_ms: number | undefined; // when radar-display last was alive

  constructor() {
    for (let button = 1; button <= BUTTONS; ++button) this.addButton(button);
    this.connection = new Connection({
      state: (state) => this.showState(state),
      frame: (frame) => {
        this.lastFrame_ms = performance.now();
        this.picture.show(frame);
      },
      refused: (problem) => this.showRefusal(problem),
      right: sayRight,
      connected: (open) => this.showConnection(open),
    }, "display", sessionOfPage());
    for (const control of document.querySelectorAll<HTMLButtonElement>("button[data-event]"))
      control.addEventListener("click", () => this.connection.event(control.dataset.event ?? ""));
    onClick("record", () => void this.record());
    keepSession(sessionOfPage());
    this.listenToKeys();
    this.listenToPointer();
    void this.showKeys();
    setInterval(() => this.showAge(), 200);
  }

  private addButton(number: number): void {
    const button = document.createElement("button");
    button.type = "button";
    button.id = `pb${number}`;
    button.className = "pb";
    button.setAttribute("aria-label", `Push button ${number}`);
    button.textContent = String(number); // the legend is on the glass, beside it
    button.addEventListener("click", () => this.connection.event(`pb ${number}`));
    const show = () => this.showWords(number);
    button.addEventListener("pointerenter", show);
    button.addEventListener("focus", show);
    this.buttons.push(button);
    const side = element(SIDES[Math.floor((number - 1) / 5)]);
    // Buttons count counter-clockwise: upwards on the right side, to the left at the top.
    if (number > 10) side.prepend(button);
    else side.append(button);
  }

  private async showKeys(): Promise<void> {
    const { keys } = await (await fetch("theatre.json")).json() as Theatre;
    for (const { keys: names, does } of keys) {
      const row = element<HTMLTableSectionElement>("keys").insertRow();
      row.insertCell().textContent = names;
      row.insertCell().textContent = does;
    }
  }

  private async record(): Promise<void> {
    const { problem } = await this.connection.command("record");
    say("words", problem ?? "The recorder starts. PB 12 stops it and starts it again.");
  }

  private showState(state: State): void {
    const { watch } = state;
    element("record").hidden = state.recorder;
    for (let number = 1; number <= BUTTONS; ++number) {
      const button = this.buttons[number - 1];
      const legend = watch.legends[String(number)] ?? "";
      const { key, does } = state.buttons[number - 1];
      const boxed = watch.boxed.includes(number);
      button.classList.toggle("boxed", boxed);
      button.classList.toggle("dead", legend === "");
      const name = [`PB ${number}`, ARROWS[legend] ?? legend, boxed ? "on" : ""]
        .filter((text) => text !== "").join(", ");
      const label = `${name}: ${does}`;
      if (button.getAttribute("aria-label") !== label) button.setAttribute("aria-label", label);
      const words = `PB ${number}${key ? `, key ${key}` : ""}: ${does}`;
      if (button.title !== words) {
        button.title = words;
        if (this.explained === number) this.showWords(number);
      }
    }
    const roles = ["state-machine", "radar-model", "radar-display"].filter((role) => !(role in watch.processes));
    element("set").textContent = [
      `power ${watch.power}`, watch.mode,
      watch.running ? (watch.rate === 1 ? "" : `rate ${watch.rate}`) : "time stands",
      roles.length > 0 ? `not running: ${roles.join(", ")}` : "", watch.message, watch.remedy,
    ].filter((text) => text !== "").join(" · ");
    const heartbeat_ms = watch.processes["radar-display"]?.heartbeat_ms;
    if (heartbeat_ms !== undefined) this.display_ms = performance.now() - heartbeat_ms;
    document.body.dataset.state = "shown";
  }

  private showWords(number: number): void {
    this.explained = number;
    this.words.textContent = this.buttons[number - 1].title;
  }

  private showRefusal(problem: string): void {
    this.explained = 0;
    say("words", `Not done: ${problem}.`);
  }

  private showConnection(open: boolean): void {
    document.body.dataset.connection = open ? "open" : "lost";
    this.status.textContent = open ? "connected" : "no connection: the station does not answer; trying again";
  }

  // The age of the picture, where it is old: no display or no connection. A picture that does not change is not old.
  private showAge(): void {
    const now_ms = performance.now();
    const alive = this.display_ms !== undefined && now_ms - this.display_ms < STALE_MS;
    const drawn = this.lastFrame_ms !== 0;
    document.body.classList.toggle("stale", !alive || !drawn);
    if (!drawn)
      this.age.textContent =
        alive ? "no picture: radar-display does not publish its frames (--publish)" : "no picture yet";
    else
      this.age.textContent =
        alive ? "" : `picture ${((now_ms - (this.display_ms ?? this.lastFrame_ms)) / 1000).toFixed(0)} s old`;
  }

  private listenToKeys(): void {
    const wanted = (event: KeyboardEvent) => {
      if (event.ctrlKey || event.altKey || event.metaKey) return false;
      // A focused button keeps Enter, Space and Tab: so the page works by keyboard alone.
      if (event.target instanceof HTMLButtonElement && ["Enter", " ", "Tab"].includes(event.key)) return false;
      if (event.key === "Tab" && document.activeElement !== element("picture")) return false;
      return SENT.has(event.key) || /^[a-z0-9]$/i.test(event.key);
    };
    window.addEventListener("keydown", (event) => {
      if (!wanted(event)) return;
      event.preventDefault();
      if (!event.repeat) this.connection.key(event.key, true);
    });
    window.addEventListener("keyup", (event) => {
      if (wanted(event)) this.connection.key(event.key, false);
    });
    window.addEventListener("blur", () => this.connection.releaseAll());
    document.addEventListener("visibilitychange", () => {
      if (document.hidden) this.connection.releaseAll();
    });
  }

  // A finger or the mouse on the picture puts the cursor there; its release presses and releases the TDC.
  private listenToPointer(): void {
    const canvas = element<HTMLCanvasElement>("picture");
    const put = (event: PointerEvent) => {
      const box = canvas.getBoundingClientRect();
      const inside = (value: number) => Math.min(1, Math.max(0, value)).toFixed(4);
      this.connection.event(`cursor ${inside((event.clientX - box.left) / box.width)} ${
        inside((event.clientY - box.top) / box.height)}`);
    };
    canvas.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      canvas.setPointerCapture(event.pointerId);
      canvas.focus();
      this.pointing = true;
      put(event);
      this.connection.event("tdc press");
    });
    canvas.addEventListener("pointermove", (event) => {
      if (!this.pointing) return;
      const first = this.waiting === undefined;
      this.waiting = { x: event.clientX, y: event.clientY };
      if (first) requestAnimationFrame(() => { // at most one event a picture of the screen
        this.waiting = undefined;
        if (this.pointing) put(event);
      });
    });
    canvas.addEventListener("pointerup", (event) => {
      if (!this.pointing) return;
      this.pointing = false;
      const box = canvas.getBoundingClientRect();
      const inside = event.clientX >= box.left && event.clientX <= box.right &&
        event.clientY >= box.top && event.clientY <= box.bottom;
      if (inside) this.connection.event("tdc release"); // beside the picture it designates nothing, as in the window
    });
    canvas.addEventListener("pointercancel", () => { this.pointing = false; });
  }
}

new DisplayPage();

// The instructor's page: map, time, aircraft, world, set, time machine.
import { Connection, sessionOfPage } from "./connection";
import { Position, TheatreMap, Thing } from "./map";
import { Answer, InstructorState, RoleEntry, Theatre } from "./messages";
import { element, fill, keepSession, limit, onClick, onSubmit, say, sayRight } from "./page";
import { Picture } from "./picture";
import { PRESETS, wordsOfPreset } from "./presets";
import { listenToSections } from "./sections";
import { TimeMachine } from "./time_machine";
import { FIELDS, LATEST_SIM_TIME_S } from "./values";
import { WorldPanel } from "./world_panel";

const DIGITS = 5; // of positions in degrees: 1 m
const TOGGLE_MS = 500; // the state has the effect of a command by then
const input = (id: string): HTMLInputElement => element<HTMLInputElement>(id);
const number = (id: string): number => input(id).valueAsNumber;

const groundOf = (above_ft: number | null): string =>
  above_ft === null ? "no terrain below"
    : above_ft < 0 ? "below the ground" : `${Math.round(above_ft)} ft above the ground`;

class InstructorPage {
  private readonly connection: Connection;
  private readonly map: TheatreMap;
  private readonly picture = new Picture(element<HTMLCanvasElement>("picture"));
  private readonly machine: TimeMachine;
  private readonly world: WorldPanel;
  private state: InstructorState | undefined;
  private theatre: Theatre | undefined;
  private places: (Position & { name: string })[] = [];
  private toggled: { running: boolean; at: number } | undefined; // what Run or Freeze last asked for
  private typed = false; // values of the aircraft that are not sent yet

  constructor() {
    this.map = new TheatreMap(element<HTMLCanvasElement>("map"), {
      moved: (thing, to) => this.move(thing, to),
      chosen: (thing) => this.world.choose(thing),
      placed: (at) => this.world.add(at),
    });
    this.connection = new Connection({
      instructor: (state) => this.show(state),
      sets: (sets) => this.machine.showSets(sets),
      frame: (frame) => this.picture.show(frame),
      right: sayRight,
      connected: (open) => {
        document.body.dataset.connection = open ? "open" : "lost";
        if (!open) say("health", "");
        if (open) {
          say("problem", "");
          this.world.forgetRemovals();
        }
        say("status", open ? "connected" : "no connection: the station does not answer; trying again");
      },
    }, "instructor", sessionOfPage());
    this.world = new WorldPanel(this.map, (name, values) => this.order(name, values), () => this.showFollow());
    this.machine = new TimeMachine(this.connection, (answer) => this.tell(answer));
    this.listenToMap();
    this.listenToTime();
    this.listenToAircraft();
    this.listenToSet();
    listenToSections();
    keepSession(sessionOfPage());
    if (sessionOfPage()) {
      document.title = `YARS instructor: ${sessionOfPage()}`;
      say("title", `Instructor of ${sessionOfPage()}`);
    }
    void this.readTheatre();
  }

  private async readTheatre(): Promise<void> {
    this.theatre = await (await fetch("theatre.json")).json() as Theatre;
    this.map.show(this.theatre);
    this.showPlaces();
  }

  // The places that the map can go to, and the sequence points that can be selected.
  private showPlaces(): void {
    const points = this.state?.world?.points ?? [];
    const { scenes, beacons } = this.theatre ?? { scenes: [], beacons: [] };
    this.places = [
      ...scenes,
      ...points.map((point) =>
        ({ name: `sequence point ${point.name}`, lat: point.latitude_deg, lon: point.longitude_deg })),
      ...beacons.map((beacon) => ({ ...beacon, name: `beacon ${beacon.name || beacon.code}` })),
    ];
    const names = this.places.map(({ name }) => name);
    fill("places", names.join(), () =>
      [new Option("a place or a point", ""), ...names.map((name, at) => new Option(name, String(at)))]);
    const selected = this.state?.sequence_point ?? "";
    fill("points", `${points.map(({ name }) => name).join()} ${selected}`, () => points.map(({ name }) =>
      new Option(name === selected ? `${name} (selected)` : name, name, false, name === selected)));
  }
  private goToPlace(): void {
    const places = element<HTMLSelectElement>("places");
    const place = this.places[Number(places.value)];
    if (places.value !== "" && place) this.map.goTo(place);
    this.showFollow();
    places.value = "";
  }

  // Sends a command and says why it was not done.
  private async order(name: string, values: object = {}): Promise<Answer> {
    say("problem", "");
    const answer = await this.connection.command(name, values);
    this.tell(answer);
    return answer;
  }
  private tell(answer: Answer): void {
    say("problem", answer.problem ?? "");
  }

  private listenToMap(): void {
    onClick("zoom_in", () => this.map.zoom(1.6));
    onClick("zoom_out", () => this.map.zoom(1 / 1.6));
    element("places").addEventListener("change", () => this.goToPlace());
    onClick("follow", () => {
      this.map.follow = !this.map.follow;
      this.showFollow();
    });
    element("map").addEventListener("pointerup", () => this.showFollow());
    element("map").addEventListener("keydown", () => this.showFollow());
  }
  private showFollow(): void {
    element("follow").setAttribute("aria-pressed", String(this.map.follow));
  }

  private listenToTime(): void {
    onClick("run", () => this.toggleRunning());
    element("rate").addEventListener("change", () =>
      void this.order("rate", { rate: Number(element<HTMLSelectElement>("rate").value) }));
    onSubmit("step_form", () => void this.order("step", { ticks: number("ticks") }));
    Object.assign(input("time"), { min: "0", max: String(LATEST_SIM_TIME_S), step: "any" });
    onSubmit("reset_form", () => void this.order("reset", { time: number("time") }));
  }

  // Presses in quick succession alternate, also before the state has the effect of the first.
  private toggleRunning(): void {
    const now = performance.now();
    const running = this.toggled && now - this.toggled.at < TOGGLE_MS
      ? this.toggled.running : this.state?.clock.running;
    this.toggled = { running: !running, at: now };
    void this.order(running ? "freeze" : "run");
  }

  private listenToAircraft(): void {
    for (const [id, field] of Object.entries({
      lat: "latitude", lon: "longitude", alt: "altitude", heading: "heading", speed: "speed",
    } as const))
      limit(input(id), FIELDS.Reposition[field]);
    element("aircraft_form").addEventListener("input", () => { this.typed = true; });
    onClick("copy", () => {
      this.typed = false;
      this.showAircraftForm();
    });
    onSubmit("aircraft_form", () => void this
      .reposition({ lat: number("lat"), lon: number("lon") }, number("alt"), number("heading"))
      .then(({ problem }) => { if (problem === null) this.typed = false; }));
    onSubmit("steer_form", () => this.connection.event(`sp ${element<HTMLSelectElement>("points").value}`));
    onSubmit("nav_form", () => this.connection.event(
      `nav error ${element<HTMLSelectElement>("navigator").value} ${number("north")} ${number("east")}`));
  }
  // The present values, until the instructor types others.
  private showAircraftForm(): void {
    const aircraft = this.state?.aircraft;
    if (!aircraft || this.typed) return;
    input("lat").value = aircraft.lat.toFixed(DIGITS);
    input("lon").value = aircraft.lon.toFixed(DIGITS);
    input("alt").value = aircraft.alt_ft.toFixed(0);
    input("heading").value = (aircraft.heading_deg % 360).toFixed(1);
  }
  private reposition(to: Position, alt_ft: number, heading: number): Promise<Answer> {
    const speed = number("speed");
    return this.order("reposition",
      { lat: to.lat, lon: to.lon, alt_ft, heading, speed_kt: Number.isNaN(speed) ? null : speed });
  }

  private move(thing: Thing, to: Position): void {
    const aircraft = this.state?.aircraft;
    if (thing.kind !== "aircraft") void this.order("move", { list: thing.kind, item: thing.id, ...to });
    else if (aircraft) void this.reposition(to, aircraft.alt_ft, aircraft.heading_deg % 360);
  }

  private listenToSet(): void {
    const fidelity = element<HTMLSelectElement>("fidelity");
    fidelity.addEventListener("change", () => void this.order("fidelity",
      { preset: fidelity.value === this.theatre?.fidelity ? "" : fidelity.value }));
    onClick("record", () => {
      if (this.state?.status?.recorder) this.connection.event("pb 12");
      else void this.order("record");
    });
    onSubmit("note_form", () => {
      void this.order("note", { text: input("note").value });
      input("note").value = "";
    });
    onSubmit("kill_form", () => {
      const role = element<HTMLSelectElement>("kill_role");
      void this.order("kill", { role: role.value });
      role.value = ""; // the next one is chosen first, too
    });
  }

  private show(state: InstructorState): void {
    this.state = state;
    this.map.update(state);
    const { clock, aircraft } = state;
    say("clock", `${clock.sim_time.toFixed(1)} s, ${clock.running ? "runs" : "frozen"}${
      clock.rate === 1 ? "" : `, rate ${clock.rate}`}`);
    say("run", clock.running ? "Freeze" : "Run");
    say("step", clock.running ? "Freeze and step" : "Step");
    const rate = element<HTMLSelectElement>("rate");
    if (document.activeElement !== rate) rate.value = String(clock.rate);
    say("flight", aircraft
      ? `${aircraft.lat.toFixed(4)}, ${aircraft.lon.toFixed(4)} · ${Math.round(aircraft.alt_ft)} ft · heading ${
        Math.round(aircraft.heading_deg) % 360} · ${Math.round(aircraft.speed_kt)} kt · ${
        groundOf(aircraft.above_ground_ft)}`
      : "no position: no flight model runs");
    if (!element("aircraft_form").contains(document.activeElement)) this.showAircraftForm();
    const errors = state.navigators;
    say("errors", errors
      ? `MN ${errors.mission.north_ft.toFixed(0)} ft north, ${errors.mission.east_ft.toFixed(0)} ft east · INS ${
        errors.ins.north_ft.toFixed(0)} ft north, ${errors.ins.east_ft.toFixed(0)} ft east`
      : "unknown");
    this.world.show(state);
    this.showPlaces();
    this.showSet(state);
    document.body.dataset.state = "shown";
  }

  // Rows stay while their values change, and so does the choice of a role to kill.
  private showRoles(roles: RoleEntry[]): void {
    fill("roles", roles.map(({ name }) => name).join(), () => roles.map(({ name }) => {
      const row = document.createElement("tr");
      for (const text of [name, "", ""]) row.insertCell().textContent = text;
      return row;
    }));
    const mortal = roles.filter(({ can_kill }) => can_kill).map(({ name }) => name);
    const chosen = element<HTMLSelectElement>("kill_role").value;
    fill("kill_role", mortal.join(), () =>
      [new Option("choose a role", ""), ...mortal.map((name) => new Option(name, name, false, name === chosen))]);
    const { rows } = element<HTMLTableSectionElement>("roles");
    roles.forEach((role, at) => {
      const core = role.pid === 0 ? "not running"
        : role.hangs ? "hangs" : role.load === null ? "-" : `${(100 * role.load).toFixed(0)} %`;
      for (const [cell, text] of [[1, core], [2, String(role.restarts)]] as const)
        if (rows[at].cells[cell].textContent !== text) rows[at].cells[cell].textContent = text;
    });
  }

  private showSet(state: InstructorState): void {
    const { status } = state;
    const { fidelity } = state;
    const configured = this.theatre?.fidelity ?? fidelity.used;
    const choices = [...new Set([configured, ...PRESETS])];
    fill("fidelity", choices.join(), () =>
      choices.map((name) => new Option(name === configured ? `${name} (configured)` : name, name)));
    const dial = element<HTMLSelectElement>("fidelity");
    if (document.activeElement !== dial) dial.value = fidelity.wanted || configured;
    say("fidelity_error", `in use: ${fidelity.used}. Error: ${wordsOfPreset(fidelity.used)}`);
    if (!status) return;
    const { reasons } = status.health;
    const [first] = (reasons[0] ?? "").split(";");
    say("health", status.health.state === "OK"
      ? "OK" : `${status.health.state}: ${first}${reasons.length > 1 ? ` (and ${reasons.length - 1} more)` : ""}`);
    element("health").title = reasons.join("\n");
    element("health").classList.toggle("bad", status.health.state !== "OK");
    this.showRoles(status.roles);
    const { recorder } = status;
    this.machine.showRecorder(recorder ? (recorder.writing ? "writes" : "paused") : "none");
    say("record", recorder ? (recorder.writing ? "Pause recording" : "Go on recording") : "Record");
    say("recorder", recorder
      ? recorder.problem ?? `${recorder.writing ? "writes" : "paused"}, ${(recorder.bytes / 1e6).toFixed(1)} MB`
      : "no recorder runs");
    const { notes } = status;
    fill("notes", JSON.stringify(notes), () => notes.map(({ sim_time, process, text }) => {
      const row = document.createElement("li");
      row.textContent = `${sim_time.toFixed(1)} s ${process}: ${text}`;
      return row;
    }));
  }
}

new InstructorPage();

// The instructor's page: map, time, aircraft, world, set, time machine.
import { Connection, sessionOfPage } from "./connection";
import { Kind, Position, TheatreMap, Thing } from "./map";
import { Answer, InstructorState, Theatre } from "./messages";
import { button, element, fill, say } from "./page";
import { Picture } from "./picture";
import { PRESETS } from "./presets";
import { TimeMachine } from "./time_machine";

const DIGITS = 5; // of positions in degrees: 1 m
const KINDS: Record<string, string> = { rain: "rain", jammers: "jammer", movers: "mover" };

// Fields of a thing that the page edits: [name in the state and in commands, label, minimum, maximum].
const FIELDS: Record<string, [string, string, number, number][]> = {
  rain: [["radius_nm", "Radius [NM]", 0.1, 100], ["rate_mmh", "Rain [mm/h]", 0.1, 200], ["top_ft", "Top [ft]", 100, 60000]],
  jammers: [["power_w", "Power [W]", 0.001, 1e6]],
  movers: [["speed_kt", "Speed [kt]", 0, 1000], ["heading_deg", "Heading [deg true]", 0, 360]],
};

const input = (id: string): HTMLInputElement => element<HTMLInputElement>(id);
const number = (id: string): number => input(id).valueAsNumber;

class InstructorPage {
  private readonly connection: Connection;
  private readonly map: TheatreMap;
  private readonly picture = new Picture(element<HTMLCanvasElement>("picture"));
  private readonly machine: TimeMachine;
  private state: InstructorState | undefined;
  private theatre: Theatre | undefined;
  private adding: Kind | undefined;
  private chosen: Thing | undefined;
  private typed = false; // values of the aircraft that are not sent yet

  constructor() {
    this.map = new TheatreMap(element<HTMLCanvasElement>("map"), {
      moved: (thing, to) => this.move(thing, to),
      chosen: (thing) => this.choose(thing),
      placed: (at) => this.add(at),
    });
    this.connection = new Connection({
      instructor: (state) => this.show(state),
      sets: (sets) => this.machine.showSets(sets),
      frame: (frame) => this.picture.show(frame),
      connected: (open) => {
        document.body.dataset.connection = open ? "open" : "lost";
        if (!open) say("health", "");
        say("status", open ? "connected" : "no connection: the station does not answer; trying again");
      },
    }, "instructor", sessionOfPage());
    this.machine = new TimeMachine(this.connection, (answer) => this.tell(answer));
    this.listenToMap();
    this.listenToTime();
    this.listenToAircraft();
    this.listenToWorld();
    this.listenToSet();
    if (sessionOfPage()) {
      element<HTMLAnchorElement>("display_link").href = `display.html?session=${sessionOfPage()}`;
      document.title = `Radar instructor: ${sessionOfPage()}`;
      say("title", `Instructor of ${sessionOfPage()}`);
    }
    void this.readTheatre();
  }

  private async readTheatre(): Promise<void> {
    this.theatre = await (await fetch("/theatre.json")).json() as Theatre;
    this.map.show(this.theatre);
    const places = element<HTMLSelectElement>("places");
    const named = [...this.theatre.scenes, ...this.theatre.points.map((point) => ({ ...point, name: `sequence point ${point.name}` })),
      ...this.theatre.beacons.map((beacon) => ({ ...beacon, name: `beacon ${beacon.name || beacon.code}` }))];
    named.forEach((place, at) => places.append(new Option(place.name, String(at))));
    places.addEventListener("change", () => {
      const place = named[Number(places.value)];
      if (places.value !== "" && place) this.map.goTo(place);
      this.showFollow();
      places.value = "";
    });
    for (const point of this.theatre.points) element("points").append(new Option(point.name, point.name));
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

  private onSubmit(id: string, act: () => void): void {
    element<HTMLFormElement>(id).addEventListener("submit", (event) => {
      event.preventDefault();
      act();
    });
  }
  private onClick(id: string, act: () => void): void {
    element(id).addEventListener("click", act);
  }

  private listenToMap(): void {
    this.onClick("zoom_in", () => this.map.zoom(1.6));
    this.onClick("zoom_out", () => this.map.zoom(1 / 1.6));
    this.onClick("follow", () => {
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
    this.onClick("run", () => void this.order(this.state?.clock.running ? "freeze" : "run"));
    element("rate").addEventListener("change", () => void this.order("rate", { rate: Number(element<HTMLSelectElement>("rate").value) }));
    this.onSubmit("step_form", () => void this.order("step", { ticks: number("ticks") }));
    this.onSubmit("reset_form", () => void this.order("reset", { time: number("time") }));
  }

  private listenToAircraft(): void {
    element("aircraft_form").addEventListener("input", () => { this.typed = true; });
    this.onClick("copy", () => {
      this.typed = false;
      this.showAircraftForm();
    });
    this.onSubmit("aircraft_form", () => void this.reposition({ lat: number("lat"), lon: number("lon") }, number("alt"), number("heading"))
      .then(({ problem }) => { if (problem === null) this.typed = false; }));
    this.onSubmit("steer_form", () => this.connection.event(`sp ${element<HTMLSelectElement>("points").value}`));
    this.onSubmit("nav_form", () => this.connection.event(`nav error ${element<HTMLSelectElement>("navigator").value} ${number("north")} ${number("east")}`));
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
    return this.order("reposition", { lat: to.lat, lon: to.lon, alt_ft, heading, speed_kt: Number.isNaN(speed) ? null : speed });
  }

  private move(thing: Thing, to: Position): void {
    const aircraft = this.state?.aircraft;
    if (thing.kind !== "aircraft") void this.order("move", { list: thing.kind, item: thing.id, ...to });
    else if (aircraft) void this.reposition(to, aircraft.alt_ft, aircraft.heading_deg % 360);
  }

  private listenToWorld(): void {
    for (const kind of ["rain", "jammers", "movers"] as const)
      this.onClick(`add_${kind}`, () => {
        if (this.adding === kind) return this.add(this.map.middle()); // a second press: where the map's middle is
        this.adding = kind;
        this.map.placing = true;
        say("adding", `Click on the map where the ${KINDS[kind]} is to be, or press again for the middle of the map. Escape ends.`);
      });
    window.addEventListener("keydown", (event) => {
      if (event.key === "Escape") this.stopAdding();
    });
    this.onClick("reset_world", () => void this.order("reset world"));
    element("sea").addEventListener("change", () => {
      const state = element<HTMLSelectElement>("sea").value;
      void this.order("sea", { state: state === "" ? null : Number(state) });
    });
    this.onSubmit("wind_form", () => void this.order("wind", { speed_kt: number("wind"), from: number("wind_from") }));
    this.onSubmit("thing_form", () => {
      if (!this.chosen) return;
      const values = Object.fromEntries(FIELDS[this.chosen.kind].map(([name]) => [name, number(`thing_${name}`)]));
      void this.order("change", { list: this.chosen.kind, item: this.chosen.id, ...values });
    });
  }
  private stopAdding(): void {
    this.adding = undefined;
    this.map.placing = false;
    say("adding", "");
  }
  private add(at: Position): void {
    if (this.adding) void this.order("add", { list: this.adding, ...at });
    this.stopAdding();
  }

  private choose(thing: Thing | undefined): void {
    this.chosen = thing;
    this.map.chosen = thing;
    const form = element<HTMLFormElement>("thing_form");
    form.hidden = thing === undefined || !(thing.kind in FIELDS);
    if (form.hidden || !thing || thing.kind === "aircraft") return;
    const entry = this.state?.world?.[thing.kind].find(({ id }) => id === thing.id) as unknown as Record<string, number> | undefined;
    const rows = FIELDS[thing.kind].map(([name, text, min, max]) => {
      const label = document.createElement("label");
      const field = document.createElement("input");
      Object.assign(field, { id: `thing_${name}`, type: "number", step: "any", min: String(min), max: String(max), required: true });
      field.value = String(Math.round((entry?.[name] ?? 0) * 100) / 100);
      label.append(`${text} `, field);
      return label;
    });
    const submit = document.createElement("button");
    submit.textContent = `Change ${thing.name}`;
    form.replaceChildren(...rows, submit);
    form.scrollIntoView({ block: "nearest" });
  }

  private listenToSet(): void {
    const fidelity = element<HTMLSelectElement>("fidelity");
    fidelity.addEventListener("change", () => void this.order("fidelity", { preset: fidelity.value === this.theatre?.fidelity ? "" : fidelity.value }));
    this.onClick("record", () => {
      if (this.state?.status?.recorder) this.connection.event("pb 12");
      else void this.order("record");
    });
    this.onSubmit("note_form", () => {
      void this.order("note", { text: input("note").value });
      input("note").value = "";
    });
  }

  private show(state: InstructorState): void {
    this.state = state;
    this.map.update(state);
    const { clock, aircraft } = state;
    say("clock", `${clock.sim_time.toFixed(1)} s, ${clock.running ? "runs" : "frozen"}${clock.rate === 1 ? "" : `, rate ${clock.rate}`}`);
    say("run", clock.running ? "Freeze" : "Run");
    say("step", clock.running ? "Freeze and step" : "Step");
    const rate = element<HTMLSelectElement>("rate");
    if (document.activeElement !== rate) rate.value = String(clock.rate);
    say("flight", aircraft
      ? `${aircraft.lat.toFixed(4)}, ${aircraft.lon.toFixed(4)} · ${Math.round(aircraft.alt_ft)} ft · heading ${Math.round(aircraft.heading_deg) % 360} · ${Math.round(aircraft.speed_kt)} kt`
      : "no position: no flight model runs");
    if (!element("aircraft_form").contains(document.activeElement)) this.showAircraftForm();
    const errors = state.navigators;
    say("errors", errors ? `MN ${errors.mission.north_ft.toFixed(0)} ft north, ${errors.mission.east_ft.toFixed(0)} ft east · INS ${errors.ins.north_ft.toFixed(0)} ft north, ${errors.ins.east_ft.toFixed(0)} ft east` : "unknown");
    this.showWorld(state);
    this.showSet(state);
    document.body.dataset.state = "shown";
  }

  private showWorld(state: InstructorState): void {
    const { world } = state;
    if (!world) return;
    const sea = element<HTMLSelectElement>("sea");
    if (document.activeElement !== sea) sea.value = world.sea_state === null ? "" : String(Math.round(world.sea_state));
    for (const [id, value] of [["wind", world.wind_kt], ["wind_from", world.wind_from_deg]] as const)
      if (!element("wind_form").contains(document.activeElement)) input(id).value = String(Math.round(value * 10) / 10);
    const things = this.map.things();
    if (this.chosen && !things.some(({ kind, id }) => kind === this.chosen?.kind && id === this.chosen.id)) this.choose(undefined);
    fill("things", things.map(({ kind, id, name }) => `${kind} ${id} ${name}`).join(), () => things.map((thing) => {
      const row = document.createElement("li");
      row.append(button(thing.name, () => {
        this.choose(thing);
        this.map.goTo(thing);
        this.showFollow();
      }));
      if (thing.kind !== "aircraft") {
        const remove = button("Remove", () => void this.order("remove", { list: thing.kind, item: thing.id }));
        remove.setAttribute("aria-label", `Remove ${thing.name}`);
        row.append(remove);
      }
      return row;
    }));
  }

  private showSet(state: InstructorState): void {
    const { status } = state;
    const { fidelity } = state;
    const configured = this.theatre?.fidelity ?? fidelity.used;
    const choices = [...new Set([configured, ...Object.keys(PRESETS)])];
    fill("fidelity", choices.join(), () => choices.map((name) => new Option(name === configured ? `${name} (configured)` : name, name)));
    const dial = element<HTMLSelectElement>("fidelity");
    if (document.activeElement !== dial) dial.value = fidelity.wanted || configured;
    say("fidelity_error", `in use: ${fidelity.used}. Error: ${PRESETS[fidelity.used] ?? "not measured"}`);
    if (!status) return;
    const { reasons } = status.health;
    const [first] = (reasons[0] ?? "").split(";");
    say("health", status.health.state === "OK" ? "OK" : `${status.health.state}: ${first}${reasons.length > 1 ? ` (and ${reasons.length - 1} more)` : ""}`);
    element("health").title = reasons.join("\n");
    element("health").classList.toggle("bad", status.health.state !== "OK");
    fill("roles", JSON.stringify(status.roles.map(({ name, pid, load, restarts, hangs, can_kill }) => [name, pid, load?.toFixed(2), restarts, hangs, can_kill])), () => status.roles.map((role) => {
      const row = document.createElement("tr");
      const cells = [role.name, role.pid === 0 ? "not running" : role.hangs ? "hangs" : role.load === null ? "-" : `${(100 * role.load).toFixed(0)} %`, String(role.restarts)];
      for (const text of cells) row.insertCell().textContent = text;
      const last = row.insertCell();
      if (role.can_kill) {
        const kill = button("Kill", () => void this.order("kill", { role: role.name }));
        kill.setAttribute("aria-label", `Kill ${role.name}`);
        kill.title = "The supervisor of the set starts it again";
        last.append(kill);
      }
      return row;
    }));
    const { recorder } = status;
    say("record", recorder ? (recorder.writing ? "Stop recording" : "Go on recording") : "Record");
    say("recorder", recorder ? recorder.problem ?? `${recorder.writing ? "writes" : "stands"}, ${(recorder.bytes / 1e6).toFixed(1)} MB` : "no recorder runs");
    const { notes } = status;
    fill("notes", JSON.stringify(notes), () => notes.map(({ sim_time, process, text }) => {
      const row = document.createElement("li");
      row.textContent = `${sim_time.toFixed(1)} s ${process}: ${text}`;
      return row;
    }));
  }
}

new InstructorPage();

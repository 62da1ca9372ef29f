// The world on the instructor's page: sea, wind, and the things on the map, which are added, changed, removed and
// brought back.
import { Kind, LISTS, Position, TheatreMap, Thing, WORDS } from "./map";
import { Answer, InstructorState } from "./messages";
import { button, element, fill, onClick, onSubmit, say } from "./page";
import { UndoLine } from "./undo";

const KINDS: Record<string, string> = { rain: "rain", jammers: "jammer", movers: "mover", points: "sequence point" };

// A value of a thing that the page edits. `name`: in the state and in commands.
interface Field { name: string; label: string; min?: number; max?: number; pattern?: string; hint?: string; optional?: boolean }
const FIELDS: Record<string, Field[]> = {
  rain: [{ name: "radius_nm", label: "Radius [NM]", min: 0.1, max: 100 }, { name: "rate_mmh", label: "Rain [mm/h]", min: 0.1, max: 300 },
    { name: "top_ft", label: "Top [ft]", min: 500, max: 60000 }],
  jammers: [{ name: "power_w", label: "Power [W]", min: 0, max: 1e9 }],
  movers: [{ name: "speed_kt", label: "Speed [kt]", min: 0, max: 1000 }, { name: "heading_deg", label: "Heading [deg true]", min: 0, max: 360 }],
  points: [{ name: "name", label: "Name", pattern: "[1-9][0-9]{0,2}([.][0-9]{0,2})?", hint: "7 is a steer point, 7. a target, 7.1 an offset, 7.01 an offset of a target. The radar draws the five nearest and the selected one" },
    { name: "elevation_ft", label: "Elevation [ft]", min: -1500, max: 30000, optional: true, hint: "above mean sea level; empty: unknown" }],
};

// Input of a field, with the value that the thing has.
function inputOf(field: Field, value: unknown): HTMLInputElement {
  const made = document.createElement("input");
  const isText = field.pattern !== undefined;
  Object.assign(made, { id: `thing_${field.name}`, type: isText ? "text" : "number", required: !field.optional, title: field.hint ?? "" });
  if (isText) Object.assign(made, { pattern: field.pattern, size: 6 });
  else Object.assign(made, { step: "any", min: String(field.min), max: String(field.max) });
  if (isText) made.value = String(value ?? "");
  else if (typeof value === "number") made.value = String(Math.round(value * 100) / 100);
  return made;
}
// What the user has put in: a text, a number, or null for an empty field of numbers.
function valueOf(field: Field): string | number | null {
  const shown = input(`thing_${field.name}`);
  if (field.pattern !== undefined) return shown.value;
  return shown.value === "" ? null : shown.valueAsNumber;
}

const input = (id: string): HTMLInputElement => element<HTMLInputElement>(id);
const number = (id: string): number => input(id).valueAsNumber;

export class WorldPanel {
  private readonly undo = new UndoLine();
  private state: InstructorState | undefined;
  private adding: Kind | undefined;
  private chosen: Thing | undefined;

  // `order` sends a command; `moved`: the map shows another place.
  constructor(private readonly map: TheatreMap, private readonly order: (name: string, values?: object) => Promise<Answer>,
    private readonly moved: () => void) {
    for (const kind of LISTS) onClick(`add_${kind}`, () => this.beginAdding(kind));
    onClick("add_middle", () => this.add(this.map.middle()));
    onClick("add_cancel", () => this.stopAdding());
    window.addEventListener("keydown", (event) => {
      if (event.key === "Escape") this.stopAdding();
    });
    onClick("reset_world", () => void this.reset());
    element("sea").addEventListener("change", () => {
      const state = element<HTMLSelectElement>("sea").value;
      void this.order("sea", { state: state === "" ? null : Number(state) });
    });
    onSubmit("wind_form", () => void this.order("wind", { speed_kt: number("wind"), from: number("wind_from") }));
    onSubmit("thing_form", () => {
      if (!this.chosen) return;
      const values = Object.fromEntries(FIELDS[this.chosen.kind].map((field) => [field.name, valueOf(field)]));
      void this.order("change", { list: this.chosen.kind, item: this.chosen.id, ...values });
    });
  }

  // A second press adds where the middle of the map is.
  private beginAdding(kind: Kind): void {
    if (this.adding === kind) return this.add(this.map.middle());
    this.adding = kind;
    this.map.placing = true;
    say("adding", `Press on the map where the ${KINDS[kind]} is to be.`);
    this.showAdding();
    element("theatre").scrollIntoView({ block: "nearest" });
  }
  // The hint and its buttons lie on the map, where the next press is to be.
  private showAdding(): void {
    const adding = this.adding !== undefined;
    for (const id of ["add_middle", "add_cancel"]) element(id).hidden = !adding;
    element("adding_line").classList.toggle("shown", adding);
    for (const kind of LISTS) element(`add_${kind}`).setAttribute("aria-pressed", String(this.adding === kind));
  }
  private stopAdding(): void {
    this.adding = undefined;
    this.map.placing = false;
    say("adding", "");
    this.showAdding();
  }
  add(at: Position): void {
    if (this.adding) void this.order("add", { list: this.adding, ...at });
    this.stopAdding();
  }

  private async remove(thing: Thing): Promise<void> {
    const item = { list: thing.kind, item: thing.id };
    const { problem } = await this.order("remove", item);
    if (problem === null) this.undo.offer({ text: `Removed ${thing.name}`, restored: `${thing.name} is back`, undo: () => this.order("restore", item) });
  }
  private async reset(): Promise<void> {
    const { problem } = await this.order("reset world");
    if (problem === null) this.undo.offer({ text: "Reset the world", restored: "The changed world is back", undo: () => this.order("undo reset") });
  }

  // What was offered belongs to a station that may be gone.
  forgetRemovals(): void { this.undo.forget(); }

  // What was chosen on the map or in the list. Its form is shown where the panel scrolls by itself; below a map it waits.
  choose(thing: Thing | undefined): void {
    this.chosen = thing;
    this.map.chosen = thing;
    const form = element<HTMLFormElement>("thing_form");
    form.hidden = thing === undefined || !(thing.kind in FIELDS);
    if (form.hidden || !thing || thing.kind === "aircraft") return;
    const entries: readonly { id: number }[] = this.state?.world?.[thing.kind] ?? [];
    const entry = entries.find(({ id }) => id === thing.id) as Record<string, unknown> | undefined;
    const rows = FIELDS[thing.kind].map((field) => {
      const label = document.createElement("label");
      label.append(`${field.label} `, inputOf(field, entry?.[field.name]));
      return label;
    });
    const hints = FIELDS[thing.kind].filter(({ hint }) => hint !== undefined).map(({ label, hint }) => {
      const note = document.createElement("p");
      note.className = "note";
      note.textContent = `${label}: ${hint}`;
      return note;
    });
    const submit = document.createElement("button");
    submit.id = "change_thing";
    submit.textContent = `Change ${thing.name}`;
    form.replaceChildren(...rows, ...hints, submit);
    const panel = form.closest("aside");
    if (panel && panel.scrollHeight > panel.clientHeight) form.scrollIntoView({ block: "nearest" });
  }

  show(state: InstructorState): void {
    this.state = state;
    const { world } = state;
    if (!world) return;
    const sea = element<HTMLSelectElement>("sea");
    if (document.activeElement !== sea) sea.value = world.sea_state === null ? "" : String(Math.round(world.sea_state));
    for (const [id, value] of [["wind", world.wind_kt], ["wind_from", world.wind_from_deg]] as const)
      if (!element("wind_form").contains(document.activeElement)) input(id).value = String(Math.round(value * 10) / 10);
    const things = this.map.things();
    const { chosen } = this;
    const present = things.find(({ kind, id }) => kind === chosen?.kind && id === chosen.id);
    if (chosen && !present) this.choose(undefined);
    else if (chosen && present && present.name !== chosen.name) {
      this.chosen = present;
      say("change_thing", `Change ${present.name}`);
    }
    fill("things", things.map(({ kind, id, name }) => `${kind} ${id} ${name}`).join(), () => things.map((thing) => this.row(thing)));
  }

  private row(thing: Thing): HTMLLIElement {
    const row = document.createElement("li");
    const choice = button(thing.name, () => {
      this.choose(thing);
      element("thing_form").scrollIntoView({ block: "nearest" });
      this.map.goTo(thing);
      this.moved();
    });
    const word = WORDS[thing.kind];
    if (!thing.name.startsWith(word)) { // "ferry" needs its kind, "rain 2" does not
      const kind = document.createElement("span");
      kind.className = "kind";
      kind.textContent = word;
      choice.append(kind);
    }
    row.append(choice);
    if (thing.kind === "aircraft") return row;
    const remove = button("Remove", () => void this.remove(thing));
    remove.setAttribute("aria-label", `Remove ${thing.name}`);
    row.append(remove);
    return row;
  }
}

// The world on the instructor's page: sea, wind, and the things on the map, which are added, changed, removed and
// brought back.
import { Kind, Position, TheatreMap, Thing, wordOf } from "./map";
import { Answer, InstructorState } from "./messages";
import { button, element, fill, limit, onClick, onSubmit, say } from "./page";
import { UndoLine } from "./undo";
import { Field, FIELDS, Lists, LISTS } from "./values";

// Values of a thing that the page edits: all but its position, and the names of sequence points.
const edited = (values: Record<string, Field>): Field[] =>
  Object.values(values).filter(({ name }) => !name.endsWith("itude_deg"));
const NAME_PATTERN = "[1-9][0-9]{0,2}([.][0-9]{0,2})?"; // of a sequence point
const NAME_HINT = "Name: 7 is a steer point, 7. a target, 7.1 an offset, 7.01 an offset of a target. " +
  "The radar draws the five nearest and the selected one";

// Input of a value, with what the thing has.
function inputOf(field: Field, value: unknown): HTMLInputElement {
  const made = document.createElement("input");
  Object.assign(made, { id: `thing_${field.name}`, required: field.otherwise === "" });
  limit(made, field);
  if (typeof value === "number") made.defaultValue = String(Math.round(value * 100) / 100);
  return made;
}
function nameInput(value: unknown): HTMLInputElement {
  return Object.assign(document.createElement("input"),
    { id: "thing_name", required: true, pattern: NAME_PATTERN, size: 6, defaultValue: String(value ?? "") });
}
function labelled(text: string, made: HTMLInputElement): HTMLLabelElement {
  const label = document.createElement("label");
  label.append(`${text} `, made);
  return label;
}
function noteOf(text: string): HTMLParagraphElement {
  return Object.assign(document.createElement("p"), { className: "note", textContent: text });
}

const input = (id: string): HTMLInputElement => element<HTMLInputElement>(id);
const number = (id: string): number => input(id).valueAsNumber;

export class WorldPanel {
  private readonly undo = new UndoLine();
  private state: InstructorState | undefined;
  private adding: Kind | undefined;
  private chosen: Thing | undefined;

  // `order` sends a command; `moved`: the map shows another place.
  constructor(
    private readonly map: TheatreMap, private readonly order: (name: string, values?: object) => Promise<Answer>,
    private readonly moved: () => void) {
    element("add_buttons").append(...LISTS.map(({ name, entry }) =>
      Object.assign(button(`Add ${entry}`, () => this.beginAdding(name)), { id: `add_${name}` })));
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
    onSubmit("thing_form", () => void this.change());
    limit(input("wind"), FIELDS.WorldState.wind_speed);
    limit(input("wind_from"), FIELDS.WorldState.wind_from);
    for (let state = FIELDS.WorldState.sea_state.min; state <= FIELDS.WorldState.sea_state.max; ++state)
      element<HTMLSelectElement>("sea").add(new Option(String(state)));
  }

  // Sends what the user has changed of the chosen thing: a text, a number, or null for an empty field of numbers.
  private async change(): Promise<void> {
    if (!this.chosen) return;
    const changed = [...element("thing_form").querySelectorAll("input")]
      .filter((field) => field.value !== field.defaultValue);
    const valueOf = ({ type, value, valueAsNumber }: HTMLInputElement): string | number | null =>
      type !== "number" ? value : value === "" ? null : valueAsNumber;
    const values = Object.fromEntries(changed.map((field) => [field.id.replace("thing_", ""), valueOf(field)]));
    const { problem } = await this.order("change", { list: this.chosen.kind, item: this.chosen.id, ...values });
    if (problem === null) for (const field of changed) field.defaultValue = field.value;
  }

  // A second press adds where the middle of the map is.
  private beginAdding(kind: keyof Lists): void {
    if (this.adding === kind) return this.add(this.map.middle());
    this.adding = kind;
    this.map.placing = true;
    say("adding", `Press on the map where the ${wordOf(kind)} is to be.`);
    this.showAdding();
    element("theatre").scrollIntoView({ block: "nearest" });
  }
  // The hint and its buttons lie on the map, where the next press is to be.
  private showAdding(): void {
    const adding = this.adding !== undefined;
    for (const id of ["add_middle", "add_cancel"]) element(id).hidden = !adding;
    element("adding_line").classList.toggle("shown", adding);
    for (const { name } of LISTS) element(`add_${name}`).setAttribute("aria-pressed", String(this.adding === name));
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
    if (problem === null) this.undo.offer(
      { text: `Removed ${thing.name}`, restored: `${thing.name} is back`, undo: () => this.order("restore", item) });
  }
  private async reset(): Promise<void> {
    const { problem } = await this.order("reset world");
    if (problem === null) this.undo.offer(
      { text: "Reset the world", restored: "The changed world is back", undo: () => this.order("undo reset") });
  }

  // What was offered belongs to a station that may be gone.
  forgetRemovals(): void { this.undo.forget(); }

  // What was chosen on the map or in the list. Its form is shown where the panel scrolls by itself; below a map it
  // waits.
  choose(thing: Thing | undefined): void {
    this.chosen = thing;
    this.map.chosen = thing;
    const form = element<HTMLFormElement>("thing_form");
    form.hidden = thing === undefined || thing.kind === "aircraft";
    if (!thing || thing.kind === "aircraft") return;
    const entries: readonly { id: number }[] = this.state?.world?.[thing.kind] ?? [];
    const entry = entries.find(({ id }) => id === thing.id) as Record<string, unknown> | undefined;
    const fields = edited(FIELDS[thing.kind]), isPoint = thing.kind === "points";
    const rows = fields.map((field) =>
      labelled(`${field.label} [${field.unit.replace("m2", "m²")}]`, inputOf(field, entry?.[field.name])));
    if (isPoint) rows.unshift(labelled("Name", nameInput(entry?.name)));
    const hints = fields.filter(({ otherwise }) => otherwise !== "")
      .map(({ label, purpose, otherwise }) => noteOf(`${label}: ${purpose}; empty: ${otherwise}`));
    if (isPoint) hints.unshift(noteOf(NAME_HINT));
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
    fill("things", things.map(({ kind, id, name }) => `${kind} ${id} ${name}`).join(),
      () => things.map((thing) => this.row(thing)));
  }

  private row(thing: Thing): HTMLLIElement {
    const row = document.createElement("li");
    const choice = button(thing.name, () => {
      this.choose(thing);
      element("thing_form").scrollIntoView({ block: "nearest" });
      this.map.goTo(thing);
      this.moved();
    });
    const word = wordOf(thing.kind);
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

// The time machine of the instructor's page: recordings, played from any moment; flights that go on from a moment; sets
// that run beside this one. One slider has the moment: where to begin, and while a recording plays, where it is.
import { Connection } from "./connection";
import { Answer, Recording, SetEntry } from "./messages";
import { button, element, fill, onClick, say } from "./page";
import { Picture } from "./picture";

const END_S = 0.3; // the replay is held so long before the end of its recording, because it ends there
const LIST_EVERY_MS = 5000; // while a recording grows
const HOLD_MS = 700; // the slider stays where it was put, until the replay is there

const fileName = (path: string): string => path.slice(path.lastIndexOf("/") + 1);
const minutes = (time_s: number): string =>
  `${Math.floor(time_s / 60)}:${String(Math.floor(time_s % 60)).padStart(2, "0")}`;

export class TimeMachine {
  private recordings: Recording[] = [];
  private chosen: Recording | undefined;
  private playing: { session: string; connection: Connection } | undefined;
  private running: boolean | undefined; // undefined: the replay has not said yet
  private held_until_ms = 0;
  private recorder = ""; // what it did last
  private readonly at = element<HTMLInputElement>("at");
  private readonly picture = new Picture(element<HTMLCanvasElement>("replay_picture"));

  constructor(private readonly connection: Connection, private readonly tell: (answer: Answer) => void) {
    onClick("list", () => void this.list());
    element("machine").addEventListener("toggle", () => { if (this.isOpen()) void this.list(); });
    setInterval(() => {
      if (this.isOpen() && this.recordings.some(({ writing }) => writing)) void this.list();
    }, LIST_EVERY_MS);
    this.at.addEventListener("input", () => {
      this.hold();
      this.showMoment();
    });
    this.at.addEventListener("change", () => this.goTo(this.at.valueAsNumber));
    for (const step of document.querySelectorAll<HTMLButtonElement>("button[data-step]"))
      step.addEventListener("click", () => this.goTo(this.at.valueAsNumber + Number(step.dataset.step)));
    onClick("play", () => void (this.playing ? this.toggle() : this.play()));
    onClick("stop", () => this.stop());
    onClick("fly_out", () => void this.flyOut());
  }

  private isOpen(): boolean { return element<HTMLDetailsElement>("machine").open; }

  private async list(): Promise<void> {
    const answer = await this.connection.command("recordings");
    if (answer.problem !== null) return this.tell(answer);
    this.recordings = answer.recordings ?? [];
    const known = this.recordings.find(({ file }) => file === this.chosen?.file);
    if (known) this.use(known);
    const focused = document.activeElement instanceof HTMLElement ? document.activeElement.dataset.file : undefined;
    const older = answer.left_out ?? 0;
    fill("recordings", JSON.stringify([this.recordings, older]), () => this.recordings.length === 0
      ? [document.createTextNode("No recordings yet: press Record in Set.")]
      : [...this.recordings.map((recording) => this.rowOfRecording(recording)),
        ...(older > 0 ? [document.createTextNode(`and ${older} older`)] : [])]);
    this.markChosen();
    if (focused !== undefined)
      this.choices().find(({ dataset }) => dataset.file === focused)?.focus({ preventScroll: true });
  }

  private rowOfRecording(recording: Recording): HTMLLIElement {
    const row = document.createElement("li");
    const length = recording.begin_s === null || recording.end_s === null
      ? "no ticks" : `${minutes(recording.end_s - recording.begin_s)} min`;
    const choice = button(`${fileName(recording.file)}, ${length}`, () => this.choose(recording));
    choice.dataset.file = recording.file;
    row.append(choice);
    if (recording.writing) row.append(" being written");
    else if (recording.cut_short) row.append(" cut short: its recorder was killed; it plays to where it broke off");
    return row;
  }
  private choices(): HTMLButtonElement[] {
    return [...document.querySelectorAll<HTMLButtonElement>("#recordings button")];
  }
  private markChosen(): void {
    for (const choice of this.choices())
      choice.setAttribute("aria-pressed", String(choice.dataset.file === this.chosen?.file));
  }

  private choose(recording: Recording): void {
    if (recording.file !== this.chosen?.file) this.stop();
    this.use(recording);
    element("recording_panel").hidden = false;
    say("recording", fileName(recording.file));
    if (!this.playing) this.at.value = this.at.min;
    this.showMoment();
    this.markChosen();
  }
  // Takes what is known of the chosen recording: one that is being written grows.
  private use(recording: Recording): void {
    this.chosen = recording;
    this.at.min = String(recording.begin_s ?? 0);
    this.at.max = String(Math.max(recording.begin_s ?? 0, (recording.end_s ?? 0) - END_S));
    element<HTMLButtonElement>("fly_out").disabled = !recording.can_fly_out;
    this.showMoment();
  }

  private hold(): void { this.held_until_ms = performance.now() + HOLD_MS; }

  // Puts the slider to a moment, and a replay with it.
  private goTo(time_s: number): void {
    this.at.value = String(Math.min(Number(this.at.max), Math.max(Number(this.at.min), time_s)));
    this.hold();
    this.showMoment();
    void this.playing?.connection.command("reset", { time: this.at.valueAsNumber }).then(this.tell);
  }

  private showMoment(): void {
    const begin_s = Number(this.at.min), now_s = this.at.valueAsNumber;
    const text =
      `${minutes(now_s - begin_s)} of ${minutes(Number(this.at.max) - begin_s)} min, sim time ${now_s.toFixed(1)} s`;
    say("at_text", text);
    this.at.setAttribute("aria-valuetext", text);
  }
  private showPlaying(): void {
    const waits = this.playing !== undefined && this.running === undefined;
    say("play", waits ? "Starts" : !this.playing ? "Play from here" : this.running ? "Pause" : "Go on");
    element<HTMLButtonElement>("play").disabled = waits;
    element("stop").hidden = this.playing === undefined;
    element("replay_picture").hidden = this.playing === undefined;
  }

  private async play(): Promise<void> {
    const recording = this.chosen;
    if (!recording) return;
    const answer = await this.connection.command("play", { file: recording.file, at: this.at.valueAsNumber });
    this.tell(answer);
    if (!answer.session) return;
    this.stop();
    const { session } = answer;
    this.hold();
    const connection = new Connection({
      frame: (frame) => this.picture.show(frame),
      instructor: ({ clock }) => this.follow(clock.running, clock.sim_time),
      connected: () => undefined,
    }, "instructor", session);
    this.playing = { session, connection };
    this.showPlaying();
  }
  // The replay says where it is.
  private follow(running: boolean, time_s: number): void {
    this.running = running;
    this.showPlaying();
    if (performance.now() < this.held_until_ms) return;
    if (running && time_s > Number(this.at.max)) void this.playing?.connection.command("freeze");
    this.at.value = String(time_s);
    this.showMoment();
  }
  private async toggle(): Promise<void> {
    if (this.playing) this.tell(await this.playing.connection.command(this.running ? "freeze" : "run"));
  }

  private stop(): void {
    if (this.playing) {
      this.playing.connection.close();
      void this.connection.command("end", { session: this.playing.session });
    }
    this.playing = undefined;
    this.running = undefined;
    this.showPlaying();
  }

  private async flyOut(): Promise<void> {
    if (this.chosen)
      this.tell(await this.connection.command("fly out", { file: this.chosen.file, at: this.at.valueAsNumber }));
  }

  // The list is read again when the recorder of the set begins, stops or ends, however it ended.
  showRecorder(recorder: string): void {
    if (this.recorder !== recorder && this.isOpen()) void this.list();
    this.recorder = recorder;
  }

  showSets(sets: SetEntry[]): void {
    fill("sets", JSON.stringify(sets), () => sets.map((set) => this.rowOfSet(set, sets)));
    if (this.playing && !sets.some(({ session, ended }) => session === this.playing?.session && !ended)) this.stop();
  }

  private rowOfSet(set: SetEntry, sets: SetEntry[]): HTMLLIElement {
    const row = document.createElement("li");
    const from = set.kind === "recorder" ? "" : ` from ${set.at.toFixed(1)} s`;
    row.append(`${set.kind === "recorder" ? "recorder" : set.session}: ${fileName(set.file)}${from}${
      set.ended ? `: ${set.ended}` : ""} `);
    const link = (text: string, address: string) => {
      const anchor = document.createElement("a");
      anchor.href = address;
      anchor.target = "_blank";
      anchor.textContent = text;
      row.append(anchor, " ");
    };
    if (!set.ended && set.kind !== "recorder") {
      link("display", `display.html?session=${set.session}`);
      if (set.kind === "branch") link("instructor", `instructor.html?session=${set.session}`);
      link("beside this set", `beside.html?right=${set.session}`);
      for (const other of sets)
        if (other.kind === "branch" && set.kind === "branch" && !other.ended && other.session > set.session)
          link(`beside ${other.session}`, `beside.html?left=${set.session}&right=${other.session}`);
    }
    const end = button("End", () => void this.connection.command("end", { session: set.session }).then(this.tell));
    end.setAttribute("aria-label", set.kind === "recorder" ? "End the recorder" : `End ${set.session}`);
    row.append(end);
    return row;
  }
}

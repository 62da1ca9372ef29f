// The time machine of the instructor's page: recordings, played and scrubbed; flights that go on from a recorded second;
// sets that run beside this one.
import { Connection } from "./connection";
import { Answer, Recording, SetEntry } from "./messages";
import { button, element, fill, say } from "./page";
import { Picture } from "./picture";

const END_S = 0.3; // the replay is held so long before the end of its recording, because it ends there

const fileName = (path: string): string => path.slice(path.lastIndexOf("/") + 1);
const range = (id: string): HTMLInputElement => element<HTMLInputElement>(id);

export class TimeMachine {
  private recordings: Recording[] = [];
  private chosen: Recording | undefined;
  private playing: { session: string; recording: Recording; connection: Connection } | undefined;
  private running = true;
  private readonly picture = new Picture(element<HTMLCanvasElement>("replay_picture"));

  constructor(private readonly connection: Connection, private readonly tell: (answer: Answer) => void) {
    element("list").addEventListener("click", () => void this.list());
    element("machine").addEventListener("toggle", () => {
      if (element<HTMLDetailsElement>("machine").open && this.recordings.length === 0) void this.list();
    });
    range("at").addEventListener("input", () => say("at_text", `${range("at").valueAsNumber.toFixed(1)} s`));
    element("recording_form").addEventListener("submit", (event) => {
      event.preventDefault();
      void this.play();
    });
    element("fly_out").addEventListener("click", () => { if (this.chosen) void this.flyOut(this.chosen, range("at").valueAsNumber); });
    range("scrub").addEventListener("change", () => void this.playing?.connection.command("reset", { time: range("scrub").valueAsNumber }).then(this.tell));
    range("scrub").addEventListener("input", () => say("scrub_text", `${range("scrub").valueAsNumber.toFixed(1)} s`));
    element("replay_run").addEventListener("click", () => void this.playing?.connection.command(this.running ? "freeze" : "run").then(this.tell));
    element("replay_fly").addEventListener("click", () => { if (this.playing) void this.flyOut(this.playing.recording, range("scrub").valueAsNumber); });
  }

  private async list(): Promise<void> {
    const answer = await this.connection.command("recordings");
    this.tell(answer);
    this.recordings = answer.recordings ?? [];
    fill("recordings", JSON.stringify(this.recordings), () => this.recordings.length === 0 ? [document.createTextNode("No recordings yet: press Record above.")]
      : this.recordings.map((recording) => {
        const row = document.createElement("li");
        const length = recording.begin_s === null || recording.end_s === null ? "no ticks" : `${(recording.end_s - recording.begin_s).toFixed(0)} s from ${recording.begin_s.toFixed(0)} s`;
        row.append(button(`${fileName(recording.file)}, ${length}`, () => this.choose(recording)));
        if (recording.writing) row.append(" being written");
        return row;
      }));
  }

  private choose(recording: Recording): void {
    this.chosen = recording;
    element("recording_form").hidden = false;
    say("recording", fileName(recording.file));
    const at = range("at");
    at.min = String(recording.begin_s ?? 0);
    at.max = String(Math.max(recording.begin_s ?? 0, (recording.end_s ?? 0) - END_S));
    at.value = at.min;
    say("at_text", `${at.valueAsNumber.toFixed(1)} s`);
    element<HTMLButtonElement>("fly_out").disabled = !recording.can_fly_out;
  }

  private async play(): Promise<void> {
    const recording = this.chosen;
    if (!recording) return;
    const answer = await this.connection.command("play", { file: recording.file, at: range("at").valueAsNumber });
    this.tell(answer);
    if (!answer.session) return;
    this.stop();
    const { session } = answer;
    element("replay").hidden = false;
    const scrub = range("scrub");
    scrub.min = range("at").min;
    scrub.max = range("at").max;
    const connection = new Connection({
      frame: (frame) => this.picture.show(frame),
      instructor: ({ clock }) => {
        this.running = clock.running;
        say("replay_run", clock.running ? "Freeze" : "Run");
        if (clock.running && clock.sim_time > Number(scrub.max)) void connection.command("freeze");
        if (document.activeElement !== scrub || clock.running) {
          scrub.value = String(clock.sim_time);
          say("scrub_text", `${clock.sim_time.toFixed(1)} s`);
        }
      },
      connected: () => undefined,
    }, "instructor", session);
    this.playing = { session, recording, connection };
  }

  private stop(): void {
    if (!this.playing) return;
    this.playing.connection.close();
    void this.connection.command("end", { session: this.playing.session });
    this.playing = undefined;
    element("replay").hidden = true;
  }

  private async flyOut(recording: Recording, at: number): Promise<void> {
    this.tell(await this.connection.command("fly out", { file: recording.file, at }));
  }

  showSets(sets: SetEntry[]): void {
    fill("sets", JSON.stringify(sets), () => sets.map((set) => {
      const row = document.createElement("li");
      const from = set.kind === "recorder" ? "" : ` from ${set.at.toFixed(1)} s`;
      row.append(`${set.kind} ${fileName(set.file)}${from}${set.ended ? `: ${set.ended}` : ""} `);
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
          if (other.kind === "branch" && set.kind === "branch" && !other.ended && other.session > set.session) link(`beside ${other.session}`, `beside.html?left=${set.session}&right=${other.session}`);
      }
      const end = button("End", () => void this.connection.command("end", { session: set.session }).then(this.tell));
      end.setAttribute("aria-label", set.kind === "recorder" ? "End the recorder" : `End ${set.session}`);
      row.append(end);
      return row;
    }));
    if (this.playing && !sets.some(({ session, ended }) => session === this.playing?.session && !ended)) this.stop();
  }
}

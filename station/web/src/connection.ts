// The WebSocket to the server; opens it again, after growing waits, whenever it closes.
import { Answer, frameOf, FrameMessage, InstructorState, Right, SetEntry, State } from "./messages";

const FIRST_WAIT_MS = 250;
const LONGEST_WAIT_MS = 4000;
const ANSWER_WITHIN_S = 10;

export interface Receiver {
  state?(state: State): void;
  instructor?(state: InstructorState): void;
  sets?(sets: SetEntry[]): void;
  frame?(frame: FrameMessage): void;
  refused?(problem: string): void; // an event or key, of a page with the token of a viewer
  right?(right: Right): void;
  connected(open: boolean): void;
}

export class Connection {
  private socket: WebSocket | undefined;
  private wait_ms = FIRST_WAIT_MS;
  private next = 1;
  private readonly waiting = new Map<number, (answer: Answer) => void>();
  private closed = false;

  // `session`: empty for the station's own.
  constructor(private readonly receiver: Receiver, private readonly page: "display" | "instructor",
    private readonly session = "") {
    this.open();
  }

  // Sends an event in the text form of `yars inject`; false: there is no connection.
  event(text: string): boolean {
    return this.send({ event: text });
  }
  key(name: string, down: boolean): boolean {
    return this.send({ key: name, down });
  }
  releaseAll(): boolean {
    return this.send({ release: true });
  }
  // Sends a command of the instructor. The answer has a problem if it was not done.
  command(name: string, values: object = {}): Promise<Answer> {
    const id = this.next++;
    return new Promise((resolve) => {
      if (!this.send({ do: name, id, ...values })) {
        resolve({ answer: id, problem: "no connection" });
        return;
      }
      this.waiting.set(id, resolve);
      this.expect(id, name, ANSWER_WITHIN_S);
    });
  }
  close(): void {
    this.closed = true;
    this.socket?.close();
  }

  // Counts seconds in which the page runs: an answer may have come while it did not.
  private expect(id: number, name: string, seconds: number): void {
    if (!this.waiting.has(id)) return;
    if (seconds > 0) setTimeout(() => this.expect(id, name, seconds - 1), 1000);
    else this.resolve({ answer: id, problem: `no answer within ${ANSWER_WITHIN_S} s to: ${name}` });
  }
  private resolve(answer: Answer): void {
    this.waiting.get(answer.answer)?.(answer);
    this.waiting.delete(answer.answer);
  }

  private send(message: object): boolean {
    if (this.socket?.readyState !== WebSocket.OPEN) return false;
    this.socket.send(JSON.stringify(message));
    return true;
  }

  private take(text: string): void {
    const message = JSON.parse(text) as Partial<State> &
      { instructor?: InstructorState; sets?: SetEntry[]; right?: Right } & Partial<Answer>;
    if (message.watch !== undefined) this.receiver.state?.(message as State);
    else if (message.instructor !== undefined) this.receiver.instructor?.(message.instructor);
    else if (message.sets !== undefined) this.receiver.sets?.(message.sets);
    else if (message.right !== undefined) this.receiver.right?.(message.right);
    else if (message.answer === 0) this.receiver.refused?.(message.problem ?? "");
    else if (message.answer !== undefined) this.resolve(message as Answer);
  }

  private open(): void {
    const query = `page=${this.page}${this.session ? `&session=${this.session}` : ""}`;
    const socket = new WebSocket(addressOf(`socket?${query}`));
    this.socket = socket;
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      this.wait_ms = FIRST_WAIT_MS;
      this.receiver.connected(true);
    };
    socket.onmessage = ({ data }) => {
      if (typeof data === "string") this.take(data);
      else this.receiver.frame?.(frameOf(data as ArrayBuffer));
    };
    socket.onclose = () => {
      this.receiver.connected(false);
      if (this.closed) return;
      setTimeout(() => this.open(), this.wait_ms);
      this.wait_ms = Math.min(2 * this.wait_ms, LONGEST_WAIT_MS);
    };
  }
}

// Address of a WebSocket beside the page, which a proxy may have put below a path of its own.
function addressOf(name: string): string {
  const address = new URL(name, location.href);
  address.protocol = address.protocol === "https:" ? "wss:" : "ws:";
  return address.href;
}

// The session that the address of the page names; empty: the station's own.
export const sessionOfPage = (): string => new URLSearchParams(location.search).get("session") ?? "";

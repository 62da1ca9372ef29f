// The WebSocket to the server; opens it again, after growing waits, whenever it closes.
import { FrameMessage, frameOf, State } from "./messages";

const FIRST_WAIT_MS = 250;
const LONGEST_WAIT_MS = 4000;

export interface Receiver {
  state(state: State): void;
  frame(frame: FrameMessage): void;
  connected(open: boolean): void;
}

export class Connection {
  private socket: WebSocket | undefined;
  private wait_ms = FIRST_WAIT_MS;

  constructor(private readonly receiver: Receiver) {
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

  private send(message: object): boolean {
    if (this.socket?.readyState !== WebSocket.OPEN) return false;
    this.socket.send(JSON.stringify(message));
    return true;
  }

  private open(): void {
    const socket = new WebSocket(`${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/socket`);
    this.socket = socket;
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      this.wait_ms = FIRST_WAIT_MS;
      this.receiver.connected(true);
    };
    socket.onmessage = ({ data }) => {
      if (typeof data === "string") this.receiver.state(JSON.parse(data) as State);
      else this.receiver.frame(frameOf(data as ArrayBuffer));
    };
    socket.onclose = () => {
      this.receiver.connected(false);
      setTimeout(() => this.open(), this.wait_ms);
      this.wait_ms = Math.min(2 * this.wait_ms, LONGEST_WAIT_MS);
    };
  }
}

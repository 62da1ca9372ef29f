// Messages between page and server. Source: docs/station.md, "Messages".

// The part of `yars watch --json` that the page shows.
export interface Watch {
  power: string;
  mode: string;
  legends: Record<string, string>;
  boxed: number[];
  running: boolean;
  rate: number;
  sim_time: number;
  message: string;
  remedy: string;
  processes: Record<string, { pid: number; heartbeat_ms: number }>;
}

export interface State {
  watch: Watch;
  buttons: { key: string; does: string }[]; // of PB 1 to 20
}

// A change of the picture: a PNG at (x, y) of a frame.
export interface FrameMessage {
  id: bigint;
  base: bigint; // id of the frame that it changes; 0: none is needed
  width: number;
  height: number;
  x: number;
  y: number;
  simTime_s: number;
  png: Blob;
}

const HEADER_BYTES = 32;

export function frameOf(message: ArrayBuffer): FrameMessage {
  const view = new DataView(message);
  return {
    id: view.getBigUint64(0, true),
    base: view.getBigUint64(8, true),
    width: view.getUint16(16, true),
    height: view.getUint16(18, true),
    x: view.getUint16(20, true),
    y: view.getUint16(22, true),
    simTime_s: Number(view.getBigUint64(24, true)) / 1000,
    png: new Blob([new Uint8Array(message, HEADER_BYTES)], { type: "image/png" }),
  };
}

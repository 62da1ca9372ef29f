// Messages between page and server. Source: docs/station.md, "Messages".
import { Lists } from "./values";

export type Right = "viewer" | "instructor"; // what the page may do: look; look, fly and change the set

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
  recorder: boolean; // one runs
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

// What the instructor's page shows of a session.
export interface World extends Lists {
  sea_state: number | null; wind_kt: number; wind_from_deg: number; configured: boolean;
}
export interface PatchEntry {
  id: number; lat: number; lon: number; window_nm: number; up_deg: number; size: number; corners: [number, number][];
}
export interface RoleEntry {
  name: string; pid: number; load: number | null; heartbeat_ms: number | null; hangs: boolean; restarts: number;
  can_kill: boolean;
}
export interface InstructorState {
  session: string;
  clock: { sim_time: number; running: boolean; rate: number; epoch: number };
  aircraft: {
    lat: number; lon: number; alt_ft: number; above_ground_ft: number | null; heading_deg: number; track_deg: number;
    speed_kt: number;
  } | null;
  scan: {
    scanning: boolean; frozen: boolean; centre_deg: number; width_deg: number; range_nm: number;
    beam_deg: number | null;
  } | null;
  patches: PatchEntry[];
  forming: { progress: number | null; corners: [number, number][] } | null;
  world: World | null;
  fidelity: { wanted: string; used: string }; // presets; wanted empty: the configured one
  navigators: { mission: NavigatorError; ins: NavigatorError } | null;
  sequence_point: string; // that the pilot has selected; empty: none
  status: {
    roles: RoleEntry[];
    health: { state: string; reasons: string[] };
    recorder: { writing: boolean; bytes: number; problem: string | null } | null;
    notes: { sim_time: number; process: string; kind: string; text: string }[];
  } | null;
}
export interface NavigatorError { north_ft: number; east_ft: number }
export interface SetEntry {
  session: string; kind: "replay" | "branch" | "recorder"; file: string; at: number; ended: string | null;
}
export interface Recording {
  file: string; begin_s: number | null; end_s: number | null; bytes: number; sweeps: boolean; maps: boolean;
  can_fly_out: boolean;
  writing: boolean; cut_short: boolean; // cut short: nobody writes it, and no recorder closed it
}
export interface Answer {
  answer: number; problem: string | null; session?: string; recordings?: Recording[]; left_out?: number;
}
export interface Theatre {
  radar: string; fidelity: string;
  beacons: { name: string; lat: number; lon: number; code: number }[];
  scenes: { name: string; lat: number; lon: number }[];
  route: [number, number][];
  keys: { keys: string; does: string }[]; // of the window of radar-display, other than those of the push buttons
}

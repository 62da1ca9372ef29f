// Measured errors and times of the presets of fidelity against `reference`: mean over three scenes at 10, 40 and
// 160 NM. Source: docs/performance.md#speed-against-accuracy, measured by `yars trade`;
// tests/station/page_facts_test.py compares.
import type { Preset } from "./values";

interface Measured {
  gray: number | null; // RMS of the video, 255 = white; null: not comparable
  power_db: number | null;
  shadow_percent: number;
  scan_ms: number; // processor time of one thread
}

const MEASURED: Record<Preset, Measured> = {
  "1996": { gray: null, power_db: null, shadow_percent: 7.2, scan_ms: 0.71 },
  draft: { gray: 17.8, power_db: 5.7, shadow_percent: 2.3, scan_ms: 0.49 },
  standard: { gray: 8.3, power_db: 1.4, shadow_percent: 1.4, scan_ms: 1.1 },
  fine: { gray: 0.43, power_db: 0.03, shadow_percent: 0.05, scan_ms: 6.1 },
  reference: { gray: 0, power_db: 0, shadow_percent: 0, scan_ms: 763 },
};

export const PRESETS = Object.keys(MEASURED);

// The error and the time of a preset in words.
export function wordsOfPreset(name: string): string {
  if (!(name in MEASURED)) return "not measured";
  const { gray, power_db, shadow_percent, scan_ms } = MEASURED[name as Preset];
  if (gray === 0) return `none: the ruler; ${scan_ms} ms a scan, slower than the antenna`;
  const video = gray === null ? "the picture of 1996, not comparable" : `gray ${gray} of 255, power ${power_db} dB`;
  return `${video}, shadow ${shadow_percent} % wrong; ${scan_ms} ms a scan`;
}

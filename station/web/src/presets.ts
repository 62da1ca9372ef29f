// What the instructor's page says about the presets of fidelity, from the measurements against `reference`: means over
// three scenes at 10, 40 and 160 NM.
import { MEASURED } from "./values";

export const PRESETS = Object.keys(MEASURED);

// The error and the time of a preset in words.
export function wordsOfPreset(name: string): string {
  if (!(name in MEASURED)) return "not measured";
  const { gray, power_db, shadow_percent, scan_ms } = MEASURED[name as keyof typeof MEASURED];
  if (gray === 0) return `none: the ruler; ${scan_ms} ms a scan, slower than the antenna`;
  const video = gray === null ? "the picture of 1996, not comparable" : `gray ${gray} of 255, power ${power_db} dB`;
  return `${video}, shadow ${shadow_percent} % wrong; ${scan_ms} ms a scan`;
}

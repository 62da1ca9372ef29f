// Measured errors of the presets of fidelity against `reference`: mean over three scenes at 10, 40 and 160 NM.
// Source: docs/performance.md, "Speed against accuracy"; `yars trade` measures them.
export const PRESETS: Record<string, string> = {
  "1996": "the picture of 1996, not comparable; shadow 7.2 % wrong, 0.71 ms a scan",
  draft: "gray 17.8 of 255, power 5.7 dB, shadow 2.3 % wrong; 0.49 ms a scan",
  standard: "gray 8.3 of 255, power 1.4 dB, shadow 1.4 % wrong; 1.1 ms a scan",
  fine: "gray 0.43 of 255, power 0.03 dB, shadow 0.05 % wrong; 6.1 ms a scan",
  reference: "the ruler; 763 ms a scan: slower than the antenna",
};

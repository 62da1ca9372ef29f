// The course of one scan over its ticks: pure numbers, derived from the tick within the scan, so that no error adds
// up however long the radar runs. A sector scan goes from one edge to the other in `sweep_ticks` ticks (one sweep
// each), then turns round, blanked, in `turn_ticks`. A circular scan goes round clockwise and never turns.
// Source: docs/spec/pilots_interface.md#rule-2. 100 deg at 110 deg/s and a turn-around of a tenth of that make 1 s;
// others in proportion.
#pragma once

#include "lib/radar/configuration.hpp"

namespace yars::model::antenna {

struct ScanPattern {
  double width_deg = 100.0;
  double bar_spacing_deg = 2.5;  // [deg] between elevation bars: one beam width
  int sweep_ticks = 182;         // >= 1
  int turn_ticks = 18;           // 0 only when circular
  int bars = 1;                  // 1..4; a scan is all of them
  bool circular = false;

  int pass_ticks() const { return sweep_ticks + turn_ticks; }
  int scan_ticks() const { return bars * pass_ticks(); }

  // Edge `index` in [0, sweep_ticks] of the sweeps of a pass [deg] against the scan centre, clockwise positive.
  // Direction +1 starts at the left. Sweep i lies between edges i and i + 1.
  double edge_deg(int index, int direction) const;
  // Where the dish is in the turn-around after `ticks` in [0, turn_ticks] of it [deg]: it brakes and comes back evenly.
  double turn_deg(int ticks, int direction) const;
  // Elevation of a bar against the commanded one [deg]: bars are stepped from the top down.
  double bar_deg(int bar) const;
};

ScanPattern make_scan_pattern(const radar::AntennaConfiguration& antenna, double width_deg);

}  // namespace yars::model::antenna

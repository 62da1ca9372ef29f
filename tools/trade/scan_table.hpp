// What the table of a trade of scans holds.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "tools/trade/evidence.hpp"
#include "tools/trade/scene.hpp"
#include "tools/trade/trade_table.hpp"

namespace yars::tools::trade {

enum ScanColumn : std::size_t {
  kScanMs,
  kSamplesPerSecond,
  kScanTerrainBytes,
  kScanPosition,
  kScanShadow,
  kScanPower,
  kScanGray
};
inline constexpr std::array<Column, 7> kScanColumns{{{"scan_ms", "ms a scan"},
                                                     {"samples_per_second", "M samples/s", 1e-6, true},
                                                     {"terrain_bytes", "terrain MB", 1e-6},
                                                     {"position_m", "position m"},
                                                     {"shadow_percent", "shadow %"},
                                                     {"power_db", "power dB"},
                                                     {"gray_levels", "gray"}}};
inline constexpr std::array<std::string_view, 5> kScanFields{"latitude_deg", "longitude_deg", "altitude_ft",
                                                             "heading_deg", "range_nm"};

struct Cost {
  double scan_ms = 0.0;  // [ms] of the thread's processor time
  double samples_per_second = 0.0;
  double terrain_bytes = 0.0;  // resident
};

Values values_of(const Cost& cost, const Errors& errors);
SceneRow row_of(const Scene& scene);

}  // namespace yars::tools::trade

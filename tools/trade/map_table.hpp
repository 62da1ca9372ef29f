// What the table of a trade of maps holds.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "tools/trade/map_evidence.hpp"
#include "tools/trade/map_view.hpp"
#include "tools/trade/trade_table.hpp"

namespace yars::tools::trade {

enum MapColumn : std::size_t { kMapMs, kMapTerrainBytes, kMapPosition, kMapShadow, kMapPower, kMapGray };
inline constexpr std::array<Column, 6> kMapColumns{{{"map_ms", "ms a map"},
                                                    {"terrain_bytes", "terrain MB", 1e-6},
                                                    {"position_m", "position m"},
                                                    {"shadow_percent", "shadow %"},
                                                    {"power_db", "power dB"},
                                                    {"gray_levels", "gray"}}};
inline constexpr std::array<std::string_view, 6> kMapFields{
    "latitude_deg", "longitude_deg", "altitude_ft", "target_latitude_deg", "target_longitude_deg", "window_nm"};

struct MapCost {
  double map_ms = 0.0;         // [ms] of the thread's processor time
  double terrain_bytes = 0.0;  // resident, of the window and the way to it
};

Values values_of(const MapCost& cost, const MapErrors& errors);
SceneRow row_of(const MapView& view);

}  // namespace yars::tools::trade

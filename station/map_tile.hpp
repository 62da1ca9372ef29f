// Tiles of the instructor's map: squares in degrees. Tile (level, row, column) has edges of kTileEdge_deg / 2^level;
// row 0 begins at the south pole, column 0 at 180 degrees west.
// Inputs: the path of a request, /map/LEVEL/ROW/COLUMN.png. Outputs: the tile; its frame in degrees and pixels.
// Errors: a path that names no tile gives nullopt.
// Source: docs/station.md#the-map.
#pragma once

#include <compare>
#include <optional>
#include <string_view>

#include "model/terrain/picture/hill_shade.hpp"

namespace yars::station {

inline constexpr double kTileEdge_deg = 8.0;  // of level 0
inline constexpr int kMaxTileLevel = 12;      // 217 m of latitude, 0.85 m a pixel
inline constexpr int kTilePixels = 256;

struct MapTile {
  int level = 0, row = 0, column = 0;
  auto operator<=>(const MapTile&) const = default;
};

std::optional<MapTile> tile_of_path(std::string_view path);
model::terrain::MapFrame frame_of(const MapTile& tile);

}  // namespace yars::station

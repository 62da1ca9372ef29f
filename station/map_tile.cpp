#include "station/map_tile.hpp"

#include <charconv>
#include <cmath>

namespace yars::station {

namespace {

constexpr std::string_view kBegin = "/map/", kEnd = ".png";

// Takes a whole number and what follows it, `end`, from the text.
std::optional<int> take_number(std::string_view& text, std::string_view end) {
  int number = 0;
  const auto [rest, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (problem != std::errc()) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(rest - text.data()));
  if (!text.starts_with(end)) return std::nullopt;
  text.remove_prefix(end.size());
  return number;
}

double edge_deg(int level) {
  return std::ldexp(kTileEdge_deg, -level);
}

}  // namespace

std::optional<MapTile> tile_of_path(std::string_view path) {
  if (!path.starts_with(kBegin)) return std::nullopt;
  path.remove_prefix(kBegin.size());
  const auto level = take_number(path, "/"), row = take_number(path, "/"), column = take_number(path, kEnd);
  if (!level || !row || !column || !path.empty() || *level < 0 || *level > kMaxTileLevel) return std::nullopt;
  const double edge = edge_deg(*level);
  if (*row < 0 || *row * edge >= 180.0 || *column < 0 || *column * edge >= 360.0) return std::nullopt;
  return MapTile{*level, *row, *column};
}

model::terrain::MapFrame frame_of(const MapTile& tile) {
  const double edge = edge_deg(tile.level);
  const double south_deg = -90.0 + tile.row * edge, west_deg = -180.0 + tile.column * edge;
  return {south_deg, south_deg + edge, west_deg, west_deg + edge, kTilePixels, kTilePixels};
}

}  // namespace yars::station

// Calls the fast path of a terrain view, surfaces(), with any number of positions in degrees.
#pragma once

#include <cmath>
#include <vector>

#include "model/terrain/formats/cell.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::test {

struct FastAnswer {
  std::vector<geo::GeoPoint> positions;  // [deg] the positions after rounding to float
  std::vector<float> elevation_m, water, peak_m;
  std::vector<std::int32_t> material;
  std::size_t not_loaded = 0;
};

// Cells are counted from the cell of the first position.
inline FastAnswer fast_path(const model::terrain::TerrainView& view, const std::vector<geo::GeoPoint>& positions,
                            radar::Interpolation interpolation = radar::Interpolation::bilinear) {
  using model::terrain::CellCorner;
  const geo::GeoPoint first = positions.front();
  const bool finite = std::isfinite(first.latitude_deg) && std::isfinite(first.longitude_deg);
  const CellCorner corner = finite ? model::terrain::cell_containing(first) : CellCorner{};
  const std::size_t room = positions.size() + model::terrain::kRunSlack;
  std::vector<float> cells_north(room), cells_east(room), north_deg(room), east_deg(room);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const double north = positions[i].latitude_deg - corner.south_deg;
    const double east = positions[i].longitude_deg - corner.west_deg;
    cells_north[i] = static_cast<float>(std::floor(north));
    cells_east[i] = static_cast<float>(std::floor(east));
    north_deg[i] = static_cast<float>(north - std::floor(north));
    east_deg[i] = static_cast<float>(east - std::floor(east));
  }
  const auto of = [&](const std::vector<float>& values) { return std::span(values.data(), positions.size()); };
  const model::terrain::PositionRun run{corner, of(cells_north), of(cells_east), of(north_deg), of(east_deg)};
  FastAnswer answer{
      {}, std::vector<float>(room), std::vector<float>(room), std::vector<float>(room), std::vector<std::int32_t>(room),
      0};
  for (std::size_t i = 0; i < positions.size(); ++i) answer.positions.push_back(position_of(run, i));
  answer.not_loaded = view.surfaces(run, interpolation,
                                    {{answer.elevation_m.data(), positions.size()},
                                     {answer.water.data(), positions.size()},
                                     {answer.peak_m.data(), positions.size()},
                                     {answer.material.data(), positions.size()}});
  answer.elevation_m.resize(positions.size());
  answer.water.resize(positions.size());
  answer.peak_m.resize(positions.size());
  answer.material.resize(positions.size());
  return answer;
}

}  // namespace yars::test

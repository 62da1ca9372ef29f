// Calls the fast path of a terrain view with positions in degrees, any number of them.
#pragma once

#include <cmath>
#include <vector>

#include "model/terrain/formats/cell.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::test {

struct FastAnswer {
  std::vector<geo::GeoPoint> places;  // as float holds them
  std::vector<float> elevation_m, water, peak_m;
  std::vector<std::int32_t> material;
  std::size_t not_loaded = 0;
};

inline FastAnswer fast_path(const model::terrain::TerrainView& view, const std::vector<geo::GeoPoint>& places,
                            radar::Interpolation interpolation = radar::Interpolation::bilinear) {
  using model::terrain::CellPlace;
  const geo::GeoPoint first = places.front();
  const bool finite = std::isfinite(first.latitude_deg) && std::isfinite(first.longitude_deg);
  const CellPlace corner = finite ? model::terrain::cell_holding(first) : CellPlace{};
  const std::size_t room = places.size() + model::terrain::kRunSlack;
  std::vector<float> cells_north(room), cells_east(room), north_deg(room), east_deg(room);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double north = places[i].latitude_deg - corner.south_deg;
    const double east = places[i].longitude_deg - corner.west_deg;
    cells_north[i] = static_cast<float>(std::floor(north));
    cells_east[i] = static_cast<float>(std::floor(east));
    north_deg[i] = static_cast<float>(north - std::floor(north));
    east_deg[i] = static_cast<float>(east - std::floor(east));
  }
  const auto of = [&](const std::vector<float>& values) { return std::span(values.data(), places.size()); };
  const model::terrain::PlaceRun run{corner, of(cells_north), of(cells_east), of(north_deg), of(east_deg)};
  FastAnswer answer{
      {}, std::vector<float>(room), std::vector<float>(room), std::vector<float>(room), std::vector<std::int32_t>(room),
      0};
  for (std::size_t i = 0; i < places.size(); ++i) answer.places.push_back(place_of(run, i));
  answer.not_loaded = view.surfaces(run, interpolation,
                                    {{answer.elevation_m.data(), places.size()},
                                     {answer.water.data(), places.size()},
                                     {answer.peak_m.data(), places.size()},
                                     {answer.material.data(), places.size()}});
  answer.elevation_m.resize(places.size());
  answer.water.resize(places.size());
  answer.peak_m.resize(places.size());
  answer.material.resize(places.size());
  return answer;
}

}  // namespace yars::test

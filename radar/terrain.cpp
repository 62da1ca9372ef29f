#include "yars/terrain.hpp"

#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "lib/geo/geodesy.hpp"
#include "lib/text/plain_text.hpp"
#include "radar/limits.hpp"
#include "radar/private_data.hpp"

namespace yars {

using model::scene::SceneUse;
using radar::Theatre;

std::string Terrain::Stores::key_of(const std::vector<radar::Scene>& scenes, SceneUse use) {
  std::string key = use == SceneUse::triangles ? "maps" : "scans";
  for (const radar::Scene& scene : scenes)
    key += '\n' + scene.file + '@' + std::to_string(scene.position.latitude_deg) + ',' +
           std::to_string(scene.position.longitude_deg) + ',' + std::to_string(scene.heading_deg) + ',' + scene.without;
  return key;
}

Expected<Terrain> Terrain::open(const TerrainSettings& settings) {
  return radar::guarded([&] {
    radar::TerrainConfiguration configuration;
    configuration.directory = settings.folder;
    configuration.missing_cell_is_sea = settings.missing_cell_is_sea;
    auto stores = std::make_shared<Stores>(std::move(configuration));
    stores->with_theatre({}, SceneUse::scatterers, {}, [](const Theatre&) {});  // a missing folder is reported at once
    return Terrain(std::move(stores));
  });
}

const std::string& Terrain::folder() const {
  return stores_->configuration().directory;
}

namespace {

// Positions with the cells of a folder in which they lie.
struct CellPositions {
  std::vector<geo::GeoPoint> positions;
  std::vector<std::size_t> order;  // of the positions, cell by cell
  std::size_t outside = 0;         // positions in no cell
};

void check_position(double latitude_deg, double longitude_deg) {
  using At = values::Pose;
  for (const auto& [field, found] : {std::pair{&At::latitude, latitude_deg}, std::pair{&At::longitude, longitude_deg}})
    if (!field->contains(found)) radar::fail(radar::beyond_field(std::string(field->name), *field, found));
}

CellPositions cells_of(const model::terrain::DirectoryIndex* index, std::span<const double> latitude_deg,
                       std::span<const double> longitude_deg, const parallel::GoesOn& goes_on) {
  constexpr std::size_t kBetweenChecks = 1U << 16U;
  CellPositions cells;
  cells.positions.resize(latitude_deg.size());
  std::map<std::size_t, std::vector<std::size_t>> by_cell;
  for (std::size_t i = 0; i < cells.positions.size(); ++i) {
    if (i % kBetweenChecks == 0) parallel::check(goes_on);
    check_position(latitude_deg[i], longitude_deg[i]);
    geo::GeoPoint& position = cells.positions[i] = {latitude_deg[i], longitude_deg[i]};
    if (index != nullptr) position = within_index(*index, position);
    by_cell[slot_of(model::terrain::cell_containing(position))].push_back(i);
  }
  cells.order.reserve(cells.positions.size());
  for (const auto& [slot, members] : by_cell) {
    if (index != nullptr && !index->contains(slot)) cells.outside += members.size();
    cells.order.insert(cells.order.end(), members.begin(), members.end());
  }
  return cells;
}

void fill_elevations(Terrain::Stores& stores, const CellPositions& cells, std::span<double> elevation_m,
                     const radar::Warn& warn, const parallel::GoesOn& goes_on) {
  constexpr std::size_t kChunk = 1U << 16U;  // positions between two calls of `goes_on`
  model::terrain::TerrainViewPointer view;
  std::optional<model::terrain::CellCorner> cell_of_view;
  for (std::size_t first = 0; first < cells.order.size(); first += kChunk) {
    parallel::check(goes_on);
    stores.with_theatre({}, SceneUse::scatterers, goes_on, [&](Theatre& theatre) {
      for (std::size_t k = first; k < std::min(first + kChunk, cells.order.size()); ++k) {
        const geo::GeoPoint position = cells.positions[cells.order[k]];
        const model::terrain::CellCorner cell = model::terrain::cell_containing(position);
        // On an edge of the cell, a neighbour may have the height (CellView).
        const bool on_edge = position.latitude_deg == std::floor(position.latitude_deg) ||
                             position.longitude_deg == std::floor(position.longitude_deg);
        if (!view || !(cell_of_view == cell) || on_edge) view = theatre.terrain_at(position, warn);
        cell_of_view = cell;
        elevation_m[cells.order[k]] = view->elevation_m(position);
      }
    });
  }
}

}  // namespace

Expected<void> Terrain::elevations(std::span<const double> latitude_deg, std::span<const double> longitude_deg,
                                   std::span<double> elevation_m, const Call& call) const {
  return radar::guarded([&] {
    if (latitude_deg.size() != longitude_deg.size() || latitude_deg.size() != elevation_m.size())
      radar::fail(error::usage_error("elevation_m", "as many numbers as latitudes and longitudes",
                                     std::to_string(latitude_deg.size()) + ", " + std::to_string(longitude_deg.size()) +
                                         " and " + std::to_string(elevation_m.size())));
    const radar::Warn warn = radar::warn_of(call);
    const auto* const index = stores_->with_theatre({}, SceneUse::scatterers, call.goes_on,
                                                    [](const Theatre& theatre) { return theatre.index(); });
    const CellPositions cells = cells_of(index, latitude_deg, longitude_deg, call.goes_on);
    if (cells.outside > 0)
      warn(folder() + ": expected positions in its cells, found " + std::to_string(cells.outside) + " of " +
           std::to_string(latitude_deg.size()) + " outside: the folder covers " + coverage_text(*index) +
           "; the ground there counts as sea; check the positions and their signs");
    fill_elevations(*stores_, cells, elevation_m, warn, call.goes_on);
  });
}

}  // namespace yars

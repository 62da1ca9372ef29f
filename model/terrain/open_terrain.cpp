#include "model/terrain/open_terrain.hpp"

#include <utility>

#include "model/terrain/analytic_terrain.hpp"
#include "model/terrain/directory_store.hpp"

namespace yars::model::terrain {

failure::Expected<std::unique_ptr<TerrainStore>> open_terrain(const radar::TerrainConfiguration& configuration) {
  if (configuration.directory.empty())
    return std::make_unique<FixedTerrainStore>(std::make_shared<const AnalyticTerrain>(built_in_hills()));
  auto store =
      DirectoryTerrainStore::open(configuration.directory, {.missing_cell_is_sea = configuration.missing_cell_is_sea});
  if (!store) return tl::unexpected(store.error());
  return std::move(*store);
}

}  // namespace yars::model::terrain

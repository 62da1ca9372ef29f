#include "model/hrm/polar_scene.hpp"

#include <algorithm>
#include <cstddef>

namespace yars::model::hrm {

void PolarScene::begin(const PatchData& data) {
  drawn_ = !data.tiles.empty();
  if (!drawn_) return;
  const std::size_t before = walls_.size();
  walls_.resize(data.grid.size());
  if (!dirty_ && walls_.size() == before) return;
  std::fill_n(walls_.data(), walls_.size(), WallPoint());
  dirty_ = false;
}

void PolarScene::draw(const PatchInputs& inputs, PatchData& data) {
  if (!drawn_) return;
  dirty_ = true;
  const parallel::Executor& executor = inputs.executor;
  while (rasters_.size() < executor.threads) rasters_.emplace_back(configuration_);
  // Tiles that cross bands are drawn in each band, so bands are few. Two a thread balance the load.
  const auto bands = static_cast<int>(executor.threads == 1 ? 1 : 2 * executor.threads);
  const std::vector<PlacedTile> placed = place_tiles(*data.geometry, data.grid, data.tiles, executor);
  const std::vector<int> begin = even_bands(data.grid, placed, bands);
  parallel::parallel_for(executor, bands, 1, [&](int first, int last, std::size_t thread) {
    for (auto band = static_cast<std::size_t>(first); band < static_cast<std::size_t>(last); ++band)
      rasters_[thread].draw(*data.geometry, data.grid, *inputs.environment.scene, placed, begin[band] * kStripColumns,
                            begin[band + 1] * kStripColumns, {data.surface.data(), walls_.data()});
  });
}

}  // namespace yars::model::hrm

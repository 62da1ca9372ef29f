#include "model/terrain/landscape.hpp"

#include <algorithm>
#include <thread>
#include <utility>
#include <vector>

#include "lib/failure/require.hpp"
#include "model/terrain/landscape_rows.hpp"

namespace yars::model::terrain {

Landscape::Landscape(std::uint64_t seed, std::optional<LandscapeBox> island)
    : seed_(static_cast<std::uint32_t>(seed ^ (seed >> 32U)) * 4096U),
      tiles_(std::make_unique<LandscapeTiles>(seed_, island)) {}

MadeCell Landscape::make(CellPlace place, int rows, int columns, int threads) const {
  YARS_REQUIRE(threads, >=, 1);
  const LandscapeRows maker(*tiles_, seed_, place, rows, columns);
  const auto width = static_cast<std::size_t>(columns);
  std::vector<std::int16_t> posts(static_cast<std::size_t>(rows) * width);
  std::vector<std::uint8_t> codes(posts.size());
  // Each thread takes every so many rows: they cost alike.
  const auto work = [&](int first) {
    for (int row = first; row < rows; row += threads) {
      const std::size_t start = static_cast<std::size_t>(row) * width;
      maker.make(row, std::span(posts).subspan(start, width), std::span(codes).subspan(start, width));
    }
  };
  std::vector<std::thread> others;
  for (int first = 1; first < threads; ++first) others.emplace_back(work, first);
  work(0);
  for (std::thread& other : others) other.join();
  return {Cell(place, rows, columns, std::move(posts)), Culture(place, rows, columns, std::move(codes))};
}

bool Landscape::may_have_land(CellPlace place) const {
  const auto land = tiles_->relief(place);
  // The ring about the tile holds the nodes of its far edges; a spline and its gullies rise no higher than this.
  constexpr double kCannotRiseM = -100.0;
  for (int row = -1; row <= kTileNodes; ++row)
    for (int column = -1; column <= kTileNodes; ++column)
      if (land->height_m(row, column) > kCannotRiseM) return true;
  return false;
}

}  // namespace yars::model::terrain

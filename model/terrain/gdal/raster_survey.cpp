#include "model/terrain/gdal/raster_survey.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "model/terrain/gdal/open_raster.hpp"
#include "model/terrain/gdal/raster_cover.hpp"

namespace yars::model::terrain::gdal {

namespace {

// Pixels [first, first + count) of one dimension whose centres lie in [edge_deg, edge_deg + 1].
struct Span {
  int edge_deg = 0;  // south or west edge; a west edge may be outside [-180, 180)
  int first = 0, count = 0;
};

// Spans of a row or column of pixels. `degrees`: coordinates of the pixels' centres, ascending or descending.
// A pixel within 1e-7 deg of a whole degree belongs to the spans on both sides.
std::vector<Span> spans_of(const std::vector<double>& degrees) {
  constexpr double kEdge_deg = 1e-7;
  std::vector<Span> spans;
  std::map<int, std::size_t> span_of_edge;
  const auto add = [&](int edge_deg, int pixel) {
    const auto [entry, fresh] = span_of_edge.try_emplace(edge_deg, spans.size());
    if (fresh) spans.push_back({edge_deg, pixel, 0});
    ++spans[entry->second].count;
  };
  for (std::size_t pixel = 0; pixel < degrees.size(); ++pixel) {
    if (!std::isfinite(degrees[pixel])) continue;  // no position on the earth
    const int edge_deg = static_cast<int>(std::floor(degrees[pixel] + kEdge_deg));
    add(edge_deg, static_cast<int>(pixel));
    if (std::abs(degrees[pixel] - edge_deg) < kEdge_deg) add(edge_deg - 1, static_cast<int>(pixel));
  }
  return spans;
}

// Adds the heights of `count` pixels to the statistics of a cell.
void add_pixels(const float* heights_m, int count, RasterCellStatistics& statistics) {
  float lowest_m = statistics.posts == statistics.voids ? INFINITY : statistics.lowest_m;
  float highest_m = statistics.posts == statistics.voids ? -INFINITY : statistics.highest_m;
  std::size_t known = 0;
  std::size_t sea = 0;
  for (int i = 0; i < count; ++i) {
    const float height_m = heights_m[i];
    const bool is_known = std::isfinite(height_m);  // else void: no data, or an impossible height
    known += is_known ? 1 : 0;
    sea += height_m == 0.0F ? 1 : 0;
    lowest_m = is_known && height_m < lowest_m ? height_m : lowest_m;
    highest_m = is_known && height_m > highest_m ? height_m : highest_m;
  }
  statistics.posts += static_cast<std::size_t>(count);
  statistics.voids += static_cast<std::size_t>(count) - known;
  statistics.sea += sea;
  if (statistics.posts > statistics.voids) {
    statistics.lowest_m = lowest_m;
    statistics.highest_m = highest_m;
  }
}

// Statistics of the cells of a raster, by one pass over its rows.
class Survey {
 public:
  explicit Survey(const Raster& raster) : raster_(raster) {
    std::vector<double> across(static_cast<std::size_t>(raster.columns), 0.0), along(across.size(), 0.5);
    for (std::size_t i = 0; i < across.size(); ++i) across[i] = static_cast<double>(i) + 0.5;
    raster.georeference.to_earth(across, along);
    wests_ = spans_of(across);
    across.assign(static_cast<std::size_t>(raster.rows), 0.5);
    along.resize(across.size());
    for (std::size_t i = 0; i < along.size(); ++i) along[i] = static_cast<double>(i) + 0.5;
    raster.georeference.to_earth(across, along);
    souths_ = spans_of(along);
    for (const RasterCell& cell : cells_of(raster)) statistics_[{cell.south_deg, cell.west_deg}] = {};
  }

  error::Expected<RasterStatistics> run(const std::function<void(double)>& progress) {
    // Strips of about 4 million pixels bound the memory.
    const int rows_at_once = std::clamp((1 << 22) / raster_.columns, 1, raster_.rows);
    for (int row = 0; row < raster_.rows; row += rows_at_once) {
      const Box box{0, row, raster_.columns, std::min(rows_at_once, raster_.rows - row)};
      const auto heights = read_heights(raster_, box);
      if (!heights) return tl::unexpected(heights.error());
      add_rows(*heights, box);
      if (progress) progress(static_cast<double>(row + box.rows) / raster_.rows);
    }
    RasterStatistics statistics{{}, impossible_, raster_.georeference.notes()};
    for (auto& [position, cell] : statistics_) {
      cell.south_deg = position.first;
      cell.west_deg = position.second;
      statistics.cells.push_back(cell);
    }
    return statistics;
  }

 private:
  void add_rows(const std::vector<float>& heights, const Box& box) {
    impossible_ += static_cast<std::size_t>(
        std::count_if(heights.begin(), heights.end(), [](float height_m) { return std::isinf(height_m); }));
    for (const Span& south : souths_)
      for (int row = std::max(south.first, box.first_row);
           row < std::min(south.first + south.count, box.first_row + box.rows); ++row)
        add_row(heights.data() + static_cast<std::size_t>(row - box.first_row) * static_cast<std::size_t>(box.columns),
                south.edge_deg, row == south.first);
  }

  void add_row(const float* heights_m, int south_deg, bool first) {
    for (const Span& west : wests_) {
      const auto found = statistics_.find({south_deg, ((west.edge_deg + 180) % 360 + 360) % 360 - 180});
      if (found == statistics_.end()) continue;
      if (first) found->second.columns += west.count;
      add_pixels(heights_m + west.first, west.count, found->second);
    }
  }

  const Raster& raster_;
  std::vector<Span> wests_, souths_;
  std::map<std::pair<int, int>, RasterCellStatistics> statistics_;
  std::size_t impossible_ = 0;
};

}  // namespace

error::Expected<std::optional<RasterStatistics>> survey_raster(const std::filesystem::path& path,
                                                               const std::function<void(double)>& progress) {
  const auto raster = open_raster(path);
  if (!raster) return tl::unexpected(raster.error());
  const Georeference& georeference = raster->georeference;
  if (!georeference.is_wgs84_grid() || georeference.heights_are_ellipsoidal()) return std::nullopt;
  auto statistics = Survey(*raster).run(progress);
  if (!statistics) return tl::unexpected(statistics.error());
  return std::move(*statistics);
}

}  // namespace yars::model::terrain::gdal

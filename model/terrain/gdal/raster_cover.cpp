#include "model/terrain/gdal/raster_cover.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "model/terrain/gdal/open_raster.hpp"

namespace yars::model::terrain::gdal {

namespace {

constexpr double kMinPosts = 15.0;  // [1/deg] minimum posts per degree; the pixels of a coarser raster are resampled

// Extent of a raster whose rows and columns are parallels and meridians [deg]. It ends at the centres of the outermost
// pixels. Longitudes are not wrapped.
struct Extent {
  double south_deg, north_deg, west_deg, east_deg;
  double pixel_north_deg, pixel_east_deg;
};

Extent extent_of(const Raster& raster) {
  std::array<double, 2> across{0.5, raster.columns - 0.5};
  std::array<double, 2> along{0.5, raster.rows - 0.5};
  std::array<double, 2> step_across{0.5, 1.5};
  std::array<double, 2> step_along{0.5, 1.5};
  raster.georeference.to_earth(across, along);
  raster.georeference.to_earth(step_across, step_along);
  const auto [west, east] = std::minmax(across[0], across[1]);
  const auto [south, north] = std::minmax(along[0], along[1]);
  return {south, north, west, east, std::abs(step_along[1] - step_along[0]), std::abs(step_across[1] - step_across[0])};
}

// True for numbers of pixels that are whole within a thousandth of a pixel.
bool is_whole(double number) {
  return std::abs(number - std::round(number)) < 1e-3;
}

// True if whole degrees are centres of pixels, and a degree has a whole number of pixels, at most kMaxPostsPerDegree.
bool aligned(double first_deg, double pixel_deg) {
  const double posts = 1.0 / pixel_deg;
  return is_whole(posts) && std::abs(posts) <= kMaxPostsPerDegree && is_whole(first_deg / pixel_deg);
}

// Posts per degree for a raster that is resampled: at least twice its pixels per degree, at most kMaxPostsPerDegree.
// Candidates are 15, 45, 75 and 225 times powers of two, which can be halved often for coarser copies of a cell, and
// kMaxPostsPerDegree. Accuracy: see raster.hpp.
int posts_per_degree_for(double pixels_per_degree) {
  const double min_posts = std::min(2.0 * pixels_per_degree * (1.0 - 1e-6), static_cast<double>(kMaxPostsPerDegree));
  int best = kMaxPostsPerDegree;
  for (const int odd : {15, 45, 75, 225})
    for (int posts = odd; posts < best; posts *= 2)
      if (posts >= min_posts) best = posts;
  return best;
}

int wrapped(int west_deg) {
  return ((west_deg + 180) % 360 + 360) % 360 - 180;
}

// Length of the intersection of [edge, edge + 1] and [low, high]; negative if they are apart.
double overlap(double edge, double low, double high) {
  return std::min(edge + 1.0, high) - std::max(edge, low);
}

// Cells that overlap a WGS84 grid by a quarter of a pixel or more; with `edges` the other cells that it touches.
std::vector<RasterCell> wgs84_grid_cells(const Raster& raster, bool edges) {
  const Extent extent = extent_of(raster);
  // to_earth() gives NaN more than half a degree beyond a pole, and beyond +-1080 degrees of longitude. A raster with
  // such an edge has no cells.
  for (const double edge_deg : {extent.south_deg, extent.north_deg, extent.west_deg, extent.east_deg})
    if (!std::isfinite(edge_deg)) return {};
  const auto posts_of = [](double first_deg, double pixel_deg) {
    return aligned(first_deg, pixel_deg) && 1.0 / pixel_deg > kMinPosts - 0.5
               ? static_cast<int>(std::lround(1.0 / pixel_deg))
               : posts_per_degree_for(1.0 / pixel_deg);
  };
  const int posts_north = posts_of(extent.south_deg, extent.pixel_north_deg);
  const int posts_east = posts_of(extent.west_deg, extent.pixel_east_deg);
  std::vector<RasterCell> cells;
  std::set<std::pair<int, int>> seen;
  const double touch_north_deg = extent.pixel_north_deg / 4, touch_east_deg = extent.pixel_east_deg / 4;
  const int last_south = std::min(89, static_cast<int>(std::floor(extent.north_deg + touch_north_deg)));
  const int first_south = std::max(-90, static_cast<int>(std::floor(extent.south_deg - touch_north_deg)) - 1);
  for (int south = first_south; south <= last_south; ++south) {
    const double height_deg = overlap(south, extent.south_deg, extent.north_deg);
    if (height_deg < -touch_north_deg) continue;
    for (int west = static_cast<int>(std::floor(extent.west_deg - touch_east_deg)) - 1;
         west <= std::floor(extent.east_deg + touch_east_deg); ++west) {
      const double width_deg = overlap(west, extent.west_deg, extent.east_deg);
      if (width_deg < -touch_east_deg) continue;
      const bool edge = height_deg < touch_north_deg || width_deg < touch_east_deg;
      if (edge != edges || !seen.emplace(south, wrapped(west)).second) continue;
      cells.push_back({south, wrapped(west), edge ? 0.0 : height_deg * width_deg, posts_north, posts_east});
    }
  }
  return cells;
}

struct SampleGrid {
  std::vector<double> across, along;
  void add(double x, double y) {
    across.push_back(x);
    along.push_back(y);
  }
};

bool inside(const Raster& raster, double column, double row) {
  constexpr double kSlack = 0.25;  // [pixels]
  return column >= 0.5 - kSlack && row >= 0.5 - kSlack && column <= raster.columns - 0.5 + kSlack &&
         row <= raster.rows - 0.5 + kSlack;
}

// Fraction of the cell that lies inside the raster, estimated by a grid of sample points.
double fraction_inside(const Raster& raster, int south_deg, int west_deg) {
  constexpr int kSteps = 8;
  SampleGrid samples;
  for (int up = 0; up <= kSteps; ++up)
    for (int right = 0; right <= kSteps; ++right)
      samples.add(west_deg + static_cast<double>(right) / kSteps, south_deg + static_cast<double>(up) / kSteps);
  raster.georeference.to_pixels(samples.across, samples.along, {west_deg + 0.5, south_deg + 0.5});
  int count = 0;
  for (std::size_t i = 0; i < samples.across.size(); ++i)
    count += inside(raster, samples.across[i], samples.along[i]) ? 1 : 0;
  return count / static_cast<double>(samples.across.size());
}

struct Rates {
  double north = 0.0, east = 0.0;  // [pixels/deg] maximum of the rates at three points of the cell's middle meridian
};

// Pixels per degree in a cell.
Rates rates_in(const Raster& raster, int south_deg, int west_deg) {
  constexpr double kStep_deg = 1e-4;
  Rates rates;
  for (const double up : {0.001, 0.5, 0.999}) {
    const double latitude_deg = south_deg + up;
    const double longitude_deg = west_deg + 0.5;
    SampleGrid samples;
    samples.add(longitude_deg, latitude_deg);
    samples.add(longitude_deg, latitude_deg + (up > 0.5 ? -kStep_deg : kStep_deg));
    samples.add(longitude_deg + kStep_deg, latitude_deg);
    raster.georeference.to_pixels(samples.across, samples.along, {west_deg + 0.5, south_deg + 0.5});
    const auto rate = [&](std::size_t to) {
      return std::hypot(samples.across[to] - samples.across[0], samples.along[to] - samples.along[0]) / kStep_deg;
    };
    if (std::isfinite(rate(1))) rates.north = std::max(rates.north, rate(1));
    if (std::isfinite(rate(2))) rates.east = std::max(rates.east, rate(2));
  }
  return rates;
}

// The cells that contain sample points of a grid over the raster, each with the fraction of all samples in this cell.
std::map<std::pair<int, int>, double> cells_of_pixels(const Raster& raster) {
  constexpr int kSteps = 64;
  SampleGrid samples;
  for (int down = 0; down <= kSteps; ++down)
    for (int right = 0; right <= kSteps; ++right)
      samples.add(0.5 + (raster.columns - 1.0) * right / kSteps, 0.5 + (raster.rows - 1.0) * down / kSteps);
  raster.georeference.to_earth(samples.across, samples.along);
  std::map<std::pair<int, int>, double> cells;
  for (std::size_t i = 0; i < samples.across.size(); ++i)
    if (std::isfinite(samples.across[i]))
      cells[{std::clamp(static_cast<int>(std::floor(samples.along[i])), -90, 89),
             wrapped(static_cast<int>(std::floor(samples.across[i])))}] +=
          1.0 / static_cast<double>(samples.across.size());
  return cells;
}

// [deg^2] Area of a raster. Used for rasters so small that no sample point of fraction_inside() lies on them.
double area_of(const Raster& raster, const Rates& rates) {
  return static_cast<double>(raster.columns) * raster.rows / std::max(1.0, rates.north * rates.east);
}

// All cells that may contain pixels. Rows of cells: from one row south of all samples to one row north of them. Columns
// of cells: those with samples, and the columns beside them.
std::set<std::pair<int, int>> candidates(const std::map<std::pair<int, int>, double>& sampled) {
  int south = 90, north = -90;
  std::set<int> wests;
  for (const auto& [position, fraction] : sampled) {
    south = std::min(south, position.first);
    north = std::max(north, position.first);
    for (const int beside : {-1, 0, 1}) wests.insert(wrapped(position.second + beside));
  }
  // Near a pole, and in a large raster, the samples may skip whole columns of cells. Then all columns are examined.
  if (south <= -80 || north >= 79 || wests.size() > 60)
    for (int west = -180; west < 180; ++west) wests.insert(west);
  std::set<std::pair<int, int>> found;
  for (int row = std::max(-90, south - 1); row <= std::min(89, north + 1); ++row)
    for (const int west : wests) found.emplace(row, west);
  return found;
}

std::vector<RasterCell> projected_cells(const Raster& raster) {
  const auto sampled = cells_of_pixels(raster);
  std::vector<RasterCell> cells;
  for (const auto& position : candidates(sampled)) {
    const auto found = sampled.find(position);
    const double fraction = fraction_inside(raster, position.first, position.second);
    if (found == sampled.end() && fraction <= 0.0) continue;
    const Rates rates = rates_in(raster, position.first, position.second);
    if (!(rates.north > 0.0) || !(rates.east > 0.0)) continue;
    const double small = found == sampled.end() ? 0.0 : std::min(1.0, found->second * area_of(raster, rates));
    cells.push_back({position.first, position.second, fraction > 0.0 ? fraction : small,
                     posts_per_degree_for(rates.north), posts_per_degree_for(rates.east)});
  }
  return cells;
}

}  // namespace

std::vector<RasterCell> cells_of(const Raster& raster) {
  return raster.georeference.is_wgs84_grid() ? wgs84_grid_cells(raster, false) : projected_cells(raster);
}

std::vector<RasterCell> edges_of(const Raster& raster) {
  return raster.georeference.is_wgs84_grid() ? wgs84_grid_cells(raster, true) : std::vector<RasterCell>{};
}

PostRange touched_posts(const Raster& raster, const Grid& grid) {
  const PostRange all{0, grid.rows, 0, grid.columns};
  constexpr int kSteps = 32;
  SampleGrid border;
  for (int i = 0; i <= kSteps; ++i) {
    const double column = raster.columns * static_cast<double>(i) / kSteps;
    const double row = raster.rows * static_cast<double>(i) / kSteps;
    border.add(column, 0.0);
    border.add(column, raster.rows);
    border.add(0.0, row);
    border.add(raster.columns, row);
  }
  raster.georeference.to_earth(border.across, border.along);
  const auto [west, east] = std::minmax_element(border.across.begin(), border.across.end());
  const auto [south, north] = std::minmax_element(border.along.begin(), border.along.end());
  for (std::size_t i = 0; i < border.across.size(); ++i)
    if (!std::isfinite(border.across[i]) || !std::isfinite(border.along[i])) return all;
  // Around a pole or the antimeridian the border does not bound the raster.
  constexpr double kNearPole_deg = 80.0, kWide_deg = 20.0;
  if (*south < -kNearPole_deg || *north > kNearPole_deg || *east - *west > kWide_deg || *north - *south > kWide_deg)
    return all;
  // A curved border reaches less than a tenth beyond its samples; a post beside a pixel may take its height.
  const double margin_deg = 0.02 + 0.1 * std::max(*north - *south, *east - *west);
  const double turns = 360.0 * std::round((grid.west_deg + 0.5 - (*west + *east) / 2) / 360.0);
  const auto range = [&](double low_deg, double high_deg, int edge_deg, int posts) {
    const double first = std::floor((low_deg - margin_deg - edge_deg) * (posts - 1));
    const double last = std::ceil((high_deg + margin_deg - edge_deg) * (posts - 1));
    return std::pair(static_cast<int>(std::clamp(first, 0.0, static_cast<double>(posts))),
                     static_cast<int>(std::clamp(last + 1.0, 0.0, static_cast<double>(posts))));
  };
  const auto [first_row, end_row] = range(*south, *north, grid.south_deg, grid.rows);
  const auto [first_column, end_column] = range(*west + turns, *east + turns, grid.west_deg, grid.columns);
  return {first_row, end_row, first_column, end_column};
}

bool posts_are_pixels(const Raster& raster, int posts_per_degree_north, int posts_per_degree_east) {
  if (!raster.georeference.is_wgs84_grid()) return false;
  const Extent extent = extent_of(raster);
  return aligned(extent.south_deg, extent.pixel_north_deg) && aligned(extent.west_deg, extent.pixel_east_deg) &&
         std::lround(1.0 / extent.pixel_north_deg) == posts_per_degree_north &&
         std::lround(1.0 / extent.pixel_east_deg) == posts_per_degree_east;
}

}  // namespace yars::model::terrain::gdal

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

constexpr double kFewestPosts = 15.0;  // a degree

// Between the middles of the outermost pixels of a plain raster [deg]; longitudes not wrapped.
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

// A whole number, to a thousandth of a pixel over a degree.
bool is_whole(double number) {
  return std::abs(number - std::round(number)) < 1e-3;
}

bool aligned(double first_deg, double pixel_deg) {
  const double posts = 1.0 / pixel_deg;
  return is_whole(posts) && std::abs(posts) <= kMaxPostsPerDegree && is_whole(first_deg / pixel_deg);
}

// The least of 15, 45, 75 and 225 times a power of two that is twice as fine as the raster: so that it halves often,
// and what lies between its posts is what lies between the raster's (within a quarter of their own error of slope).
int twice_as_fine(double pixels_a_degree) {
  const double wanted = std::min(2.0 * pixels_a_degree * (1.0 - 1e-6), static_cast<double>(kMaxPostsPerDegree));
  int best = kMaxPostsPerDegree;
  for (const int odd : {15, 45, 75, 225})
    for (int posts = odd; posts < best; posts *= 2)
      if (posts >= wanted) best = posts;
  return best;
}

int wrapped(int west_deg) {
  return ((west_deg + 180) % 360 + 360) % 360 - 180;
}

// How much of [edge, edge + 1] lies in [low, high].
double overlap(double edge, double low, double high) {
  return std::min(edge + 1.0, high) - std::max(edge, low);
}

std::vector<RasterCell> plain_cells(const Raster& raster) {
  const Extent extent = extent_of(raster);
  const auto posts_of = [](double first_deg, double pixel_deg) {
    return aligned(first_deg, pixel_deg) && 1.0 / pixel_deg > kFewestPosts - 0.5
               ? static_cast<int>(std::lround(1.0 / pixel_deg))
               : twice_as_fine(1.0 / pixel_deg);
  };
  const int posts_north = posts_of(extent.south_deg, extent.pixel_north_deg);
  const int posts_east = posts_of(extent.west_deg, extent.pixel_east_deg);
  std::vector<RasterCell> cells;
  std::set<std::pair<int, int>> seen;
  const int last_south = std::min(89, static_cast<int>(std::floor(extent.north_deg)));
  for (int south = std::max(-90, static_cast<int>(std::floor(extent.south_deg))); south <= last_south; ++south) {
    const double high = overlap(south, extent.south_deg, extent.north_deg);
    if (high < extent.pixel_north_deg / 4) continue;
    for (int west = static_cast<int>(std::floor(extent.west_deg)); west <= std::floor(extent.east_deg); ++west) {
      const double wide = overlap(west, extent.west_deg, extent.east_deg);
      if (wide < extent.pixel_east_deg / 4 || !seen.emplace(south, wrapped(west)).second) continue;
      cells.push_back({south, wrapped(west), high * wide, posts_north, posts_east});
    }
  }
  return cells;
}

struct Net {
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

// Share of a net over the cell that lies in the raster.
double share_inside(const Raster& raster, int south_deg, int west_deg) {
  constexpr int kSteps = 8;
  Net net;
  for (int up = 0; up <= kSteps; ++up)
    for (int right = 0; right <= kSteps; ++right)
      net.add(west_deg + static_cast<double>(right) / kSteps, south_deg + static_cast<double>(up) / kSteps);
  raster.georeference.to_pixels(net.across, net.along, {west_deg + 0.5, south_deg + 0.5});
  int count = 0;
  for (std::size_t i = 0; i < net.across.size(); ++i) count += inside(raster, net.across[i], net.along[i]) ? 1 : 0;
  return count / static_cast<double>(net.across.size());
}

struct Rates {
  double north = 0.0, east = 0.0;  // pixels a degree, where they are most
};

Rates rates_in(const Raster& raster, int south_deg, int west_deg) {
  constexpr double kStep_deg = 1e-4;
  Rates rates;
  for (const double up : {0.001, 0.5, 0.999}) {
    const double latitude_deg = south_deg + up;
    const double longitude_deg = west_deg + 0.5;
    Net net;
    net.add(longitude_deg, latitude_deg);
    net.add(longitude_deg, latitude_deg + (up > 0.5 ? -kStep_deg : kStep_deg));
    net.add(longitude_deg + kStep_deg, latitude_deg);
    raster.georeference.to_pixels(net.across, net.along, {west_deg + 0.5, south_deg + 0.5});
    const auto rate = [&](std::size_t to) {
      return std::hypot(net.across[to] - net.across[0], net.along[to] - net.along[0]) / kStep_deg;
    };
    if (std::isfinite(rate(1))) rates.north = std::max(rates.north, rate(1));
    if (std::isfinite(rate(2))) rates.east = std::max(rates.east, rate(2));
  }
  return rates;
}

// Cells of a net of the raster's own pixels, with the share of the net in each.
std::map<std::pair<int, int>, double> cells_of_pixels(const Raster& raster) {
  constexpr int kSteps = 64;
  Net net;
  for (int down = 0; down <= kSteps; ++down)
    for (int right = 0; right <= kSteps; ++right)
      net.add(0.5 + (raster.columns - 1.0) * right / kSteps, 0.5 + (raster.rows - 1.0) * down / kSteps);
  raster.georeference.to_earth(net.across, net.along);
  std::map<std::pair<int, int>, double> cells;
  for (std::size_t i = 0; i < net.across.size(); ++i)
    if (std::isfinite(net.across[i]))
      cells[{std::clamp(static_cast<int>(std::floor(net.along[i])), -90, 89),
             wrapped(static_cast<int>(std::floor(net.across[i])))}] += 1.0 / static_cast<double>(net.across.size());
  return cells;
}

// [deg^2] of a raster that is smaller than a net over cells would find.
double area_of(const Raster& raster, const Rates& rates) {
  return static_cast<double>(raster.columns) * raster.rows / std::max(1.0, rates.north * rates.east);
}

// Every cell within the bounds of those that pixels lie in, and one beyond: between the net's pixels lie more.
std::set<std::pair<int, int>> candidates(const std::map<std::pair<int, int>, double>& sure) {
  int south = 90, north = -90;
  std::set<int> wests;
  for (const auto& [place, share] : sure) {
    south = std::min(south, place.first);
    north = std::max(north, place.first);
    for (const int beside : {-1, 0, 1}) wests.insert(wrapped(place.second + beside));
  }
  // Near a pole, and in a raster so large, the net steps over cells.
  if (south <= -80 || north >= 79 || wests.size() > 60)
    for (int west = -180; west < 180; ++west) wests.insert(west);
  std::set<std::pair<int, int>> found;
  for (int row = std::max(-90, south - 1); row <= std::min(89, north + 1); ++row)
    for (const int west : wests) found.emplace(row, west);
  return found;
}

std::vector<RasterCell> projected_cells(const Raster& raster) {
  const auto sure = cells_of_pixels(raster);
  std::vector<RasterCell> cells;
  for (const auto& place : candidates(sure)) {
    const auto found = sure.find(place);
    const double share = share_inside(raster, place.first, place.second);
    if (found == sure.end() && share <= 0.0) continue;
    const Rates rates = rates_in(raster, place.first, place.second);
    if (!(rates.north > 0.0) || !(rates.east > 0.0)) continue;
    const double small = found == sure.end() ? 0.0 : std::min(1.0, found->second * area_of(raster, rates));
    cells.push_back({place.first, place.second, share > 0.0 ? share : small, twice_as_fine(rates.north),
                     twice_as_fine(rates.east)});
  }
  return cells;
}

}  // namespace

std::vector<RasterCell> cells_of(const Raster& raster) {
  return raster.georeference.is_plain() ? plain_cells(raster) : projected_cells(raster);
}

bool posts_are_pixels(const Raster& raster, int posts_per_degree_north, int posts_per_degree_east) {
  if (!raster.georeference.is_plain()) return false;
  const Extent extent = extent_of(raster);
  return aligned(extent.south_deg, extent.pixel_north_deg) && aligned(extent.west_deg, extent.pixel_east_deg) &&
         std::lround(1.0 / extent.pixel_north_deg) == posts_per_degree_north &&
         std::lround(1.0 / extent.pixel_east_deg) == posts_per_degree_east;
}

}  // namespace yars::model::terrain::gdal

#include "model/terrain/cell_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lib/failure/require.hpp"
#include "model/terrain/code_look_up.hpp"
#include "model/terrain/interpolation.hpp"
#include "model/terrain/look_up.hpp"

namespace yars::model::terrain {

namespace {

constexpr Surface kNothing{std::numeric_limits<double>::quiet_NaN(), 0.0};
constexpr double kMetresPerDegree = 111'000.0;  // about
constexpr float kMostTurns = 1.0e6F;            // [deg] of longitude: more is no place, but must not overflow

// Where its meridians are closest.
double spacing_m(const Cell& cell) {
  const int south_deg = cell.place().south_deg;
  const double farthest_deg = std::max(std::abs(south_deg), std::abs(south_deg + 1));
  const double east_deg = std::max(0.0, std::cos(farthest_deg * geo::kRadiansPerDegree)) / (cell.columns() - 1);
  return kMetresPerDegree * std::min(1.0 / (cell.rows() - 1), east_deg);
}

}  // namespace

CellView::CellView(std::uint64_t generation, Absence elsewhere, int detail) : generation_(generation), detail_(detail) {
  table_.fill(static_cast<std::uint16_t>(elsewhere));
}

void CellView::set_absence(CellPlace place, Absence absence) {
  table_[slot_of(place)] = static_cast<std::uint16_t>(absence);
}

void CellView::add(TerrainCell cell) {
  table_[slot_of(cell.heights->place())] = static_cast<std::uint16_t>(kFirstCell + cells_.size());
  resident_bytes_ += cell.heights->bytes();
  const double posts_m = spacing_m(*cell.heights);
  post_spacing_m_ = cells_.empty() ? posts_m : std::min(post_spacing_m_, posts_m);
  if (cell.peaks) {
    resident_bytes_ += cell.peaks->bytes();
    has_peaks_ = true;
  }
  if (cell.culture) {
    resident_bytes_ += cell.culture->bytes();
    has_materials_ = true;
  }
  cells_.push_back(std::move(cell));
}

Surface CellView::surface_at(geo::GeoPoint place, Interpolation interpolation) const {
  if (!std::isfinite(place.latitude_deg) || !std::isfinite(place.longitude_deg)) return kNothing;
  const CellPlace corner = cell_holding(place);
  const std::uint16_t what = entry(corner);
  if (what == static_cast<std::uint16_t>(Absence::sea)) return {0.0, 1.0};
  if (what < kFirstCell) {
    Surface nothing = kNothing;
    nothing.loaded = what != static_cast<std::uint16_t>(Absence::not_loaded);
    return nothing;
  }
  const TerrainCell& cell = cells_[what - kFirstCell];
  const double north_deg = place.latitude_deg - corner.south_deg;
  const double east_deg = geo::wrapped_degrees(place.longitude_deg) - corner.west_deg;
  Surface surface = interpolate(*cell.heights, north_deg, east_deg, interpolation);
  if (cell.peaks) {
    // Between peaks a cubic could dip below the ground that they stand for.
    const bool nearest = interpolation == Interpolation::nearest;
    surface.peak_m =
        interpolate(*cell.peaks, north_deg, east_deg, nearest ? Interpolation::nearest : Interpolation::bilinear)
            .elevation_m;
  }
  if (cell.culture) surface.material = cell.culture->nearest(north_deg, east_deg);
  return surface;
}

CellView::Run CellView::run_at(const PlaceRun& places, std::size_t first) const {
  Run run;
  run.first = first;
  const float cells_north = places.cells_north[first];
  const float cells_east = places.cells_east[first];
  if (!(std::abs(cells_north) <= kMostTurns) || !(std::abs(cells_east) <= kMostTurns)) return run;
  const int south = places.corner.south_deg + static_cast<int>(cells_north);
  const int west = places.corner.west_deg + 180 + static_cast<int>(cells_east);
  run.beyond_pole = south < -90 || south > 89;
  run.what =
      entry({std::clamp(south, -90, 89), (west % kCellColumns + kCellColumns) % kCellColumns - kCellColumns / 2});
  run.places =
      look_up::places_alike(&places.cells_north[first], &places.cells_east[first], places.cells_north.size() - first);
  return run;
}

// What vectors do not do: cubic, and places on a pole, which belong to the cell before it.
void CellView::look_up_singly(const Run& run, const PlaceRun& places, Interpolation interpolation,
                              const SurfaceRun& found) const {
  for (std::size_t i = run.first; i < run.first + run.places; ++i) {
    const Surface surface = surface_at(place_of(places, i), interpolation);
    found.elevation_m[i] = static_cast<float>(surface.elevation_m);
    found.water[i] = static_cast<float>(surface.water);
  }
}

void CellView::look_up_run(const Run& run, const PlaceRun& places, Interpolation interpolation,
                           const SurfaceRun& found) const {
  const TerrainCell& cell = cells_[run.what - kFirstCell];
  const auto grid_of = [](const Cell& grid) {
    return look_up::Grid{&grid.blocks(),   grid.rows(),          grid.columns(),
                         grid.voids() > 0, grid.sea_posts() > 0, static_cast<float>(grid.unit_m())};
  };
  const float* const north_deg = &places.north_deg[run.first];
  const float* const east_deg = &places.east_deg[run.first];
  const bool nearest = interpolation == Interpolation::nearest;
  if (interpolation == Interpolation::cubic || run.beyond_pole)
    look_up_singly(run, places, interpolation, found);
  else
    look_up::heights(grid_of(*cell.heights), north_deg, east_deg, run.places, nearest, &found.elevation_m[run.first],
                     &found.water[run.first]);
  if (!found.material.empty() && cell.culture)
    look_up::codes(*cell.culture, north_deg, east_deg, run.places, &found.material[run.first]);
  if (found.peak_m.empty()) return;
  if (cell.peaks)
    look_up::heights(grid_of(*cell.peaks), north_deg, east_deg, run.places, nearest, &found.peak_m[run.first], nullptr);
  else
    std::copy_n(&found.elevation_m[run.first], run.places, &found.peak_m[run.first]);
}

std::size_t CellView::surfaces(const PlaceRun& places, Interpolation interpolation, const SurfaceRun& found) const {
  const std::size_t count = places.north_deg.size();
  YARS_REQUIRE(places.east_deg.size(), ==, count);
  YARS_REQUIRE(places.cells_north.size(), ==, count);
  YARS_REQUIRE(places.cells_east.size(), ==, count);
  YARS_REQUIRE(found.elevation_m.size(), ==, count);
  YARS_REQUIRE(found.water.size(), ==, count);
  std::size_t not_loaded = 0;
  for (std::size_t first = 0; first < count;) {
    const Run run = run_at(places, first);
    if (!found.material.empty()) std::fill_n(&found.material[first], run.places, 0);
    if (run.what >= kFirstCell) {
      look_up_run(run, places, interpolation, found);
    } else {
      const bool sea = run.what == static_cast<std::uint16_t>(Absence::sea);
      const float height_m = sea ? 0.0F : std::numeric_limits<float>::quiet_NaN();
      std::fill_n(&found.elevation_m[first], run.places, height_m);
      std::fill_n(&found.water[first], run.places, sea ? 1.0F : 0.0F);
      if (!found.peak_m.empty()) std::fill_n(&found.peak_m[first], run.places, height_m);
      if (run.what == static_cast<std::uint16_t>(Absence::not_loaded)) not_loaded += run.places;
    }
    first += run.places;
  }
  return not_loaded;
}

}  // namespace yars::model::terrain

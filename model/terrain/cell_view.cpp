#include "model/terrain/cell_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lib/failure/require.hpp"
#include "model/terrain/bilinear.hpp"

namespace yars::model::terrain {

namespace {

bool finite(double latitude_deg, double longitude_deg) {
  return std::isfinite(latitude_deg) && std::isfinite(longitude_deg);
}

}  // namespace

CellView::CellView(std::uint64_t generation, Absence elsewhere) : generation_(generation) {
  table_.fill(static_cast<std::uint16_t>(elsewhere));
}

void CellView::set_absence(CellPlace place, Absence absence) {
  table_[slot_of(place)] = static_cast<std::uint16_t>(absence);
}

void CellView::add(std::shared_ptr<const Cell> cell) {
  table_[slot_of(cell->place())] = static_cast<std::uint16_t>(kFirstCell + cells_.size());
  resident_bytes_ += cell->bytes();
  cells_.push_back(std::move(cell));
}

Surface CellView::surface_at(geo::GeoPoint place) const {
  constexpr Surface kVoid{std::numeric_limits<double>::quiet_NaN(), 0.0, 0};
  if (!finite(place.latitude_deg, place.longitude_deg)) return kVoid;
  const CellPlace corner = cell_holding(place);
  const std::uint16_t what = entry(corner);
  if (what == static_cast<std::uint16_t>(Absence::sea)) return {0.0, 1.0, 0};
  if (what < kFirstCell) return kVoid;
  return interpolate(*cells_[what - kFirstCell], place.latitude_deg - corner.south_deg,
                     geo::wrapped_degrees(place.longitude_deg) - corner.west_deg);
}

CellView::Run CellView::run_at(std::span<const double> latitude_deg, std::span<const double> longitude_deg) const {
  Run run;
  if (!finite(latitude_deg[0], longitude_deg[0])) return run;
  const CellPlace corner = cell_holding({latitude_deg[0], longitude_deg[0]});
  run.what = entry(corner);
  // Whole turns that bring this run's longitudes beside the cell.
  run.shift_deg = 360.0 * std::round((corner.west_deg + 0.5 - longitude_deg[0]) / 360.0);
  const double west_deg = corner.west_deg - run.shift_deg;
  while (run.places < latitude_deg.size() && latitude_deg[run.places] >= corner.south_deg &&
         latitude_deg[run.places] < corner.south_deg + 1 && longitude_deg[run.places] >= west_deg &&
         longitude_deg[run.places] < west_deg + 1)
    ++run.places;
  return run;
}

std::size_t CellView::elevations(std::span<const double> latitude_deg, std::span<const double> longitude_deg,
                                 std::span<float> elevation_m, std::span<float> water) const {
  const std::size_t places = latitude_deg.size();
  YARS_REQUIRE(longitude_deg.size(), ==, places);
  YARS_REQUIRE(elevation_m.size(), ==, places);
  YARS_REQUIRE(water.size(), ==, places);
  std::size_t not_loaded = 0;
  for (std::size_t start = 0; start < places;) {
    const Run run = run_at(latitude_deg.subspan(start), longitude_deg.subspan(start));
    const std::span<float> heights_m = elevation_m.subspan(start, run.places);
    const std::span<float> shares = water.subspan(start, run.places);
    if (run.what >= kFirstCell) {
      interpolate_run(*cells_[run.what - kFirstCell], run.shift_deg, latitude_deg.subspan(start, run.places),
                      longitude_deg.subspan(start, run.places), heights_m, shares);
    } else {
      const bool sea = run.what == static_cast<std::uint16_t>(Absence::sea);
      std::fill(heights_m.begin(), heights_m.end(), sea ? 0.0F : std::numeric_limits<float>::quiet_NaN());
      std::fill(shares.begin(), shares.end(), sea ? 1.0F : 0.0F);
      if (run.what == static_cast<std::uint16_t>(Absence::not_loaded)) not_loaded += run.places;
    }
    start += run.places;
  }
  return not_loaded;
}

}  // namespace yars::model::terrain

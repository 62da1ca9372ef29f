#include "model/hrm/patch_geometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "lib/geo/geodesy.hpp"
#include "lib/radar/fidelity.hpp"

namespace yars::model::hrm {

PatchGeometry::PatchGeometry(const PatchOrder& order, const physics::GeometryParameters& parameters, double elevation_m)
    : apex_(order.apex),
      altitude_m_(order.altitude.metres()),
      plane_msl_m_(elevation_m),
      distance_m_(0.0),
      window_m_(order.window.metres()),
      earth_(0.0),
      earth_above_plane_(0.0) {
  const geo::GeodesicInverse geodesic = geo::geodesic_inverse(order.apex, order.centre);
  distance_m_ = geodesic.distance.metres();
  up_ = geodesic.azimuth_at_start;
  earth_ = physics::effective_earth(parameters, apex_, order.altitude, up_);
  earth_above_plane_ = earth_.above(plane_msl_m_);
  const std::array<float, 1> reach_m{static_cast<float>(distance_m_ + window_m_)};
  series_ = terrain::sight_series({altitude_m_, earth_.curvature(), earth_.lift().of_elevation, reach_m});
}

MapPoint PatchGeometry::point_of(geo::GeoPoint position) const {
  const geo::PlanePoint point = geo::AzimuthalEquidistant(apex_, up_).plane_from_geodetic(position);
  return {point.x_m, point.y_m - distance_m_};
}

geo::GeoPoint PatchGeometry::position_of(MapPoint point) const {
  return geo::AzimuthalEquidistant(apex_, up_).geodetic_from_plane({point.right_m, point.up_m + distance_m_});
}

double PatchGeometry::height_on_sight_m(double distance_m, double tangent) const {
  return sight_line(distance_m).height_at(tangent, plane_msl_m_);
}

PatchGeometry::SightLine PatchGeometry::sight_line(double distance_m) const {
  if (!earth_.traced()) {
    const auto [above_m, chord_m, sine, cosine] = series_.at(earth_.curvature(), distance_m);
    return {above_m, chord_m, sine, cosine, 0.0};
  }
  constexpr double kStep_m = 1000.0;  // of height, for the slope and the bow of the lift at the map plane
  const auto lift_m = [&](double height_m) {
    return earth_.elevation_lift_m(altitude_m_, distance_m, plane_msl_m_ + height_m);
  };
  const double low_m = lift_m(-kStep_m), plane_m = lift_m(0.0), high_m = lift_m(kStep_m);
  const double per_metre = (high_m - low_m) / (2.0 * kStep_m);
  const double angle_rad = distance_m * earth_.curvature();
  const double sine = std::sin(angle_rad);
  return {altitude_m_ + earth_.drop_m(distance_m) - plane_m + per_metre * plane_msl_m_, earth_.radius_m() * sine, sine,
          std::cos(angle_rad) + per_metre, (high_m + low_m - 2.0 * plane_m) / (2.0 * kStep_m * kStep_m)};
}

PatchGeometry::PlaneSight PatchGeometry::plane_sight(double distance_m) const {
  const SightLine line = sight_line(distance_m);
  return {line.above_m / line.cosine - plane_msl_m_, distance_m / line.cosine};
}

double PatchGeometry::slant_range_m() const {
  return std::hypot(distance_m_, altitude_m_ - plane_msl_m_ + earth_.drop_m(distance_m_));
}

double PatchGeometry::sin_grazing() const {
  return earth_above_plane_.sight(altitude_m_ - plane_msl_m_, distance_m_, 0.0).sin_grazing;
}

double laid_over_m(double distance_m, double height_m, double above_level_m) {
  const double square = distance_m * distance_m + height_m * (height_m - 2.0 * above_level_m);
  return square > 0.0 ? std::sqrt(square) : 0.0;
}

namespace {
// Limit of each margin [window sides]. Without it, high mountains close to the aircraft would make the grid very large.
constexpr double kMaxMarginWindows = 4.0;
}  // namespace

PolarGrid make_polar_grid(const PatchGeometry& geometry, int pixels, int cells, const PolarMargins& margins) {
  const double half_m = 0.5 * geometry.window_m();
  const double centre_m = geometry.distance_m();
  PolarGrid grid;
  grid.centre_distance_m = centre_m;
  grid.spacing_m = geometry.window_m() / (pixels * cells);
  grid.tangent_step = grid.spacing_m / centre_m;
  // The near corners of the window have the largest tangent. Two further columns on each side serve the interpolation.
  const double nearest_m = std::max(centre_m - half_m, grid.spacing_m);
  const double widest = half_m / nearest_m + 2.0 * grid.tangent_step;
  const int columns = static_cast<int>(std::ceil(2.0 * widest / grid.tangent_step));
  grid.columns = (columns + kStripColumns - 1) / kStripColumns * kStripColumns;
  grid.first_tangent = -0.5 * (grid.columns - 1) * grid.tangent_step;

  const double max_margin_m = kMaxMarginWindows * geometry.window_m();
  const double near_m =
      std::max(nearest_m - 3.0 * grid.spacing_m - std::min(margins.near_m, max_margin_m), grid.spacing_m);
  const double far_m =
      std::hypot(centre_m + half_m, half_m) + 2.0 * grid.spacing_m + std::min(margins.far_m, max_margin_m);
  // On the line of sight to the centre, rows lie on pixel centres. Rows between pixel centres would blur the picture
  // by interpolation. `offset` [rows]: distance of the pixel centres from the map's centre, modulo 1.
  const double offset = std::fmod(0.5 * cells * (pixels % 2 == 0 ? 1.0 : 0.0), 1.0);
  const double before = std::floor((centre_m - near_m) / grid.spacing_m - offset) + offset;
  grid.first_distance_m = centre_m - before * grid.spacing_m;
  grid.rows = static_cast<int>(std::ceil((far_m - grid.first_distance_m) / grid.spacing_m)) + 1;
  grid.end_strip = grid.strips();
  return grid;
}

std::vector<int> sectors_of(const PolarGrid& grid, std::size_t points) {
  constexpr int kOverlap = 2;  // strips of a sector that its neighbours draw
  const int strips = grid.strips();
  const auto held = static_cast<int>(std::min(points / grid.strip_size(), static_cast<std::size_t>(strips)));
  if (held >= strips) return {0, strips};
  const int most = std::max(held - kOverlap, 1);
  const int sectors = (strips + most - 1) / most;
  std::vector<int> first;
  for (int sector = 0; sector <= sectors; ++sector) first.push_back(sector * strips / sectors);
  return first;
}

namespace {
constexpr double kPathDetail_m = 60.0;  // [m] minimum sample spacing that selects the terrain detail of the path
constexpr int kReliefSteps = 24;        // intervals between height samples, in each direction
constexpr double kReliefReserve = 1.2;  // factor on sampled heights, for ground between the samples
// Lower bound of the sine of the grazing angle (1.1 degrees). It limits a shadow to 50 times the object's height.
constexpr double kMinSine = 0.02;

constexpr double kCellsPerNode = 2.0;    // [grid cells] node spacing of the smoothed ground
constexpr double kPixelsPerPost = 3.0;   // [pixels] closer posts need no smoothing: such small facets are invisible
constexpr int kReferenceParts = 10;      // minimum number of nodes per post interval, for the algorithm `reference`
constexpr int kOutlineSteps = 8;         // intervals between outline positions along each edge of the polar grid
constexpr double kOutlineMargin = 0.01;  // margin about the bounding box of the polar grid [fraction of its size]

// Bounding box of a tile in latitude and longitude.
terrain::GeoBox box_of(const scene::Tile& tile) {
  const double cos_latitude = std::max(std::cos(tile.origin.latitude_deg * geo::kRadiansPerDegree), 0.01);
  const auto north = [&](float metres) {
    return tile.origin.latitude_deg + static_cast<double>(metres) / geo::kMinMetresPerDegree;
  };
  const auto east = [&](float metres) {
    return tile.origin.longitude_deg + static_cast<double>(metres) / (geo::kMinMetresPerDegree * cos_latitude);
  };
  return {north(tile.bounds.north_min_m), north(tile.bounds.north_max_m), east(tile.bounds.east_min_m),
          east(tile.bounds.east_max_m)};
}

// Range of heights [m] above the map plane in and about the window.
struct Relief {
  double lowest_m = 0.0;
  double highest_m = 0.0;
};

// Extends `relief` by the height samples of the sample columns [first, last). The samples cover a square with sides of
// 1.5 windows.
void widen(const PatchGeometry& geometry, const terrain::TerrainView& ground, int first, int last, Relief& relief) {
  const double half_m = 0.75 * geometry.window_m();
  for (int i = first; i < last; ++i) {
    for (int j = 0; j <= kReliefSteps; ++j) {
      const MapPoint point{half_m * (2.0 * i / kReliefSteps - 1.0), half_m * (2.0 * j / kReliefSteps - 1.0)};
      if (point.up_m + geometry.distance_m() <= 0.0) continue;
      const double height_m = ground.elevation_m(geometry.position_of(point)) - geometry.plane_msl_m();
      if (std::isnan(height_m)) continue;
      relief.lowest_m = std::min(relief.lowest_m, kReliefReserve * height_m);
      relief.highest_m = std::max(relief.highest_m, kReliefReserve * height_m);
    }
  }
}

// Relief of ground and scene tiles.
Relief relief_of(const PatchGeometry& geometry, const terrain::TerrainView& ground,
                 const std::vector<const scene::Tile*>& tiles, const parallel::Executor& executor) {
  std::vector<Relief> reliefs(executor.threads);
  parallel::parallel_for(executor, kReliefSteps + 1, 1, [&](int first, int last, std::size_t thread) {
    widen(geometry, ground, first, last, reliefs[thread]);
  });
  Relief relief;
  for (const Relief& part : reliefs) {
    relief.lowest_m = std::min(relief.lowest_m, part.lowest_m);
    relief.highest_m = std::max(relief.highest_m, part.highest_m);
  }
  for (const scene::Tile* tile : tiles) {
    const double top_m = tile->zero_msl_m + static_cast<double>(tile->bounds.up_max_m) - geometry.plane_msl_m();
    relief.highest_m = std::max(relief.highest_m, top_m);
  }
  return relief;
}

// Greatest distance [m] before the window's near edge from which a tile casts shadow across that edge. Tiles too low to
// extend the margin are skipped first, because geometry.point_of() is slow: it computes a geodesic. `tangent`: tangent
// of the grazing angle.
double shadow_margin_m(const PatchGeometry& geometry, const std::vector<const scene::Tile*>& tiles, double tangent) {
  const double half_m = 0.5 * geometry.window_m();
  double margin_m = 0.0;
  for (const scene::Tile* tile : tiles) {
    const scene::Bounds& bounds = tile->bounds;
    const double shadow_m = static_cast<double>(bounds.up_max_m - bounds.up_min_m) / tangent;
    if (!(shadow_m > margin_m)) continue;
    const double extent_m = std::hypot(static_cast<double>(std::max(-bounds.east_min_m, bounds.east_max_m)),
                                       static_cast<double>(std::max(-bounds.north_min_m, bounds.north_max_m)));
    const MapPoint origin = geometry.point_of(tile->origin);
    const double before_m =
        geometry.distance_m() - half_m - std::hypot(origin.right_m, origin.up_m + geometry.distance_m());
    if (before_m - extent_m > shadow_m) continue;
    // Before the window, the polar grid is no wider than the window.
    if (std::abs(origin.right_m) - extent_m > half_m) continue;
    margin_m = std::max(margin_m, std::min(shadow_m, before_m + extent_m));
  }
  return margin_m;
}
}  // namespace

PatchNeed patch_need(const PatchOrder& order, const radar::Fidelity& fidelity) {
  const geo::GeodesicInverse to_centre = geo::geodesic_inverse(order.apex, order.centre);
  const double pixel_m = order.window.metres() / std::max(fidelity.map_size, 1);
  const double posts = fidelity.posts_per_sample;
  const auto detail = [&](double sample_m) { return posts > 0.0 ? terrain::detail_for(sample_m / posts) : 0; };
  PatchNeed need;
  // The radius covers the window's corners, and ground beyond them that is laid over into the picture.
  need.window = {order.centre, 1.5 * order.window.metres(), detail(pixel_m)};
  const geo::GeodesicRay geodesic(order.apex, to_centre.azimuth_at_start);
  const double half_way_m = 0.5 * to_centre.distance.metres();
  need.path = {geodesic.position(geo::Length::metres(half_way_m)), half_way_m + 0.5 * order.window.metres(),
               detail(std::max(pixel_m, kPathDetail_m))};
  return need;
}

terrain::SmoothParameters smoothing_parameters(const PatchGeometry& geometry, const PolarGrid& grid,
                                               const radar::Fidelity& fidelity,
                                               const std::vector<const scene::Tile*>& tiles) {
  const geo::GeoPoint middle = geometry.position_of({});
  terrain::SmoothParameters smoothing{{90.0, -90.0, middle.longitude_deg + 180.0, middle.longitude_deg - 180.0},
                                      kCellsPerNode * grid.spacing_m,
                                      kPixelsPerPost * geometry.window_m() / std::max(fidelity.map_size, 1)};
  if (fidelity.algorithm == radar::Algorithm::reference) smoothing.min_parts = kReferenceParts;
  terrain::GeoBox& box = smoothing.box;
  // Between the sampled positions the outline of the polar grid is nearly straight. The margin covers its curvature.
  for (int i = 0; i <= kOutlineSteps; ++i) {
    const double fraction = static_cast<double>(i) / kOutlineSteps;
    for (const double column : {0.0, fraction * (grid.columns - 1), grid.columns - 1.0})
      for (const double row : {0.0, fraction * (grid.rows - 1), grid.rows - 1.0}) {
        const double tangent = grid.tangent(column);
        const double ahead_m = grid.distance_m(row) / std::sqrt(1.0 + tangent * tangent);
        const geo::GeoPoint position = geometry.position_of({tangent * ahead_m, ahead_m - geometry.distance_m()});
        const double east_deg =
            middle.longitude_deg + geo::wrapped_degrees(position.longitude_deg - middle.longitude_deg);
        box = {std::min(box.south_deg, position.latitude_deg), std::max(box.north_deg, position.latitude_deg),
               std::min(box.west_deg, east_deg), std::max(box.east_deg, east_deg)};
      }
  }
  const double margin_north_deg = kOutlineMargin * (box.north_deg - box.south_deg);
  const double margin_east_deg = kOutlineMargin * (box.east_deg - box.west_deg);
  box = {box.south_deg - margin_north_deg, box.north_deg + margin_north_deg, box.west_deg - margin_east_deg,
         box.east_deg + margin_east_deg};
  for (const scene::Tile* tile : tiles) smoothing.bilinear_boxes.push_back(box_of(*tile));
  return smoothing;
}

PolarMargins polar_margins(const PatchGeometry& geometry, const terrain::TerrainView& ground,
                           const std::vector<const scene::Tile*>& tiles, const parallel::Executor& executor) {
  const Relief relief = relief_of(geometry, ground, tiles, executor);
  const double sine = std::max(geometry.sin_grazing(), kMinSine);
  const double tangent = sine / std::sqrt(std::max(1.0 - sine * sine, 1e-6));
  // Layover moves ground below the map plane away from the radar, into the window across the near edge. It moves ground
  // above the plane nearer, across the far edge. Objects before the near edge cast shadow into the window.
  return {std::max(-relief.lowest_m * tangent, shadow_margin_m(geometry, tiles, tangent)), relief.highest_m * tangent};
}

}  // namespace yars::model::hrm

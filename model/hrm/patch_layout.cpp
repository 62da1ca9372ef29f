#include "model/hrm/patch_layout.hpp"

#include <algorithm>
#include <cmath>

namespace yars::model::hrm {

namespace {
// Terrain for the way is at most this much coarser than a sixtieth of it.
constexpr double kPathDetail_m = 60.0;
constexpr int kReliefSteps = 24;        // places along an edge of the window at which the relief is looked at
constexpr double kReliefReserve = 1.2;  // what lies between them may stand out so much more
constexpr double kLeastSine = 0.02;     // shadows grow beyond any margin below a degree

// The span of heights [m] above the map plane in and about the window.
struct Relief {
  double lowest_m = 0.0;
  double highest_m = 0.0;
};

void widen(const PatchGeometry& geometry, const terrain::TerrainView& ground, int first, int last, Relief& relief) {
  const double reach_m = 0.75 * geometry.window_m();
  for (int i = first; i < last; ++i) {
    for (int j = 0; j <= kReliefSteps; ++j) {
      const MapPoint point{reach_m * (2.0 * i / kReliefSteps - 1.0), reach_m * (2.0 * j / kReliefSteps - 1.0)};
      if (point.up_m + geometry.distance_m() <= 0.0) continue;
      const double height_m = ground.elevation_m(geometry.place_of(point)) - geometry.plane_msl_m();
      if (std::isnan(height_m)) continue;
      relief.lowest_m = std::min(relief.lowest_m, kReliefReserve * height_m);
      relief.highest_m = std::max(relief.highest_m, kReliefReserve * height_m);
    }
  }
}

Relief relief_of(const PatchGeometry& geometry, const terrain::TerrainView& ground,
                 const std::vector<const scene::Tile*>& tiles, const Crew& crew) {
  std::vector<Relief> reliefs(crew.threads);
  share_out(crew, kReliefSteps + 1, 1,
            [&](int first, int last, std::size_t thread) { widen(geometry, ground, first, last, reliefs[thread]); });
  Relief relief;
  for (const Relief& part : reliefs) {
    relief.lowest_m = std::min(relief.lowest_m, part.lowest_m);
    relief.highest_m = std::max(relief.highest_m, part.highest_m);
  }
  for (const scene::Tile* tile : tiles) {
    const double top_m = tile->zero_msl_m + static_cast<double>(tile->bounds.up_most_m) - geometry.plane_msl_m();
    relief.highest_m = std::max(relief.highest_m, top_m);
  }
  return relief;
}

// How far before the near edge the things of the scene stand whose shadows reach over it, at most [m]. A shadow is as
// long as its tile is tall, over the tangent; most tiles are too low to be asked where they lie.
double shading_m(const PatchGeometry& geometry, const std::vector<const scene::Tile*>& tiles, double tangent) {
  const double half_m = 0.5 * geometry.window_m();
  double margin_m = 0.0;
  for (const scene::Tile* tile : tiles) {
    const scene::Bounds& bounds = tile->bounds;
    const double shadow_m = static_cast<double>(bounds.up_most_m - bounds.up_least_m) / tangent;
    if (!(shadow_m > margin_m)) continue;
    const double reach_m = std::hypot(static_cast<double>(std::max(-bounds.east_least_m, bounds.east_most_m)),
                                      static_cast<double>(std::max(-bounds.north_least_m, bounds.north_most_m)));
    const MapPoint origin = geometry.point_of(tile->origin);
    const double before_m =
        geometry.distance_m() - half_m - std::hypot(origin.right_m, origin.up_m + geometry.distance_m());
    if (before_m - reach_m > shadow_m) continue;
    // The fan is no wider there than the window.
    if (std::abs(origin.right_m) - reach_m > half_m) continue;
    margin_m = std::max(margin_m, std::min(shadow_m, before_m + reach_m));
  }
  return margin_m;
}
}  // namespace

PatchNeed patch_need(const PatchOrder& order, int pixels) {
  const geo::GeodesicInverse to_centre = geo::geodesic_inverse(order.apex, order.centre);
  const double pixel_m = order.window.metres() / pixels;
  PatchNeed need;
  // The corners, and what beyond them is laid over into the picture.
  need.window = {order.centre, 1.5 * order.window.metres(), terrain::detail_for(pixel_m)};
  const geo::GeodesicRay way(order.apex, to_centre.azimuth_at_start);
  const double half_way_m = 0.5 * to_centre.distance.metres();
  need.path = {way.position(geo::Length::metres(half_way_m)), half_way_m + 0.5 * order.window.metres(),
               terrain::detail_for(std::max(pixel_m, kPathDetail_m))};
  return need;
}

FanMargins fan_margins(const PatchGeometry& geometry, const terrain::TerrainView& ground,
                       const std::vector<const scene::Tile*>& tiles, const Crew& crew) {
  const Relief relief = relief_of(geometry, ground, tiles, crew);
  const double sine = std::max(geometry.sin_grazing(), kLeastSine);
  const double tangent = sine / std::sqrt(std::max(1.0 - sine * sine, 1e-6));
  // Low ground is laid over outwards and high ground inwards; a thing before the near edge shades into the window.
  return {std::max(-relief.lowest_m * tangent, shading_m(geometry, tiles, tangent)), relief.highest_m * tangent};
}

}  // namespace yars::model::hrm

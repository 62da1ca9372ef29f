// Terrain of simple shapes: heights [m MSL] whose radar picture is known in closed form. A shape lies on an axis from
// an origin: `along` [m] on the axis, `across` [m] to its right. Projection: azimuthal equidistant, so that ranges and
// bearings from the origin are exact.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lib/geo/geodesy.hpp"
#include "model/terrain/sampling/analytic_terrain.hpp"

namespace yars::model::terrain {

struct TerrainAxis {
  geo::GeoPoint origin;
  geo::Bearing direction;
  // Plane coordinates of a point. x: across, y: along.
  geo::PlanePoint position(geo::GeoPoint point) const {
    return geo::AzimuthalEquidistant(origin, direction).plane_from_geodetic(point);
  }
};

// A shape whose height depends only on the distance along the axis.
template <class Profile>
AnalyticTerrain::Height along(TerrainAxis axis, Profile profile) {
  return [axis, profile](geo::GeoPoint point) { return profile(axis.position(point).y_m); };
}

inline AnalyticTerrain::Height flat(double height_m) {
  return [height_m](geo::GeoPoint) { return height_m; };
}

// Height `height_m` at the origin; `slope` is the rise per metre along the axis.
inline AnalyticTerrain::Height plane(TerrainAxis axis, double height_m, double slope) {
  return along(axis, [=](double along_m) { return height_m + slope * along_m; });
}

// Sea level up to `start_m` along the axis; from there it rises with `slope` without end.
inline AnalyticTerrain::Height wedge(TerrainAxis axis, double start_m, double slope) {
  return along(axis, [=](double along_m) { return slope * std::max(0.0, along_m - start_m); });
}

// `height_m` between two distances along the axis, sea level elsewhere.
inline AnalyticTerrain::Height plateau(TerrainAxis axis, double start_m, double end_m, double height_m) {
  return along(axis, [=](double along_m) { return along_m >= start_m && along_m < end_m ? height_m : 0.0; });
}

// A roof across the axis. Its crest lies at `crest_m` along the axis and is `height_m` high. Both sides fall to sea
// level over `half_width_m`.
inline AnalyticTerrain::Height ridge(TerrainAxis axis, double crest_m, double half_width_m, double height_m) {
  return along(
      axis, [=](double along_m) { return height_m * std::max(0.0, 1.0 - std::abs(along_m - crest_m) / half_width_m); });
}

// A vertical step at `wall_m` along the axis: the ground is `near_m` high before it and `far_m` high behind it.
inline AnalyticTerrain::Height step_wall(TerrainAxis axis, double wall_m, double near_m, double far_m) {
  return along(axis, [=](double along_m) { return along_m < wall_m ? near_m : far_m; });
}

// Sine hills between 0 and 2 * amplitude_m, with one crest per wavelength along and across the axis.
inline AnalyticTerrain::Height sine_hills(TerrainAxis axis, double amplitude_m, double wavelength_m) {
  return [=](geo::GeoPoint point) {
    const geo::PlanePoint at = axis.position(point);
    const double rad_per_m = 2.0 * std::numbers::pi / wavelength_m;
    return amplitude_m * (1.0 + 0.5 * (std::sin(rad_per_m * at.y_m) + std::sin(rad_per_m * at.x_m)));
  };
}

}  // namespace yars::model::terrain

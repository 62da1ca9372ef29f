// Terrain of simple shapes: heights [m] MSL whose radar picture is known in closed form. Shapes are laid out about an
// origin: `along` [m] down the axis and `across` [m] right of it, by the azimuthal equidistant projection, so that
// ranges and bearings are exact as seen from the origin.
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
  // x: across, y: along.
  geo::PlanePoint position(geo::GeoPoint point) const {
    return geo::AzimuthalEquidistant(origin, direction).plane_from_geodetic(point);
  }
};

// A shape that depends on the distance along the axis alone.
template <class Profile>
AnalyticTerrain::Height along(TerrainAxis axis, Profile profile) {
  return [axis, profile](geo::GeoPoint point) { return profile(axis.position(point).y_m); };
}

inline AnalyticTerrain::Height flat(double height_m) {
  return [height_m](geo::GeoPoint) { return height_m; };
}

// Height at the origin plus slope (tangent) times the distance along the axis.
inline AnalyticTerrain::Height plane(TerrainAxis axis, double height_m, double slope) {
  return along(axis, [=](double along_m) { return height_m + slope * along_m; });
}

// Sea level to `start_m` along the axis, then rising with `slope` without end.
inline AnalyticTerrain::Height wedge(TerrainAxis axis, double start_m, double slope) {
  return along(axis, [=](double along_m) { return slope * std::max(0.0, along_m - start_m); });
}

// `height_m` between two distances along the axis, sea level elsewhere.
inline AnalyticTerrain::Height plateau(TerrainAxis axis, double start_m, double end_m, double height_m) {
  return along(axis, [=](double along_m) { return along_m >= start_m && along_m < end_m ? height_m : 0.0; });
}

// A roof across the axis: its crest at `crest_m` along, falling to sea level over `half_width_m` on both sides.
inline AnalyticTerrain::Height ridge(TerrainAxis axis, double crest_m, double half_width_m, double height_m) {
  return along(
      axis, [=](double along_m) { return height_m * std::max(0.0, 1.0 - std::abs(along_m - crest_m) / half_width_m); });
}

// `near_m` high up to `wall_m` along the axis, `far_m` high behind: a wall of no thickness.
inline AnalyticTerrain::Height step_wall(TerrainAxis axis, double wall_m, double near_m, double far_m) {
  return along(axis, [=](double along_m) { return along_m < wall_m ? near_m : far_m; });
}

// Sine hills between 0 and 2 * amplitude, one crest each wavelength both ways.
inline AnalyticTerrain::Height sine_hills(TerrainAxis axis, double amplitude_m, double wavelength_m) {
  return [=](geo::GeoPoint point) {
    const geo::PlanePoint at = axis.position(point);
    const double turn = 2.0 * std::numbers::pi / wavelength_m;
    return amplitude_m * (1.0 + 0.5 * (std::sin(turn * at.y_m) + std::sin(turn * at.x_m)));
  };
}

}  // namespace yars::model::terrain

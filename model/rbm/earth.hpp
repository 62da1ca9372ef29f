// The earth that a ray feels, and how a point on it is seen from the aircraft, in double precision. The geometry: a
// sphere of radius k R, R the ellipsoid's radius of curvature at the apex along the azimuth (or the mean radius, or
// none: flat). Distances over ground are kept, heights above mean sea level count as heights above that sphere.
// Source: docs/spec/physics.md#geometry.
#pragma once

#include <span>

#include "lib/geo/bearing.hpp"
#include "lib/geo/geodesic.hpp"
#include "lib/radar/configuration.hpp"
#include "model/terrain/terrain_view.hpp"

namespace yars::model::rbm {

struct Look;

// How the aircraft sees one point.
struct Sight {
  double tangent;        // of the elevation angle, against the aircraft's horizontal
  double elevation_rad;  // the same as an angle
  double slant_range_m;
  double sin_grazing;  // of the ray against the horizontal at the point; negative: from below
  double cos_grazing;
};

class EffectiveEarth {
 public:
  explicit EffectiveEarth(double radius_m) : radius_m_(radius_m) {}  // infinity: flat
  double radius_m() const { return radius_m_; }
  double curvature() const { return 1.0 / radius_m_; }  // [1/m] 0 = flat

  // How far the sphere falls below the horizontal plane at a distance over ground [m], exact.
  double drop_m(double distance_m) const;
  // A point at a distance over ground (> 0) and a height, from an altitude above the start [m].
  Sight sight(double altitude_m, double distance_m, double height_m) const;
  // Distance over ground at which ground of this height has this slant range; NaN where nothing is that near.
  double distance_at_slant_range(double altitude_m, double height_m, double slant_range_m) const;

 private:
  double radius_m_;
};

EffectiveEarth effective_earth(const radar::Fidelity& fidelity, geo::GeoPoint apex, geo::Bearing azimuth);

// Centre of each sample: distance over ground [m], ascending. Even in ground range, or even in slant range on ground
// as high as below the aircraft; there a sample nearer than the ground is NaN.
void sample_distances(const radar::Fidelity& fidelity, const EffectiveEarth& earth, const Look& look,
                      const terrain::TerrainView& terrain, std::span<double> distance_m);

}  // namespace yars::model::rbm

// Geometry of one sweep: beam and rays, effective earth, distances of the samples.
// Units: metres, radians. Heights and altitudes are above mean sea level.
// Frame: azimuths are true bearings. Elevation angles are positive above the horizontal at the aircraft.
// Accuracy: double precision, closed forms.
// Errors: NaN where a slant range has no ground distance. Inputs are not validated.
// Source: docs/spec/physics.md#geometry.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "lib/geo/geodesy.hpp"
#include "lib/geo/quantity.hpp"
#include "model/physics/radar_parameters.hpp"
#include "model/physics/refraction.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::physics {

// Interval of azimuth, relative to the middle of a beam, clockwise positive.
struct AzimuthInterval {
  double left_rad = 0.0, right_rad = 0.0;
};

// Azimuths at which a beam returns point targets: two beamwidths on either side of its middle, where the two-way gain
// is -96 dB. With Doppler beam sharpening: the resolution cell.
AzimuthInterval point_interval(const std::optional<AzimuthInterval>& sharpened_cell, double beamwidth_rad);

// Two-way gain in azimuth of a target with its middle at `offset_rad` from the middle of the beam, clockwise positive,
// and the width `width_rad`. The gain is 0 if the middle is outside point_interval(). In a sharpened cell the gain is
// instead the fraction of the target's width inside the cell (for width 0: 1 if the middle is inside, else 0), times
// azimuth_cell_rad() / cell width.
double point_azimuth_gain(const std::optional<AzimuthInterval>& sharpened_cell, double beamwidth_rad, double offset_rad,
                          double width_rad = 0.0);

// Apex, direction and range of one ray of a sweep.
// Precondition, ensured by the code in model/kernel: every value is finite, latitude is within +-90 deg, range > 0.
struct SweepGeometry {
  geo::GeoPoint apex;
  geo::AltitudeMsl altitude;
  geo::Bearing azimuth;  // true azimuth of the ray
  geo::Angle elevation;  // antenna elevation above the horizontal
  geo::Length range;     // far end of the last sample, in ground or slant range by fidelity
  geo::Duration sim_time{};
  std::uint8_t band = 0;     // 0..4: A..E
  std::uint8_t channel = 1;  // 1..8
  // Resolution cell of Doppler beam sharpening, about `azimuth`; nullopt: real beam.
  std::optional<AzimuthInterval> sharpened_cell{};
  // Angles from the antenna elevation up to the scan's highest bar and down to its lowest bar; 0 with one bar.
  geo::Angle bars_above{};
  geo::Angle bars_below{};
};

// Way of the aircraft from one sweep to another shortly after it, on a sphere.
struct Displacement {
  double north_m = 0.0, east_m = 0.0, up_m = 0.0;
};
Displacement displacement(const SweepGeometry& from, const SweepGeometry& to);

// Key of a sweep's noise. Equal keys give equal noise.
struct NoiseKey {
  std::uint64_t seed = 0;
  std::uint32_t scan = 0;
  std::uint32_t sweep = 0;
};

// Power of point targets in a sample of a sweep or a pixel of a map. It is the same in all looks.
struct SteadyPower {
  std::uint32_t at = 0;  // number of the sample or pixel
  float power = 0.0F;
};

// Power of a sweep and of its two neighbours in time, full scale = 1. Each span has one value per video sample.
// A pass is one crossing of the scan width. At its first and its last sweep the missing neighbour is the sweep itself.
struct PowerWindow {
  std::span<const float> before;
  std::span<const float> centre;
  std::span<const float> after;
  double jamming = 0.0;  // power received by the centre sweep at every range; full scale = 1
  double automatic_gain_db = 0.0;
  int looks = 1;  // independent looks averaged in each sample: Receiver::looks_of()
  // What of the three powers comes from movers and traffic. A sample may occur several times.
  std::array<std::span<const SteadyPower>, 3> steady{};
};

// Weights of the azimuth smear over three sweeps. The sum is 1, which conserves power. Source: the 1996 report.
inline constexpr std::array<double, 3> kAzimuthWeights{0.25, 0.5, 0.25};

// Line of sight from the aircraft to one point.
struct Sight {
  double tangent;  // tangent of elevation_rad
  double elevation_rad;
  double slant_range_m;
  double sin_grazing;  // sine of the grazing angle on level ground; < 0: the point is seen from below
  double cos_grazing;
};

// Earth of the rays from one observer: a sphere, or a plane, and the lift of points by refraction (refraction.hpp).
// R is the ellipsoid's radius of curvature at the apex along the azimuth, or the mean radius (EarthModel::sphere).
// With an effective earth radius factor k the sphere has the radius k R and there is no lift.
// Slant ranges are those of straight lines. Distances over ground are not scaled. Heights above mean sea level count as
// heights above the sphere.
// Source: docs/spec/physics.md#refraction.
class EffectiveEarth {
 public:
  explicit EffectiveEarth(double radius_m, const LiftSeries& lift = {}) : radius_m_(radius_m), lift_(lift) {}
  EffectiveEarth(double radius_m, const LiftSeries& lift, std::shared_ptr<const TracedLifts> traced)
      : radius_m_(radius_m), lift_(lift), traced_(std::move(traced)) {}
  double radius_m() const { return radius_m_; }         // infinity: flat
  double curvature() const { return 1.0 / radius_m_; }  // [1/m] 0 = flat
  // Lifts of the fast path. sight() and tangent() use traced rays instead where the algorithm is `reference`.
  const LiftSeries& lift() const { return lift_; }
  bool traced() const { return traced_ != nullptr; }
  // The same earth for altitudes and heights above a level at this height above mean sea level.
  EffectiveEarth above(double level_m) const;

  // Drop of the sphere below the horizontal plane of the apex at a distance over ground, exact.
  double drop_m(double distance_m) const;
  // Line of sight from an altitude above the apex to a point at a distance over ground (> 0) and a height.
  Sight sight(double altitude_m, double distance_m, double height_m) const;
  // Sight::tangent alone.
  double tangent(double altitude_m, double distance_m, double height_m) const;
  // Sight::slant_range_m alone.
  double slant_range_m(double altitude_m, double distance_m, double height_m) const;
  // Distance over ground at which ground of this height has this slant range; NaN if there is none.
  double distance_at_slant_range(double altitude_m, double height_m, double slant_range_m) const;
  // Lift of a point in elevation, and of its grazing angle [m].
  double elevation_lift_m(double altitude_m, double distance_m, double height_m) const;
  double grazing_lift_m(double distance_m, double height_m) const;
  // Depth of the ray to a point below its chord, in heights above the sphere: at the fraction s of the way, s (1 - s)
  // of this [m]. The parabola has the mean bending of the ray.
  double sag_m(double altitude_m, double distance_m, double height_m) const;

 private:
  double lift_in_elevation_m(double square_m2, double distance_m, double height_m) const;
  TracedLifts::Quotients quotients(double distance_m, double height_m) const;

  double radius_m_;
  LiftSeries lift_;
  std::shared_ptr<const TracedLifts> traced_;
  double level_m_ = 0.0;  // [m MSL] zero of altitudes and heights
};

// Earth of the rays from an observer by the parameters. A factor k below 0.1 is replaced by 0.1.
EffectiveEarth effective_earth(const GeometryParameters& parameters, geo::GeoPoint apex, geo::AltitudeMsl altitude,
                               geo::Bearing azimuth);
inline EffectiveEarth effective_earth(const GeometryParameters& parameters, const SweepGeometry& geometry) {
  return effective_earth(parameters, geometry.apex, geometry.altitude, geometry.azimuth);
}

// Loss [dB, one way] of a ray by a knife edge. `v`: parameter of diffraction; 0 where the edge touches the ray,
// positive where it is above it. 0 below -0.78. Source: Recommendation ITU-R P.526-15, eq. 31.
double knife_edge_loss_db(double v);
// The parameter v: `above_m` is the height of the edge above the ray, at `edge_m` of the ray's length `end_m`.
// P.526-15, eq. 26.
double diffraction_parameter(double above_m, double edge_m, double end_m, double wavelength_m);

// Distance over ground of a point on the ellipsoid, divided by its distance in the apex's horizontal plane: arcsine(x)
// / x, where x is the square root of `plane_square_m2` / radius of curvature. Series, within 3 m as far as 1,000 NM.
double arc_per_plane(double plane_square_m2, double radius_of_curvature_m);

// Range of each sample's centre [m], ascending at equal steps. `standard` and `reference` compute the ground at equal
// steps of ground range; SlantAxis moves it to equal steps of slant range.
void sample_distances(geo::Length range, std::span<double> distance_m);

}  // namespace yars::model::physics

// Geometry of one sweep: its beam and rays, the effective earth, and the samples' distances.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "lib/geo/geodesy.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/radar/configuration.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::physics {

// Which part of the beam a ray stands for, where points are concerned: of several rays across the beam each sees those
// in its own part, so that none is seen twice; of a sharpened beam a ray sees its resolution cell and nothing else.
// Angles off the ray's azimuth [rad], clockwise. A ray alone stands for all of the beam about it.
struct RayShare {
  double left_rad = -std::numeric_limits<double>::infinity();
  double right_rad = std::numeric_limits<double>::infinity();
  double beam_rad = 0.0;   // where the beam's centre is
  double factor = 1.0;     // on what the pattern gives: 1 over the weight that the ray is joined with
  bool sharpened = false;  // [left, right] is one cell of a synthetic aperture
};

struct Angles {
  double left_rad = 0.0, right_rad = 0.0;
};

// Where a ray sees points, at most two beam widths off the beam's centre: beyond they are 96 dB down.
Angles seen_angles(const RayShare& share, double beamwidth_rad);

// Two-way gain in azimuth of a point that is so wide [rad]. A sharpened cell gathers for as long as the real beam would
// take ground of its width in: what ground is scaled by the beam's width a point gains.
double azimuth_share(const RayShare& share, double beamwidth_rad, double off_rad, double wide_rad = 0.0);

// What one sweep of the real beam map looks at, and the three sweeps that the azimuth smear joins.

// Every value finite, latitude within +-90 degrees, range > 0: the kernel sees to it.
struct SweepGeometry {
  geo::GeoPoint apex;
  geo::AltitudeMsl altitude;
  geo::Bearing azimuth;  // of the beam's centre, true
  geo::Angle elevation;  // of the antenna, against the horizon
  geo::Length range;     // far end of the last sample
  geo::Duration sim_time{};
  std::uint8_t band = 0;     // 0..4: A..E
  std::uint8_t channel = 1;  // 1..8
  RayShare share{};          // of points
  // How far the highest and the lowest bar of the scan lie above and below the antenna's elevation; 0 with one bar.
  geo::Angle bars_above{};
  geo::Angle bars_below{};
};

// Names the noise of a sweep: equal numbers, equal noise.
struct NoiseKey {
  std::uint64_t seed = 0;
  std::uint32_t scan = 0;
  std::uint32_t sweep = 0;
};

// Power of a sweep and its two neighbours in time, each as long as the video; the first and the last sweep of a
// scan stand in for the neighbour that they lack.
struct PowerWindow {
  std::span<const float> before;
  std::span<const float> centre;
  std::span<const float> after;
  double jamming = 0.0;  // received by the centre one, at every range; full scale = 1
};

// Weights over three sweeps; their sum is 1, so that power is conserved. Source: the 1996 report.
inline constexpr std::array<double, 3> kAzimuthWeights{0.25, 0.5, 0.25};

// How the aircraft sees one point.
struct Sight {
  double tangent;        // of the elevation angle, against the aircraft's horizontal
  double elevation_rad;  // the same as an angle
  double slant_range_m;
  double sin_grazing;  // of the ray against the horizontal at the point; negative: from below
  double cos_grazing;
};

// The earth that a ray feels, and how a point on it is seen from the aircraft, in double precision. The geometry: a
// sphere of radius k R, R the ellipsoid's radius of curvature at the apex along the azimuth (or the mean radius, or
// none: flat). Distances over ground are kept, heights above mean sea level count as heights above that sphere.
// Source: docs/spec/physics.md#geometry.
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
void sample_distances(const radar::Fidelity& fidelity, const EffectiveEarth& earth, const SweepGeometry& look,
                      const terrain::TerrainView& terrain, std::span<double> distance_m);

}  // namespace yars::model::physics

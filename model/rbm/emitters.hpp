// Emitters on the ground: power of jammers and beacon replies in a sweep.
// Inputs: sweep geometry, terrain, configured jammers and beacons (effective radiated power ERP [W], bands, channels,
// codes, delays).
// Outputs: power (full scale = 1); slant ranges and distances over ground of replies [m].
// An emitter without configured altitude stands 10 m above the ground.
// Threads: one thread at a time may use an instance. No allocation after construction.
// Source: docs/spec/physics.md#jamming, docs/pilots_manual.md#rule-17.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "lib/geo/frames.hpp"
#include "lib/geo/geodesy.hpp"
#include "lib/radar/modes.hpp"
#include "model/physics/atmosphere.hpp"
#include "model/physics/receiver.hpp"
#include "model/physics/sweep_geometry.hpp"
#include "model/rbm/line_of_sight.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::radar {
struct Beacon;
struct JammingConfiguration;
}  // namespace yars::radar

namespace yars::model::rbm {

// Lines of sight to emitters at fixed positions from a SightOrigin, recomputed after each 100 m flown or 5 m climbed
// and when the terrain changes. Gas attenuation of a line of sight is within 0.005 dB.
class EmitterSights {
 public:
  struct Emitter {
    geo::GeoPoint position;
    double altitude_m = 0.0;  // [m MSL] kNotGiven: top of a mast of 10 m
  };
  struct Sight {
    bool clear = false;                  // no ground hides the emitter
    double altitude_m = 0.0;             // [m MSL] of the emitter
    double transmission = 1.0;           // factor on power by gases, one way
    double distance_m = 0.0;             // over ground, at least 10 m
    double radius_of_curvature_m = 0.0;  // of the ellipsoid at the apex towards the emitter
    physics::EffectiveEarth earth{geo::kMeanEarthRadius_m};
  };
  EmitterSights(const physics::RadarParameters& parameters, std::vector<Emitter> emitters);
  // Replaces all emitters. The next call must be from().
  void use_emitters(std::vector<Emitter> emitters);

  // The sights of all emitters. The span is valid until the next call.
  std::span<const Sight> from(const physics::SweepGeometry& geometry, const terrain::TerrainView& terrain);

  // Azimuth off the sweep's ray, clockwise positive, and distance over ground (at least 10 m) of an emitter from the
  // aircraft itself. Within 2 m and 1e-5 rad of the geodesic; `reference` uses the geodesic.
  struct Path {
    double offset_rad = 0.0;
    double distance_m = 0.0;
  };
  // Path to the emitter `number` in the sweep of the last from().
  Path path(std::size_t number) const;

 private:
  Sight sight_of(const Emitter& emitter, const physics::SweepGeometry& geometry, const terrain::TerrainView& terrain);

  bool exact_;
  physics::GeometryParameters geometry_parameters_;
  physics::GasPath gas_;
  SightLine sight_line_;
  std::vector<Emitter> emitters_;
  std::vector<geo::Vector3> ecef_;  // [m] positions of the emitters on the ellipsoid
  std::vector<Sight> sights_;
  SightOrigin origin_;
  geo::GeoPoint apex_;  // of the sweep of the last from()
  geo::Bearing azimuth_;
  geo::Vector3 apex_ecef_, ahead_, right_;  // ECEF
};

// Jamming strobes: noise of equal power at every range of a sweep. A jammer is received if it jams the radar's band and
// channel and is in line of sight. The radar receives jamming in SNIFF too, when it does not transmit.
// Received power: 4 pi (ERP_jammer / ERP_radar) G / R^2 in the unit of returned_power(). G is the one-way gain, 1 in
// the beam's centre: the square root of the two-way gain, or the sidelobe level if higher. R is the slant range. Gas
// attenuation is one-way. Sensitivity time control and rain do not apply.
class Strobes {
 public:
  explicit Strobes(const physics::RadarParameters& parameters);
  // Replaces the jammers.
  void use_jammers(const physics::RadarParameters& parameters);

  // Received power of all jammers together, full scale = 1; 0 without jamming.
  double level(const physics::SweepGeometry& geometry, const terrain::TerrainView& terrain);

 private:
  double received(std::size_t number, const EmitterSights::Sight& sight, const physics::SweepGeometry& geometry,
                  const physics::Receiver& receiver) const;

  std::shared_ptr<const radar::JammingConfiguration> jamming_;
  radar::BeamPattern beam_;
  double sidelobe_;  // minimum one-way gain
  physics::Receivers receivers_;
  EmitterSights sights_;
};

// One reply of a beacon.
struct Reply {
  double slant_range_m = 0.0;  // apparent slant range: the beacon's, increased by the reply's delay
  double distance_m = 0.0;     // over ground, of a point at that slant range and the beacon's altitude
  double power = 0.0;          // full scale = 1
};

// Beacon replies in a sweep of the beacon mode BCN. A beacon replies if it has the radar's code, is in line of sight
// and lies within half an azimuth beamwidth of the beam's centre. On the display a reply is an arc, one beamwidth wide
// and one pulse length deep.
// A delay t adds c t / 2 to the slant range (c: speed of light). Received power: 4 pi (ERP_beacon / ERP_radar) G / R^2.
// G is the one-way gain, 1 in the beam's centre; R is the beacon's slant range. Gas attenuation is one-way. The
// receiver is tuned to the beacons' frequency, so the ground is not received. Sensitivity time control is off.
class Beacons {
 public:
  explicit Beacons(const physics::RadarParameters& parameters);

  bool none() const;  // true if no beacon has the radar's code

  // Replies of all beacons within the selected range, in configured order. The delay can place a reply beyond
  // the selected range. The span is valid until the next call of replies() or measure().
  std::span<const Reply> replies(const physics::SweepGeometry& geometry, const terrain::TerrainView& terrain);

  // Sets `power` to the power of the replies in each sample, near to far, full scale = 1.
  void measure(const physics::SweepGeometry& geometry, const terrain::TerrainView& terrain, std::span<float> power);

 private:
  void answer(std::size_t number, const EmitterSights::Sight& beacon_sight, const physics::SweepGeometry& geometry,
              const physics::Receiver& receiver);

  double radar_power_dbw_;
  radar::BeamPattern beam_;
  physics::GeometryParameters geometry_parameters_;
  physics::Receivers receivers_;
  std::shared_ptr<const std::vector<radar::Beacon>> answering_;  // beacons with the radar's beacon code
  EmitterSights sights_;
  std::vector<Reply> replies_;
};

}  // namespace yars::model::rbm

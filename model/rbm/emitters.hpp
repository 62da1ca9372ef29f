// Emitters on the ground: power of jammers and beacon replies in a sweep.
// Inputs: sweep geometry, terrain, configured jammers and beacons (effective radiated power ERP [W], bands, channels,
// codes, delays).
// Outputs: power (full scale = 1); slant ranges and distances over ground of replies [m].
// An emitter without configured altitude stands 10 m above the ground.
// Threads: one thread at a time may use an instance. No allocation after construction.
// Source: docs/spec/physics.md#jamming, docs/spec/pilots_interface.md#rule-17.
#pragma once

#include <memory>
#include <span>
#include <vector>

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

// Jamming strobes: noise of equal power at every range of a sweep. A jammer is received if it jams the radar's band and
// channel and is in line of sight. The radar receives jamming in SNIFF too, when it does not transmit.
// Received power: 4 pi (ERP_jammer / ERP_radar) G / R^2 in the unit of returned_power(). G is the one-way gain, 1 in
// the beam's centre: the square root of the two-way gain, or the sidelobe level if higher. R is the slant range. Gas
// attenuation is one-way. Sensitivity time control and rain do not apply.
class Strobes {
 public:
  explicit Strobes(const physics::RadarParameters& parameters);

  // Received power of all jammers together, full scale = 1; 0 without jamming.
  double level(const physics::SweepGeometry& geometry, const terrain::TerrainView& terrain);

 private:
  std::shared_ptr<const radar::JammingConfiguration> jamming_;
  radar::BeamPattern beam_;
  physics::GeometryParameters geometry_parameters_;
  physics::Receivers receivers_;
  physics::GasPath gas_;
  SightLine sight_line_;
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
  void answer(const radar::Beacon& beacon, const physics::SweepGeometry& geometry, const physics::Receiver& receiver,
              const terrain::TerrainView& terrain);

  double radar_power_dbw_;
  radar::BeamPattern beam_;
  physics::GeometryParameters geometry_parameters_;
  physics::Receivers receivers_;
  physics::GasPath gas_;
  SightLine sight_line_;
  std::shared_ptr<const std::vector<radar::Beacon>> answering_;  // beacons with the radar's beacon code
  std::vector<Reply> replies_;
  std::vector<double> distance_m_;  // distance of each sample over ground
};

}  // namespace yars::model::rbm

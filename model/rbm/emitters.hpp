// Emitters on the ground: jammers and beacons as a sweep receives them.
#pragma once

#include <span>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "model/physics/atmosphere.hpp"
#include "model/physics/receiver.hpp"
#include "model/physics/sweep_geometry.hpp"
#include "model/rbm/line_of_sight.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::rbm {

// What jammers add to a sweep: noise of one level at every range, received while the radar's band and channel are
// jammed and the jammer is in sight over terrain and effective earth; also in SNIFF, for it needs no transmission.
// One way: P = 4 pi (ERP_jammer / ERP_radar) G / R^2 in the units of returned_power(), G the one-way gain: the root of
// the two-way pattern, never below the sidelobes; gases take their part once. Sensitivity time control and rain leave
// it alone. One instance a thread.
class Strobes {
 public:
  explicit Strobes(const radar::RadarConfiguration& configuration)
      : configuration_(configuration), gas_(configuration) {}

  // Full scale = 1; 0 where nothing jams.
  double level(const physics::SweepGeometry& look, const terrain::TerrainView& terrain);

 private:
  radar::RadarConfiguration configuration_;
  physics::GasPath gas_;
  SightLine sight_line_;
};

// Replies in the order of their arrival.
struct Reply {
  double slant_range_m = 0.0;  // at which the receiver takes it to be
  double distance_m = 0.0;     // over ground, of that slant range at the beacon's height: where it is drawn
  double power = 0.0;          // full scale = 1
};

// Beacons as a sweep of BCN sees them: each that lies within the beam, is in sight and answers to the radar's code
// shows as short arcs, one a reply, behind its place by c / 2 for each microsecond of its delay and spacing. It
// transmits itself: P = 4 pi (ERP_beacon / ERP_radar) G / R^2 as a jammer's, G the one-way gain; a reply lasts as long
// as the radar's pulse. It hears the main beam alone, so its arcs are a beam width wide. The receiver listens on the
// beacons' frequency: ground returns nothing, sensitivity time control is off.
// Source: docs/spec/pilots_interface.md#rule-17.
class Beacons {
 public:
  explicit Beacons(const radar::RadarConfiguration& configuration);

  bool none() const { return answering_.empty(); }

  // What arrives from all beacons, also from beyond the range. Valid until the next call; allocates nothing.
  std::span<const Reply> replies(const physics::SweepGeometry& look, const terrain::TerrainView& terrain);

  // The same as power by samples, near to far, as Algorithm::measure() gives it; what is no reply is 0.
  void measure(const physics::SweepGeometry& look, const terrain::TerrainView& terrain, std::span<float> power);

 private:
  void answer(const radar::Beacon& beacon, const physics::SweepGeometry& look, const physics::Receiver& receiver,
              const terrain::TerrainView& terrain);

  radar::RadarConfiguration configuration_;
  physics::GasPath gas_;
  SightLine sight_line_;
  std::vector<radar::Beacon> answering_;  // to the radar's code
  std::vector<Reply> replies_;
  std::vector<double> distance_m_;  // of the samples
};

}  // namespace yars::model::rbm

// What jammers add to a sweep: noise of one level at every range, received while the radar's band and channel are
// jammed and the jammer is in sight over terrain and effective earth; also in SNIFF, for it needs no transmission.
// One way: P = 4 pi (ERP_jammer / ERP_radar) G / R^2 in the units of returned_power(), G the one-way gain: the root of
// the two-way pattern, never below the sidelobes. Sensitivity time control and rain leave it alone.
#pragma once

#include "lib/radar/configuration.hpp"
#include "model/rbm/look.hpp"
#include "model/terrain/terrain_view.hpp"

namespace yars::model::rbm {

class Strobes {
 public:
  explicit Strobes(const radar::RadarConfiguration& configuration) : configuration_(configuration) {}

  // Full scale = 1; 0 where nothing jams.
  double level(const Look& look, const terrain::TerrainView& terrain) const;

 private:
  radar::RadarConfiguration configuration_;
};

// True if nothing on the ground hides a point at this altitude from the look's place. Ground is read at most every
// 500 m; a void counts as sea level. Distance over ground [m], > 0.
bool in_sight(const radar::Fidelity& fidelity, const Look& look, const terrain::TerrainView& terrain,
              const geo::GeodesicInverse& way, double altitude_m);

}  // namespace yars::model::rbm

// What jammers add to a sweep: noise of one level at every range, received while the radar's band and channel are
// jammed and the jammer is in sight over terrain and effective earth; also in SNIFF, for it needs no transmission.
// One way: P = 4 pi (ERP_jammer / ERP_radar) G / R^2 in the units of returned_power(), G the one-way gain: the root of
// the two-way pattern, never below the sidelobes; gases take their part once. Sensitivity time control and rain leave
// it alone. One instance a thread.
#pragma once

#include "lib/radar/configuration.hpp"
#include "model/rbm/gas_path.hpp"
#include "model/rbm/look.hpp"
#include "model/rbm/sight_line.hpp"
#include "model/terrain/terrain_view.hpp"

namespace yars::model::rbm {

class Strobes {
 public:
  explicit Strobes(const radar::RadarConfiguration& configuration)
      : configuration_(configuration), gas_(configuration) {}

  // Full scale = 1; 0 where nothing jams.
  double level(const Look& look, const terrain::TerrainView& terrain);

 private:
  radar::RadarConfiguration configuration_;
  GasPath gas_;
  SightLine sight_line_;
};

}  // namespace yars::model::rbm

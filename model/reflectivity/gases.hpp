// What the gases of the air take from a ray: specific attenuation line by line (Recommendation ITU-R P.676-13, Annex 1,
// section 1), through the mean annual global reference atmosphere (ITU-R P.835, Annex 1): temperature in layers,
// pressure by it, water vapour falling to 1/e in each 2 km.
#pragma once

#include <vector>

#include "lib/radar/configuration.hpp"

namespace yars::model::reflectivity {

struct Air {
  double temperature_k = 0.0;
  double dry_hpa = 0.0;     // pressure without the water vapour's
  double water_g_m3 = 0.0;  // density of water vapour
};

// One way [dB/km].
struct GasAttenuation {
  double dry = 0.0;
  double water = 0.0;
};

// Frequency [GHz] from 1 to 1000.
GasAttenuation gas_attenuation(double frequency_ghz, const Air& air);

// At a height above mean sea level [m], up to 32 km; below the sea as at it goes on.
Air reference_air(const radar::AtmosphereConfiguration& atmosphere, double height_m);

// Attenuation by height at one frequency, looked up: straight between heights 100 m apart.
class GasProfile {
 public:
  // Nothing attenuates where the configuration switches gases off.
  GasProfile(const radar::AtmosphereConfiguration& atmosphere, double frequency_ghz);

  bool empty() const { return db_per_m_.empty(); }
  // One way; as at 30 km above that, as 1 km below the sea below that.
  double db_per_m(double height_m) const;

 private:
  std::vector<double> db_per_m_;
};

}  // namespace yars::model::reflectivity

// Ships and vehicles as a sweep sees them: points that go their geodesics with sim time, on the ground where they are.
// Shadow is the caller's: it knows the horizon. Source: docs/spec/physics.md#power, the radar equation of a point.
// Those of the configuration and those of the traffic, of which no more than kMostTraffic are looked at.
#pragma once

#include <span>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "model/rbm/database.hpp"
#include "model/rbm/earth.hpp"
#include "model/rbm/gas_path.hpp"
#include "model/rbm/look.hpp"
#include "model/rbm/receiver.hpp"

namespace yars::model::rbm {

// What comes back from one mover, if nothing hides it.
struct Echo {
  double distance_m = 0.0;  // over ground
  double tangent = 0.0;     // of its elevation angle
  double power = 0.0;       // full scale = 1, after sensitivity time control; gains and what gases take in it
};

inline constexpr std::size_t kMostTraffic = 64;

class Movers {
 public:
  explicit Movers(const radar::RadarConfiguration& configuration);

  // Those within the range and two beam widths of the beam. Valid until the next call; allocates nothing.
  std::span<const Echo> echoes(const Look& look, const Receiver& receiver, const EffectiveEarth& earth,
                               const Database& database);

 private:
  void add_echoes(std::span<const MovingPoint> points, const Look& look, const Receiver& receiver,
                  const EffectiveEarth& earth, const terrain::TerrainView& terrain);

  radar::BeamPattern beam_;
  GasPath gas_;
  std::vector<MovingPoint> points_;
  std::vector<Echo> echoes_;
};

// The sample that holds a distance over ground: the one whose centre is nearest. Centres ascend, NaN first; no samples
// or only NaN: the number of samples.
std::size_t nearest_sample(std::span<const double> distance_m, double wanted_m);

// How many samples are nearer than a distance over ground: their centres are less, or not a number.
std::size_t samples_nearer(std::span<const double> distance_m, double wanted_m);

}  // namespace yars::model::rbm

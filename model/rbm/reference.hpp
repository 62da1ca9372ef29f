// The oracle: plain double precision, an exact geodesic and exact earth curvature at every sample, one loop a step,
// written to be read. Tests hold the faster algorithms against it; `yars trade` measures by it.
// Accuracy: that of double; power is handed over as float (6e-8 relative).
#pragma once

#include <vector>

#include "lib/radar/configuration.hpp"
#include "model/physics/atmosphere.hpp"
#include "model/physics/environment.hpp"
#include "model/physics/ground_return.hpp"
#include "model/physics/ray.hpp"
#include "model/physics/receiver.hpp"
#include "model/physics/sweep_geometry.hpp"
#include "model/rbm/algorithm.hpp"
#include "model/rbm/scene_return.hpp"

namespace yars::model::rbm {

class Reference : public Algorithm {
 public:
  explicit Reference(const radar::RadarConfiguration& configuration);

  std::size_t measure(const physics::SweepGeometry& look, const physics::Environment& database,
                      std::span<float> power) override;
  void lit(std::span<std::uint8_t> mask) const override;
  void form_video(const physics::PowerWindow& window, geo::Length range, int gain, const physics::NoiseKey& key,
                  std::span<std::uint8_t> video) override;

  // What the last measure() found for a sample; for tests and `yars trade`.
  struct Sample {
    double distance_m = 0.0;  // over ground; NaN = nothing is that near
    geo::GeoPoint place;
    geo::Bearing azimuth;       // of the ray there
    double height_m = 0.0;      // MSL; NaN = void
    double peak_m = 0.0;        // MSL; casts the shadow; NaN = void
    double water = 0.0;         // share [0, 1]
    std::uint8_t material = 0;  // code
    double cross_slope = 0.0;   // across the sweep, dimensionless
    double horizon = 0.0;       // greatest tangent of all ground up to here, this sample's included
    bool lit = false;
    double power = 0.0;  // before the pulse smear
  };
  std::span<const Sample> samples() const { return samples_; }

 private:
  std::size_t read_terrain(const physics::SweepGeometry& look, const terrain::TerrainView& terrain);
  void read_cross_slopes(const physics::SweepGeometry& look, const terrain::TerrainView& terrain);
  void cast_shadows(const physics::SweepGeometry& look, const physics::EffectiveEarth& earth,
                    const physics::GroundWalk& walk);
  double along_slope(std::size_t index) const;
  double cell_power(const physics::Receiver& receiver, const physics::EffectiveEarth& earth,
                    const physics::SweepGeometry& look, std::size_t index) const;
  void add_movers(std::span<const physics::Echo> echoes, const physics::GroundWalk& walk, double pulse_samples);
  void see_scenes(const physics::SweepGeometry& look, const physics::Receiver& receiver,
                  const physics::GroundWalk& walk, const scene::SceneView& scenes, double pulse_samples);
  void add_rain(const physics::Receiver& receiver, const physics::EffectiveEarth& earth,
                const physics::SweepGeometry& look);
  void smear_pulse(double pulse_samples, std::span<float> power) const;

  radar::RadarConfiguration configuration_;
  physics::SurfaceReturn surface_;
  physics::RainPath rain_;
  physics::GasPath gas_;
  physics::Movers movers_;
  SceneReturn scene_return_;
  std::vector<Sample> samples_;
  std::vector<double> distance_m_;
};

}  // namespace yars::model::rbm

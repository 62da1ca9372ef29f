// Covers of polygonal scenes in a ray of the real beam map: flat faces on the ground, such as runways and roads. They
// replace the ground's return in proportion to the area that they cover.
// Inputs: ray, receiver, scenes, the ray's ground with its power.
// Outputs: the power of the samples before the pulse smear, changed in place.
// Accuracy: double precision. Positions are computed on a sphere: some metres in scenes of some tens of kilometres.
// Threads: one thread at a time may use an instance. No allocation after construction.
// Source: docs/spec/physics.md#power, docs/radar_maths.md#scenes.
#pragma once

#include <cstddef>
#include <vector>

#include "lib/radar/modes.hpp"
#include "model/physics/atmosphere.hpp"
#include "model/physics/receiver.hpp"
#include "model/physics/reflectivity.hpp"
#include "model/physics/sweep_geometry.hpp"
#include "model/rbm/scene_ray.hpp"
#include "model/scene/placement/scene_view.hpp"

namespace yars::model::rbm {

class SceneCovers {
 public:
  SceneCovers(const physics::RadarParameters& parameters, std::size_t samples);

  // Samples of the ray, near to far.
  struct Ground {
    explicit Ground(std::size_t samples)
        : distance_m(samples), height_m(samples), cross_slope(samples), power(samples) {}
    std::vector<double> distance_m;   // over ground, ascending; NaN: slant range too short to meet the ground
    std::vector<double> height_m;     // [m MSL]; NaN: void
    std::vector<double> cross_slope;  // slope across the ray
    std::vector<double> power;        // before the pulse smear
  };

  // Returns true if covers may lie under the ray; the caller then fills ground() and calls apply().
  bool enter(const physics::SweepGeometry& geometry, const scene::SceneView* scenes);
  Ground& ground() { return ground_; }
  // Mixes the covers into ground().power.
  void apply(const physics::SweepGeometry& geometry, const physics::Receiver& receiver,
             const physics::EffectiveEarth& earth, const scene::SceneView& scenes);

 private:
  double spacing_m(const physics::SweepGeometry& geometry) const;  // range between samples
  bool lies_under(const SceneRay& ray, const physics::SweepGeometry& geometry, const scene::Scatterers& scene) const;
  void cover(const physics::SweepGeometry& geometry, const physics::Receiver& receiver,
             const physics::EffectiveEarth& earth, const scene::Scatterers& scene);
  double covered_power(const physics::SweepGeometry& geometry, const physics::Receiver& receiver,
                       const physics::EffectiveEarth& earth, std::size_t sample, double gamma) const;

  radar::BeamPattern beam_;
  physics::GasPath gas_;
  physics::SceneSurface surface_;
  Ground ground_;
};

}  // namespace yars::model::rbm

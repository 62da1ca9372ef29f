// Polygonal scenes in a ray of the real beam map: the ray in a scene's coordinates, which scenes it meets, and covers:
// flat faces on the ground, such as runways. They replace the ground's return in proportion to the area they cover.
// Inputs: geometry of the ray; scenes; the ray's ground with its power.
// Outputs: vectors in a scene's frame (east-north-up [m], from earth-centred, earth-fixed); whether the scene lies
//   within the range, and under the ray; the power of the samples before the pulse smear, changed in place.
// Accuracy: double precision. A geodesic differs by less than 1 km from the vertical plane through its start. Positions
//   of covers are computed on a sphere: some metres in scenes of some tens of kilometres.
// Threads: one thread at a time may use a SceneCovers. No allocation after construction.
// Source: docs/spec/physics.md#power, docs/radar_maths.md#scenes.
#pragma once

#include <cstddef>
#include <vector>

#include "lib/geo/frames.hpp"
#include "lib/geo/quantity.hpp"
#include "model/physics/reflectivity.hpp"
#include "model/physics/sweep_geometry.hpp"
#include "model/scene/placement/scene_view.hpp"

namespace yars::model::rbm {

class SceneRay {
 public:
  explicit SceneRay(const physics::SweepGeometry& geometry);

  // The ray in a scene's frame: the apex on the ellipsoid, and horizontal unit vectors at the apex.
  struct InScene {
    geo::Vector3 apex, ahead, right, north, east;
  };
  InScene in(const scene::Scatterers& scene) const;

  // False if no part of a scene is within the range.
  bool reaches(const scene::Scatterers& scene) const;
  // True if the ray passes over a scene, or at most 1 km beside it.
  bool crosses(const scene::Scatterers& scene) const;

 private:
  geo::Vector3 apex_, ahead_, right_, north_, east_;
  double range_m_;
};

class SceneCovers {
 public:
  SceneCovers(const physics::RadarParameters& parameters, std::size_t samples);

  // Samples of the ray, near to far.
  struct Ground {
    explicit Ground(std::size_t samples) : distance_m(samples), power(samples), power_per_gamma(samples) {}
    std::vector<double> distance_m;       // over ground, ascending; NaN: slant range too short to meet the ground
    std::vector<double> power;            // before the pulse smear
    std::vector<double> power_per_gamma;  // what the power would be if the ground were land with gamma 1
  };

  // Returns true if covers may lie under the ray; the caller then fills ground() and calls apply().
  bool enter(const physics::SweepGeometry& geometry, const scene::SceneView* scenes);
  Ground& ground() { return ground_; }
  // Mixes the covers into ground().power.
  void apply(const physics::SweepGeometry& geometry, const scene::SceneView& scenes);

 private:
  double spacing_m(const physics::SweepGeometry& geometry) const;  // range between samples
  bool lies_under(const SceneRay& ray, const physics::SweepGeometry& geometry, const scene::Scatterers& scene) const;
  void cover(const physics::SweepGeometry& geometry, const scene::Scatterers& scene);

  physics::SceneSurface surface_;
  Ground ground_;
};

}  // namespace yars::model::rbm

// Radar cross section of a scatterer (scene_view.hpp) in Highway vectors of float, over its facings.
// Inputs: facings, direction to the aircraft, reflectivity of materials. Output: cross section [m^2].
// Accuracy: 1e-4 relative against SceneSurface in double.
// Threads: pure functions. All instruction sets give results equal bit by bit.
#pragma once

#include <cstddef>
#include <span>

#include "lib/radar/modes.hpp"
#include "model/physics/reflectivity.hpp"
#include "model/scene/placement/scene_view.hpp"

namespace yars::model::rbm::simd {

// Reflectivity by material code, and the cardinal effect of walls.
struct SceneTables {
  explicit SceneTables(const physics::SceneSurface& surface);

  alignas(64) float gamma[radar::kMaterials];
  alignas(64) float cardinal[radar::kMaterials];  // gain - 1 of a wall that faces the radar
  float cutoff_tangent;                           // tangent of the angle beyond which there is no effect
  float widths_per_rad;                           // the effect falls to half at half a width
};

// Direction from a scatterer to the aircraft.
struct SceneView {
  float east, north;  // horizontal unit vector
  float cos_grazing, sin_grazing;
};

// Sum over the facings that face the aircraft: projected area times gamma. After the last facing
// scene::kFacingSlack more facings are read.
float cross_section_m2(std::span<const scene::Facing> facings, const SceneTables& tables, const SceneView& view);

}  // namespace yars::model::rbm::simd

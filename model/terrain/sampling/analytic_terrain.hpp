// Terrain given by a formula. The built-in hills are the terrain of a configuration without a terrain directory.
// Input: position. Output: height [m MSL]. A height of exactly 0 is water; NaN is void.
#pragma once

#include <cstdint>
#include <functional>
#include <utility>

#include "lib/geo/quantity.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::terrain {

// Terrain view of a height function and, optionally, a function of surface material codes.
class AnalyticTerrain final : public TerrainView {
 public:
  using Height = std::function<double(geo::GeoPoint)>;
  using Material = std::function<std::uint8_t(geo::GeoPoint)>;
  // Without `material` the material code is 0 everywhere. Codes above kMaxMaterial are read as 0.
  explicit AnalyticTerrain(Height height_m, std::uint64_t generation = 1, Material material = {});

  std::uint64_t generation() const override { return generation_; }
  std::uint64_t resident_bytes() const override { return sizeof(*this); }
  Surface surface_at(geo::GeoPoint position, Interpolation interpolation) const override;
  bool has_materials() const override { return static_cast<bool>(material_); }
  std::size_t surfaces(const PositionRun& positions, Interpolation interpolation,
                       const SurfaceRun& found) const override;

 private:
  Height height_m_;
  std::uint64_t generation_;
  Material material_;
};

// Terrain store with one view for all regions.
class FixedTerrainStore final : public TerrainStore {
 public:
  explicit FixedTerrainStore(TerrainViewPointer view) : view_(std::move(view)) {}
  TerrainViewPointer prepare(const TerrainRegion& /*region*/) override { return view_; }

 private:
  TerrainViewPointer view_;
};

// Built-in terrain: the sum of three patterns of sine waves over the whole earth, 0 to 1170 m MSL.
// Wavelengths at the equator are about 9, 28 and 120 km. Heights below 0 m become 0 m, which is sea.
// One evaluation takes 8 sines and no geodesic.
AnalyticTerrain::Height built_in_hills();

}  // namespace yars::model::terrain

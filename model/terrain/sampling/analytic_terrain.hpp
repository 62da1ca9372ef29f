// Terrain given by a formula, and the built-in hills that serve where no directory is configured.
// Input: position. Output: height [m MSL]; exactly 0 is water, NaN is void.
#pragma once

#include <cstdint>
#include <functional>
#include <utility>

#include "lib/geo/quantity.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::terrain {

// View over a height function and, optionally, a material function.
class AnalyticTerrain final : public TerrainView {
 public:
  using Height = std::function<double(geo::GeoPoint)>;
  using Material = std::function<std::uint8_t(geo::GeoPoint)>;
  // Without `material` the code is 0 everywhere.
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

// A store with one view for every region.
class FixedTerrainStore final : public TerrainStore {
 public:
  explicit FixedTerrainStore(TerrainViewPointer view) : view_(std::move(view)) {}
  TerrainViewPointer prepare(const TerrainRegion& /*region*/) override { return view_; }

 private:
  TerrainViewPointer view_;
};

// Rolling hills everywhere on earth, 0 to 1170 m, a few kilometres to a few tens apart, with sea in the deepest
// hollows: something to see where no terrain is configured. No geodesic: cheap.
AnalyticTerrain::Height built_in_hills();

}  // namespace yars::model::terrain

// Terrain as a function of position: the built-in hills that serve where no directory is configured.
// Heights in metres MSL; a height of exactly 0 is water; NaN is void.
#pragma once

#include <cstdint>
#include <functional>
#include <utility>

#include "lib/geo/quantity.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::terrain {

class AnalyticTerrain final : public TerrainView {
 public:
  using Height = std::function<double(geo::GeoPoint)>;
  using Material = std::function<std::uint8_t(geo::GeoPoint)>;
  // Without `material` there is none anywhere.
  explicit AnalyticTerrain(Height height_m, std::uint64_t generation = 1, Material material = {});

  std::uint64_t generation() const override { return generation_; }
  std::uint64_t resident_bytes() const override { return sizeof(*this); }
  Surface surface_at(geo::GeoPoint place, Interpolation interpolation) const override;
  bool has_materials() const override { return static_cast<bool>(material_); }
  std::size_t surfaces(const PlaceRun& places, Interpolation interpolation, const SurfaceRun& found) const override;

 private:
  Height height_m_;
  std::uint64_t generation_;
  Material material_;
};

// A store whose every region is served by one view.
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

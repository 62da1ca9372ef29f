// Terrain given by a formula: shapes with a radar picture in closed form, for tests, and the built-in hills.
// Input: position. Output: height [m MSL]; exactly 0 is water, NaN is void.
// Frame of the shapes: `along` [m] an axis from an origin and `across` [m] to its right, azimuthal equidistant.
//   Ranges and bearings from the origin are exact (geodesic).
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
  std::size_t surfaces(const PlaceRun& positions, Interpolation interpolation, const SurfaceRun& found) const override;

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

// Axis of the shapes below.
struct TerrainAxis {
  geo::GeoPoint origin;
  geo::Bearing direction;
};

AnalyticTerrain::Height flat(double height_m);
// `height_m` at the origin plus `slope` (tangent) times the distance along the axis.
AnalyticTerrain::Height plane(TerrainAxis axis, double height_m, double slope);
// 0 m up to `start_m` along the axis, then rising with `slope` without limit.
AnalyticTerrain::Height wedge(TerrainAxis axis, double start_m, double slope);
// `height_m` from `start_m` to `end_m` along the axis, 0 m elsewhere.
AnalyticTerrain::Height plateau(TerrainAxis axis, double start_m, double end_m, double height_m);
// Triangular ridge across the axis: crest at `crest_m` along, falling to 0 m over `half_width_m` on both sides.
AnalyticTerrain::Height ridge(TerrainAxis axis, double crest_m, double half_width_m, double height_m);
// Vertical step: height `near_m` up to `wall_m` along the axis, height `far_m` beyond.
AnalyticTerrain::Height step_wall(TerrainAxis axis, double wall_m, double near_m, double far_m);
// Sine hills from 0 to 2 * amplitude_m, with one crest per wavelength along and across.
AnalyticTerrain::Height sine_hills(TerrainAxis axis, double amplitude_m, double wavelength_m);
// Rolling hills everywhere on earth, 0 to 1170 m high, with sea in the deepest hollows. Their distances are a few to a
// few tens of kilometres. The default where no terrain is configured. Cheap: no geodesic.
AnalyticTerrain::Height built_in_hills();

}  // namespace yars::model::terrain

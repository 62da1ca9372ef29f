// Terrain as a function of place: the shapes whose radar picture is known in closed form, and the built-in hills
// that serve where no directory is configured. Heights in metres MSL; a height of exactly 0 is water; NaN is void.
// Shapes are laid out about an origin: `along` [m] down the axis and `across` [m] right of it, measured by the
// geodesic from the origin (azimuthal equidistant: exact ranges and bearings as seen from there).
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

// The frame of the shapes below.
struct TerrainAxis {
  geo::GeoPoint origin;
  geo::Bearing direction;
};

AnalyticTerrain::Height flat(double height_m);
// Height at the origin plus slope (tangent) times the way along the axis.
AnalyticTerrain::Height plane(TerrainAxis axis, double height_m, double slope);
// Sea level to `start_m` along the axis, then rising with `slope` without end.
AnalyticTerrain::Height wedge(TerrainAxis axis, double start_m, double slope);
// `height_m` between two ways along the axis, sea level elsewhere.
AnalyticTerrain::Height plateau(TerrainAxis axis, double start_m, double end_m, double height_m);
// A roof across the axis: its crest at `crest_m` along, falling to sea level over `half_width_m` on both sides.
AnalyticTerrain::Height ridge(TerrainAxis axis, double crest_m, double half_width_m, double height_m);
// `near_m` high up to `wall_m` along the axis, `far_m` high behind: a wall of no thickness.
AnalyticTerrain::Height step_wall(TerrainAxis axis, double wall_m, double near_m, double far_m);
// Sine hills between 0 and 2 * amplitude, one crest each wavelength both ways.
AnalyticTerrain::Height sine_hills(TerrainAxis axis, double amplitude_m, double wavelength_m);
// Rolling hills everywhere on earth, 0 to 1170 m, a few kilometres to a few tens apart, with sea in the deepest
// hollows: something to see where no terrain is configured. No geodesic: cheap.
AnalyticTerrain::Height built_in_hills();

}  // namespace yars::model::terrain

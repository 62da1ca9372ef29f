// Terrain sampled on the polar grid of a patch map: height and gamma of each point, and the horizon at row 0.
// Inputs: terrain views of the window and of the path, the radar's configuration, optional ground detail.
// Outputs: GroundArrays, filled strip by strip.
// Units: metres; gamma is a ratio; the horizon is the greatest tangent of the elevation angles of all nearer ground.
// Threads: one instance per thread, because an instance has the buffers of a column.
// Source: docs/radar_maths.md, "Patch maps"; decision 19 (every post can raise the horizon).
#pragma once

#include <memory>
#include <vector>

#include "lib/memory/line_vector.hpp"
#include "lib/radar/modes.hpp"
#include "model/hrm/ground_detail.hpp"
#include "model/hrm/patch_geometry.hpp"
#include "model/physics/ground_return.hpp"
#include "model/physics/ray.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::hrm {

// Kinds of crests between two neighbouring rows that raise the horizon. `lines`: crossings of a column with lines of
// posts (rows and columns of the terrain's posts). `summits`: summits of parabolas through three rows, on smoothed
// ground. Closely spaced rows need neither kind.
struct CrestsBetweenRows {
  bool lines = false;
  bool summits = false;
  bool any() const { return lines || summits; }
};
// Returns the crests that the row spacing requires. `smooth`: true if the window's ground is smoothed between posts.
CrestsBetweenRows crests_between_rows(const PolarGrid& grid, const terrain::TerrainView& window, bool smooth);

// Terrain of the window, and of the path from the aircraft to the window. The path may have coarser terrain.
struct PatchTerrain {
  const terrain::TerrainView* window = nullptr;
  const terrain::TerrainView* path = nullptr;
  CrestsBetweenRows crests{};  // computed if GroundArrays::crest_m is not null
  // The view that `window` smooths between posts: the same voids, water and materials, in less time. Null: `window`.
  const terrain::TerrainView* posts = nullptr;
};

// Output arrays, indexed by PolarGrid::at(); `horizon` by column.
struct GroundArrays {
  // A void has gamma 0 (SurfacePoint::gamma) and the height of the last known point between aircraft and void. Without
  // such a point, it has the height of the first known point of the column, or 0 if the whole column is void.
  SurfacePoint* surface = nullptr;
  // Horizon at row 0 by column: greatest tangent by PatchGeometry::plane_sight() of all ground nearer than
  // row 0. -1e6 if no such ground is known.
  float* horizon = nullptr;
  // For a crest between the previous row and this one, the height [m] above the map plane at which the line of sight
  // over the crest passes this row. -1e6 without a crest. Null: not computed.
  float* crest_m = nullptr;
  std::uint32_t* label = nullptr;  // surface label (map_image.hpp) of the ground; null: not computed
};

// Sampler of terrain on the polar grid, reused from map to map.
class PolarGround {
 public:
  explicit PolarGround(const physics::RadarParameters& parameters);

  // Call before the first columns of a map: sets the distances and resizes the buffers.
  void begin(const PatchGeometry& geometry, const PolarGrid& grid, const terrain::TerrainView& path);
  // Fills the columns [first, last), which are whole strips. `detail` may be null. Returns the number of samples over
  // terrain that was not loaded.
  std::size_t fill(const PatchOrder& order, const PatchGeometry& geometry, const PolarGrid& grid,
                   const PatchTerrain& terrain, const GroundTexture* detail, int first, int last,
                   const GroundArrays& arrays);

 private:
  // Buffers for one column of the grid or of the path, with `samples` samples.
  struct Column {
    explicit Column(std::size_t samples);
    physics::PositionSampler sampler;
    physics::PositionArrays positions;
    std::vector<float> distance_m, elevation_m, water, peak_m, crest;
  };
  // Coefficients of the tangent of the elevation angle, from the aircraft, of ground at one distance over ground:
  // PatchGeometry::SightLine in float.
  struct Sight {
    Sight(const PatchGeometry& geometry, double distance_m);
    float above_m, chord_m, sine, cosine, bow;
    float above_plane_m, distance_m;  // PatchGeometry::PlaneSight
  };
  int column_step(const PolarGrid& grid, const terrain::TerrainView& view, const GroundTexture* detail) const;
  int path_step(const PolarGrid& grid, const terrain::TerrainView& view) const;
  std::size_t read_window(const PatchOrder& order, const PatchGeometry& geometry, geo::Bearing azimuth,
                          const terrain::TerrainView& view, const GroundTexture* detail, std::size_t lane);
  void clear_voids(std::size_t lane);
  std::size_t read_path(const PatchGeometry& geometry, const PolarGrid& grid, geo::Bearing azimuth,
                        const terrain::TerrainView& view, float& horizon);
  void read_crests(const PatchGeometry& geometry, const PatchTerrain& terrain, std::size_t lane);
  void raise_to_summits(std::size_t lane);
  void subtract_plane(const PatchGeometry& geometry, std::size_t lane);
  void interpolate_columns(std::size_t step, bool materials);
  void prefetch_strip(const PolarGrid& grid, int column, const GroundArrays& arrays) const;
  void store_strip(const PolarGrid& grid, int strip, const GroundArrays& arrays) const;
  void store_crests(const PolarGrid& grid, int strip, float* crest_m) const;
  void read_labels(std::size_t lane, bool materials);
  void store_labels(const PolarGrid& grid, int strip, int step, std::uint32_t* label) const;

  radar::Algorithm algorithm_;
  radar::Interpolation interpolation_;
  int geodesic_knots_;
  std::unique_ptr<Column> window_, path_;
  std::unique_ptr<physics::Ground> ground_;
  std::vector<float> sin_grazing_;                                // sine of the grazing angle on the map plane, by row
  std::vector<float> sea_divisor_;                                // sin_grazing_, infinite in place of 0
  std::vector<Sight> path_sight_, row_sight_;                     // by sample of the path; by row
  std::size_t pitch_ = 0;                                         // entries per column in the arrays below
  memory::CacheAlignedVector<float> strip_height_, strip_gamma_;  // sixteen columns, one after the other
  memory::CacheAlignedVector<float> strip_crest_;  // like strip_height_; empty unless crests are computed
  std::vector<std::uint32_t> strip_label_;         // likewise; empty unless labels are computed
  float plain_gamma_;                              // gamma of land without culture
};

}  // namespace yars::model::hrm

// Sampling of cells: interpolation at one position, resampling, and CellView, the terrain view over many cells.
// Input: cells with peaks and culture; positions. Output: Surface values, resampled cells.
// Units: elevation [m MSL]; positions in degrees.
// Accuracy: interpolate() is double precision and is the reference for the fast path (terrain_view.hpp).
// Threads: one thread builds a CellView. After that, any thread may read it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "model/terrain/formats/cell.hpp"
#include "model/terrain/formats/culture.hpp"
#include "model/terrain/sampling/crests_simd.hpp"
#include "model/terrain/sampling/height_simd.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::terrain {

// Interpolates in one cell. Coordinates are degrees from the cell's south-west corner, clamped to [0, 1].
// bilinear: between the four posts around the position. nearest: the nearest of these four. cubic: Catmull-Rom (a cubic
// spline through the posts) over sixteen posts. Posts beyond the cell's edge repeat the edge. If one of the sixteen is
// void, the result is bilinear.
// bilinear and nearest leave out void posts and scale the weights of the others to a sum of 1. If the others
// have no weight, the elevation is NaN. The water fraction is the sum of the scaled weights of the posts at 0 m; cubic
// has the water fraction of bilinear.
Surface interpolate(const Cell& cell, double north_deg, double east_deg,
                    radar::Interpolation interpolation = radar::Interpolation::bilinear);

// Returns the cell with `rows` x `columns` posts. First, reduce_by() averages posts. In each dimension its factor is
// the largest divisor of the number of intervals that leaves at least as many intervals as requested. Then the new
// posts are interpolated bilinearly.
// Equal edges of neighbouring cells stay equal, and the unit of the posts does not change. A post is 0 (sea) only if
// sea has over half of the weight. A post is void only if all posts that contribute to it are void. Requires rows,
// columns >= 2.
Cell resample(const Cell& cell, int rows, int columns);

// Substitute for a one-degree cell that is not in memory.
enum class Absence : std::uint8_t {
  sea,         // 0 m, water
  none,        // void: no file, or one that cannot be read
  not_loaded,  // a file exists but the view was made without it
};

// Terrain of a one-degree cell.
struct TerrainCell {
  std::shared_ptr<const Cell> heights;
  std::shared_ptr<const Cell> peaks;       // highest ground around each post of a reduced cell; null: use the heights
  std::shared_ptr<const Culture> culture;  // null: no materials
};

// View over a set of cells; made by DirectoryTerrainStore. Its table has one entry per one-degree cell of the earth.
// surfaces() processes runs of positions in one cell. The result at a position does not depend on other positions.
// A position on the south or west edge of its cell, where that cell has no height, has the height of the edge of the
// first cell that has one: south, west, south-west. Many tiles have posts on an edge that only one of two shares.
class CellView final : public TerrainView {
 public:
  // `elsewhere` applies to every one-degree cell that neither set_absence() nor add() sets. `detail`: see has_detail().
  CellView(std::uint64_t generation, Absence elsewhere, int detail = 0);

  // Call these before the view is shared.
  void set_absence(CellCorner corner, Absence absence);
  void add(std::shared_ptr<const Cell> cell) { add(TerrainCell{std::move(cell), nullptr, nullptr}); }
  void add(TerrainCell cell);

  std::uint64_t generation() const override { return generation_; }
  std::uint64_t resident_bytes() const override { return sizeof(*this) + resident_bytes_; }
  Surface surface_at(geo::GeoPoint position, Interpolation interpolation) const override;
  bool has_detail(int detail) const override { return detail == detail_; }
  bool has_peaks() const override { return has_peaks_; }
  double post_spacing_m() const override { return post_spacing_m_; }
  PostSpacing post_spacing_at(geo::GeoPoint position) const override;
  std::vector<std::shared_ptr<const Cell>> cells_within(const GeoBox& box) const override;
  bool has_materials() const override { return has_materials_; }
  std::size_t surfaces(const PositionRun& positions, Interpolation interpolation,
                       const SurfaceRun& found) const override;
  bool crests(const PositionRun& positions, const RaySight& sight, std::span<float> tangent) const override;

 private:
  // Table entries below kFirstCell are Absence values. Entry kFirstCell + i is cells_[i].
  static constexpr std::uint16_t kFirstCell = 3;

  // Successive positions in the same one-degree cell; at least one.
  struct Run {
    std::uint16_t table_entry = static_cast<std::uint16_t>(Absence::none);
    std::size_t first = 0, count = 1;
    // PositionRun::cells_north leads to a cell beyond a pole; table_entry is then that of the cell at the pole.
    bool beyond_pole = false;
  };
  // Spacing of a cell's posts along a ray.
  struct Spacing {
    float ray_step_m = 0.0F;     // PostSpacing::ray_step_m
    bool close_columns = false;  // crests::CrossedCell::close_columns
  };
  Run run_at(const PositionRun& positions, std::size_t first) const;
  void raise_first_crest(const PositionRun& positions, const RaySight& sight, float& tangent) const;
  sampling::Near near_ground(const Run& run, const PositionRun& positions, const NearGround& near) const;
  crests::CrossedCell crossed(const Run& run, const PositionRun& positions, std::size_t i) const;
  void sample_run(const Run& run, const PositionRun& positions, Interpolation interpolation,
                  const SurfaceRun& found) const;
  void sample_singly(const Run& run, const PositionRun& positions, Interpolation interpolation,
                     const SurfaceRun& found) const;
  void fill_edges(const Run& run, const PositionRun& positions, Interpolation interpolation,
                  const SurfaceRun& found) const;
  Surface surface_in(CellCorner corner, double north_deg, double east_deg, Interpolation interpolation) const;

  std::uint16_t entry(CellCorner corner) const { return table_[slot_of(corner)]; }

  std::uint64_t generation_;
  int detail_;
  std::uint64_t resident_bytes_ = 0;
  double post_spacing_m_ = 0.0;
  bool has_peaks_ = false;
  bool has_materials_ = false;
  std::vector<TerrainCell> cells_;
  std::vector<Spacing> spacings_;  // of cells_
  std::array<std::uint16_t, static_cast<std::size_t>(kCellRows) * kCellColumns> table_;
};

}  // namespace yars::model::terrain

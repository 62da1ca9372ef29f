// Interface of the patch map algorithms: the stages that each computes in its own way, and the data that they read and
// write. PatchFormation calls the stages in the order of declaration: up to draw_pixels() for each sector, then the
// others once a map.
// Inputs: PatchInputs (order, terrain, scene, traffic), and the members of PatchData that earlier stages filled: polar
// grid, ground and horizons on the grid, image (power). The last stage fills PatchData::picture (video).
// Ground without a known elevation (a void) returns no power.
// Units: metres; heights above the map plane; horizons are tangents of elevation angles, positive above the aircraft's
// horizontal plane; power as in map_image.hpp, but brightness 0 to 1 with the algorithm `report_1996`.
// Threads: one caller at a time; stages run one after the other on the executor's threads, which write disjoint strips
// or rows. Results have equal bits for any number of threads. Source: docs/radar_maths.md, "Patch maps".
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lib/geo/quantity.hpp"
#include "lib/memory/line_vector.hpp"
#include "lib/parallel/thread_pool.hpp"
#include "model/hrm/map_image.hpp"
#include "model/hrm/patch_geometry.hpp"
#include "model/hrm/polar_ground.hpp"
#include "model/physics/environment.hpp"
#include "model/scene/placement/scene_view.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::hrm {

// Terrain, scene, movers and traffic of a map. The terrain views `window` (the map and its surroundings) and `path`
// (from the aircraft to the map) cover the regions that patch_need() returns.
struct PatchEnvironment {
  terrain::TerrainViewPointer window;
  terrain::TerrainViewPointer path;
  scene::SceneViewPointer scene;  // null: no scene
  std::vector<physics::MovingPoint> traffic{};
  std::optional<std::vector<physics::MovingPoint>> movers{};  // nullopt: those of the configuration
};

// Inputs of a map, constant for all stages.
struct PatchInputs {
  PatchOrder order;
  PatchEnvironment environment;
  parallel::Executor executor;
};

// Array on the polar grid. It never shrinks, and growth discards its contents. Rows of a strip begin at cache lines.
template <class Number>
class PolarArray {
 public:
  void resize(std::size_t size) {
    if (size <= numbers_.size()) return;
    numbers_ = {};  // frees the old array before the new one is allocated
    numbers_.resize(size);
  }
  Number* data() { return numbers_.data(); }
  const Number* data() const { return numbers_.data(); }
  std::size_t size() const { return numbers_.size(); }

 private:
  memory::CacheAlignedVector<Number> numbers_;
};

// Grid, ground and images of one map. The arrays are reused for the next sector and the next map.
struct PatchData {
  explicit PatchData(int pixels, LabelUse use = LabelUse::none) : image(pixels), labels(pixels, use) {}

  // Crests between rows, as in GroundArrays::crest_m. Null if they are not computed.
  const float* crests_m() const { return crests.any() ? crest_m.data() : nullptr; }

  std::optional<PatchGeometry> geometry;  // nullopt until the first map has its inputs
  geo::Duration formation{};              // time in which the synthetic array is formed
  PolarGrid grid;                         // with the sector that is being computed
  std::vector<int> sectors;               // as from sectors_of()
  std::size_t points = 0;                 // entries of the arrays of the largest sector
  std::vector<const scene::Tile*> tiles;  // scene tiles near the window
  PolarArray<SurfacePoint> surface;       // by PolarGrid::at()
  CrestsBetweenRows crests;               // kinds of crests to compute
  PolarArray<float> crest_m;              // as in GroundArrays::crest_m; used if crests.any() is true
  PolarArray<float> horizon;              // by column: greatest tangent of the ground nearer than the grid's row 0
  MapImage image;
  MapLabels labels;
  std::vector<std::uint8_t> picture;  // 8-bit video, row 0 at the far edge
};

// Divides the strips of the sector into ranges and calls job(first, last, thread) for each range [first, last).
template <class Job>
void parallel_for_strips(const parallel::Executor& executor, const PolarGrid& grid, const Job& job) {
  constexpr int kStripsPerTask = 2;
  parallel::parallel_for(
      executor, grid.end_strip - grid.first_strip, kStripsPerTask,
      [&](int first, int last, std::size_t thread) { job(grid.first_strip + first, grid.first_strip + last, thread); });
}

// Divides the rows of the image into ranges and calls job(first, last, thread) for each range [first, last).
template <class Job>
void parallel_for_rows(const parallel::Executor& executor, const MapImage& image, const Job& job) {
  constexpr int kRowsPerTask = 32;
  parallel::parallel_for(executor, image.size, kRowsPerTask, job);
}

class Algorithm {
 public:
  Algorithm() = default;
  Algorithm(const Algorithm&) = delete;
  Algorithm& operator=(const Algorithm&) = delete;
  virtual ~Algorithm() = default;

  // Number of cells of the polar grid (ground range by azimuth) per side of a pixel, equal in both directions.
  virtual int cells_per_pixel() const = 0;
  // True if crests between two rows of the grid raise the horizon.
  virtual bool uses_crests() const = 0;

  // True if a map may be computed in sectors. False: the sector is always the whole grid.
  virtual bool uses_sectors() const = 0;

  // Begins a map. Call it before the first stage, after geometry, grid and tiles of `data` are set. `data` must exist
  // until the last stage has run. The state of an earlier map, complete or abandoned, is discarded.
  virtual void begin(const PatchData& data) = 0;
  // Stage `terrain`: reads the terrain that only this algorithm needs. PatchFormation has filled surface, crests and
  // horizon.
  virtual void read_terrain(const PatchInputs& /*inputs*/, PatchData& /*data*/) {}
  // Stage `scene`: draws the scene's triangles on the grid, or reads them for ray casting. Triangles that lie on the
  // ground replace the gamma of the ground (SurfacePoint::gamma).
  virtual void draw_scene(const PatchInputs& inputs, PatchData& data) = 0;
  // Stage `profile`: computes shadow and radar return of ground and scene.
  virtual void cast_profiles(const PatchInputs& inputs, PatchData& data) = 0;
  // Stage `map`, for each sector: fills its pixels of PatchData::image.
  virtual void draw_pixels(const PatchInputs& inputs, PatchData& data) = 0;
  // Stage `map`, after the pixels of the last sector: adds what pixels of several sectors give. PatchFormation blanks
  // the blind zone afterwards.
  virtual void complete_map(const PatchInputs& /*inputs*/, PatchData& /*data*/) {}
  // Stage `video`: fills PatchData::picture.
  virtual void draw_video(const PatchInputs& inputs, PatchData& data) = 0;
};

}  // namespace yars::model::hrm

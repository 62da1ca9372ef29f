// Formation of one patch map (high resolution map), stage by stage.
// Inputs: a PatchOrder, terrain of the window and of the path to it, scene, traffic.
// Outputs: a square picture of 8-bit video, row 0 at the far edge, and the image before speckle and noise: power, or
// brightness with the algorithm `report_1996`.
// Use: begin(), set_environment(), then advance() until state() is `done`. A map may be abandoned by calling begin()
// again. Determinism: equal inputs give equal bits, for any number of threads. Threads: one caller at a time; stages
// run on the executor's threads. The stages that differ between algorithms are functions of hrm::Algorithm
// (algorithm.hpp). Source: docs/spec/physics.md#hrm. The states are from the 1996 report.
// Memory: image and picture, and the arrays of one sector of the polar grid (PolarGrid). A map whose grid has more
// points than a sector may have is computed sector by sector, with the same bits. The algorithm `reference` always
// holds the whole grid.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "lib/parallel/thread_pool.hpp"
#include "lib/radar/fidelity.hpp"
#include "model/hrm/algorithm.hpp"
#include "model/hrm/map_image.hpp"
#include "model/hrm/patch_geometry.hpp"
#include "model/physics/receiver.hpp"

namespace yars::model::hrm {

// reset: no map. database: waits for set_environment(). processing: a stage before the last is next. output: the last
// stage is next. done: the map is complete.
enum class PatchState : std::uint8_t { reset, database, processing, output, done };

// Names of the stages, in order.
inline constexpr std::array<std::string_view, 5> kPatchStages{"terrain", "scene", "profile", "map", "video"};

// Maximum number of points of a sector, of up to 28 bytes each. With fewer points, more strips at the borders of
// sectors are computed twice.
inline constexpr std::size_t kMaxSectorPoints = std::size_t{3} << 20U;

// Maximum size [pixels] of a map of one algorithm: a greater map would take more memory than a workstation has.
int max_map_size(radar::Algorithm algorithm);

class PatchFormation {
 public:
  // `labels`: labels to compute with each map. They change no bit of image and picture.
  PatchFormation(const physics::RadarParameters& parameters, parallel::Executor executor,
                 std::size_t sector_points = kMaxSectorPoints, LabelUse labels = LabelUse::none);
  ~PatchFormation();
  PatchFormation(PatchFormation&&) noexcept;
  PatchFormation& operator=(PatchFormation&&) noexcept;

  PatchNeed begin(const PatchOrder& order);  // returns the terrain to load; any state -> database
  void set_environment(
      const PatchEnvironment& environment);  // sets the inputs; database -> processing; another state: ends the program
  // Runs one stage; after `map` of the last sector: -> output; after `video`: -> done. After `map` of another sector
  // the stage `terrain` of the next one follows. Other states than processing and output: no effect.
  void advance();
  PatchState state() const;
  int stages_done() const;  // number of kPatchStages that are complete, for the current sector

  // Valid in state `done`: 8-bit video, row 0 at the far edge, 0 black to 255 white.
  const std::vector<std::uint8_t>& picture() const;
  // Valid after the stage `map`: power before speckle and noise, in the unit of map_image.hpp. With the algorithm
  // `report_1996`: brightness 0 to 1 before noise.
  const MapImage& image() const;
  // Valid after the stage `map`: the labels of the constructor's argument `labels`.
  const PixelLabels& labels() const;
  // Valid in state `done`: moves image, picture and labels out, so that the caller has them without a copy. image(),
  // picture() and labels() are then empty until the next map.
  struct Result {
    MapImage image;
    std::vector<std::uint8_t> picture;
    PixelLabels labels;
  };
  Result take_result();
  const PatchGeometry& geometry() const;  // valid after set_environment()
  geo::Duration formation() const;        // time in which the synthetic array is formed
  std::size_t triangles() const;          // number of triangles in the scene tiles near the window
  std::size_t posts_pending() const;      // number of samples over terrain that was not loaded

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace yars::model::hrm

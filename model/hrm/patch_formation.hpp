// A patch map in the making, as the 1996 report has it: reset, database, processing, output. The caller gives the
// terrain and the scene that the database state names, and calls advance() until the picture is there; between two
// calls it may do other things or give up. Equal input gives equal bits, for any number of threads and any slices.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "lib/parallel/thread_pool.hpp"
#include "lib/radar/configuration.hpp"
#include "model/hrm/map_image.hpp"
#include "model/hrm/patch_geometry.hpp"
#include "model/hrm/point_response.hpp"
#include "model/hrm/polar_ground.hpp"
#include "model/hrm/scene_raster.hpp"
#include "model/scene/placement/scene_view.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::hrm {

enum class PatchState : std::uint8_t { reset, database, processing, output, done };

// What the database state is given, see patch_need().
struct PatchEnvironment {
  terrain::TerrainViewPointer window;
  terrain::TerrainViewPointer path;
  scene::SceneViewPointer scene;  // null: no scene
  std::vector<physics::MovingPoint> traffic{};
};

inline constexpr std::array<std::string_view, 5> kPatchStages{"terrain", "scene", "profile", "map", "video"};

class PatchFormation {
 public:
  PatchFormation(const radar::RadarConfiguration& configuration, parallel::Executor crew);
  ~PatchFormation();
  PatchFormation(PatchFormation&&) noexcept;
  PatchFormation& operator=(PatchFormation&&) noexcept;

  PatchNeed begin(const PatchOrder& order);     // any state -> database
  void give(const PatchEnvironment& database);  // database -> processing
  void advance();                               // a stage: processing -> ... -> output -> done
  PatchState state() const;
  int stages_done() const;  // of kPatchStages

  // When done: rows from the far edge, 0 black to 255 white.
  const std::vector<std::uint8_t>& picture() const;
  // When the map stage is done: gamma of level ground, see map_image.hpp; before speckle and noise.
  const MapImage& image() const;
  const PatchGeometry& geometry() const;
  geo::Duration formation() const;
  std::size_t triangles() const;      // of the tiles of the scene that come near
  std::size_t posts_pending() const;  // samples over terrain that was not loaded

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace yars::model::hrm

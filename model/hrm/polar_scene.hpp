// Scene drawn onto the polar grid of a patch map by all threads, with the array of walls.
// Inputs: tiles and surface of PatchData. Outputs: the surface raised by the scene; walls by PolarGrid::at().
// Threads: one caller at a time; draw() uses the executor's threads.
#pragma once

#include <vector>

#include "lib/radar/configuration.hpp"
#include "model/hrm/patch_data.hpp"
#include "model/hrm/scene_raster.hpp"

namespace yars::model::hrm {

class PolarScene {
 public:
  explicit PolarScene(const radar::RadarConfiguration& configuration) : configuration_(configuration) {}

  // Call before each map: resizes the walls, and clears new ones and those left by an abandoned map.
  void begin(const PatchData& data);
  void draw(const PatchInputs& inputs, PatchData& data);

  // Null if the map has no tiles. The stage that consumes the walls also sets them to zero, and then calls set_clear().
  WallPoint* walls() { return drawn_ ? walls_.data() : nullptr; }
  void set_clear() { dirty_ = false; }

 private:
  radar::RadarConfiguration configuration_;
  std::vector<SceneRaster> rasters_;  // by thread
  PolarArray<WallPoint> walls_;
  bool drawn_ = false;  // the map has tiles
  bool dirty_ = false;  // a scene has been drawn, and its walls have not been consumed
};

}  // namespace yars::model::hrm

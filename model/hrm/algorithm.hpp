// Interface of the patch map algorithms: the stages in which they differ, in the order of PatchFormation.
// Inputs: PatchInputs, and PatchData as the stages before have left it. Outputs: PatchData, at last its picture.
// Errors: none. Terrain that is not loaded is counted by PatchFormation; a void returns no power.
// Threads: one caller at a time; stages run on the executor's threads. Equal bits for any number of threads.
// Source: docs/radar_maths.md, "Patch maps".
#pragma once

#include "model/hrm/patch_data.hpp"

namespace yars::model::hrm {

class Algorithm {
 public:
  Algorithm() = default;
  Algorithm(const Algorithm&) = delete;
  Algorithm& operator=(const Algorithm&) = delete;
  virtual ~Algorithm() = default;

  // Resolution of the polar grid: grid cells a pixel, along and across.
  virtual int cells_per_pixel() const = 0;
  // True if ground between two rows raises the horizon.
  virtual bool uses_crests() const = 0;

  // Call before the stages of each map, when geometry, grid and tiles are set. `data` must outlive the map. Discards
  // what an earlier or abandoned map has left.
  virtual void begin(const PatchData& data) = 0;
  // Stage `terrain`: reads what the algorithm needs besides surface, crests and horizon, which are filled.
  virtual void read_terrain(const PatchInputs& /*inputs*/, PatchData& /*data*/) {}
  // Stage `scene`: draws or reads the scene's tiles. Surfaces on the ground change the gain of `surface`.
  virtual void draw_scene(const PatchInputs& inputs, PatchData& data) = 0;
  // Stage `profile`: shadow and return of each column.
  virtual void cast_profiles(const PatchInputs& inputs, PatchData& data) = 0;
  // Stage `map`: fills the image. PatchFormation sets the blind zone after it.
  virtual void draw_map(const PatchInputs& inputs, PatchData& data) = 0;
  // Stage `video`: fills the picture.
  virtual void draw_video(const PatchInputs& inputs, PatchData& data) = 0;
};

}  // namespace yars::model::hrm

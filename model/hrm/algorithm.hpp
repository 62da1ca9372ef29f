// Interface of the patch map algorithms: the stages in which they differ, in the order of PatchFormation.
// Inputs: PatchInputs, and the PatchData that earlier stages filled. Outputs: PatchData, finally its picture.
// PatchFormation counts samples over terrain that is not loaded. A void returns no power.
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

  // Number of cells of the polar grid per pixel, in range and in azimuth.
  virtual int cells_per_pixel() const = 0;
  // True if crests between two rows of the grid raise the horizon.
  virtual bool uses_crests() const = 0;

  // Call before the stages of each map, when geometry, grid and tiles are set. `data` must outlive the map. State of
  // an earlier or abandoned map is discarded.
  virtual void begin(const PatchData& data) = 0;
  // Stage `terrain`: reads further terrain. PatchFormation has already filled surface, crests and horizon.
  virtual void read_terrain(const PatchInputs& /*inputs*/, PatchData& /*data*/) {}
  // Stage `scene`: draws or reads the scene's tiles. Surfaces on the ground change the gain of `surface`.
  virtual void draw_scene(const PatchInputs& inputs, PatchData& data) = 0;
  // Stage `profile`: computes shadow and return of each column.
  virtual void cast_profiles(const PatchInputs& inputs, PatchData& data) = 0;
  // Stage `map`: fills the image. PatchFormation sets the blind zone afterwards.
  virtual void draw_map(const PatchInputs& inputs, PatchData& data) = 0;
  // Stage `video`: fills the picture.
  virtual void draw_video(const PatchInputs& inputs, PatchData& data) = 0;
};

}  // namespace yars::model::hrm

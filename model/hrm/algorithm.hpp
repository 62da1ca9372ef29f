// Interface of the patch map algorithms: the stages that each algorithm computes in its own way. PatchFormation calls
// them in the order of declaration: the stages up to draw_pixels() for each sector, the others once a map.
// Inputs: PatchInputs, and the members of PatchData that earlier stages filled. Outputs: further members of PatchData;
// the last stage fills PatchData::picture.
// Ground without a known elevation (a void) returns no power.
// Threads: one caller at a time; stages run on the executor's threads. Results have equal bits for any number of
// threads.
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

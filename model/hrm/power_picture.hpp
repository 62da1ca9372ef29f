// From the power of the ground to the picture, for the algorithms that compute power.
// Inputs: an image with the power of ground and scene, in the unit of map_image.hpp. Outputs: the image with impulse
// response and point targets; 8-bit video with speckle and thermal noise.
// Threads: one caller at a time; stages run on the executor's threads.
// Source: docs/radar_maths.md, "Patch maps".
#pragma once

#include "lib/radar/configuration.hpp"
#include "model/hrm/patch_data.hpp"
#include "model/hrm/point_response.hpp"

namespace yars::model::hrm {

class PowerPicture {
 public:
  explicit PowerPicture(const radar::RadarConfiguration& configuration);

  // Applies the response and adds point targets, moving or at rest.
  void add_response_and_movers(const PatchInputs& inputs, PatchData& data);
  void draw_video(const PatchInputs& inputs, PatchData& data) const;

 private:
  double thermal_noise(const PatchInputs& inputs, const PatchData& data) const;

  radar::RadarConfiguration configuration_;
  MapMovers movers_;
  Response response_;
};

}  // namespace yars::model::hrm

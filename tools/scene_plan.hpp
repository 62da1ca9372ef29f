// A model seen from above as a picture: north up, highest surface on top, shaded by its normals with light from the
// north-west, each pixel the mean of samples within it. Pure.
#pragma once

#include "lib/imageio/png.hpp"
#include "model/scene/model.hpp"

namespace yars::tools {

enum class PlanColors { file, material };

struct PlanFrame {
  double west_m = 0.0, south_m = 0.0, metres_per_pixel = 1.0;
  int width = 0, height = 0;  // [pixels]
};

// All of the model with a margin; `width` is its longer side [pixels].
PlanFrame plan_frame(const model::scene::Model& model, int width);

imageio::Image draw_plan(const model::scene::Model& model, const PlanFrame& frame, PlanColors colors);

}  // namespace yars::tools

// What the faces of a scene return, and which of them are walls: the rules that the fast algorithm and the reference
// share.
#pragma once

#include "model/reflectivity/scene_surface.hpp"
#include "model/scene/face_kind.hpp"

namespace yars::model::hrm {

using reflectivity::SceneSurface;
using scene::kWallNormal2;
inline constexpr double kMostShading = 4.0;  // of an interpolated normal against the facet's: silhouettes are ragged

}  // namespace yars::model::hrm

// What a sweep looks into: terrain and, where there are any, polygonal scenes and traffic from outside. References: for
// the call alone.
#pragma once

#include <span>

#include "model/rbm/moving_point.hpp"
#include "model/scene/scene_view.hpp"
#include "model/terrain/terrain_view.hpp"

namespace yars::model::rbm {

struct Database {
  // Terrain alone is a database, too.
  Database(const terrain::TerrainView& given, const scene::SceneView* scenes_given = nullptr, bool whole = true,
           std::span<const MovingPoint> traffic_given = {})
      : terrain(given), scenes(scenes_given), scenes_ready(whole), traffic(traffic_given) {}

  const terrain::TerrainView& terrain;
  const scene::SceneView* scenes;  // null: none
  bool scenes_ready;               // false: some of what is wanted is still being read
  std::span<const MovingPoint> traffic;
};

}  // namespace yars::model::rbm

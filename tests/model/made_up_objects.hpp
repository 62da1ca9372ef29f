// Scenes of a few boxes for tests of scans. A scene is written as OpenFlight, read, placed on terrain and reduced to
// scatterers.
#pragma once

#include <memory>
#include <vector>

#include "lib/geo/frames.hpp"
#include "model/scene/index/scene_store.hpp"
#include "model/scene/openflight/reader.hpp"
#include "tests/model/terrain/shapes.hpp"
#include "worldgen/scene/openflight_writer.hpp"
#include "worldgen/scene/scene_builder.hpp"

namespace yars::test {

struct Building {
  double east_m = 0.0, north_m = 0.0;  // of the middle
  double east_side_m = 20.0, north_side_m = 20.0, height_m = 30.0;
  std::uint8_t material = 5;  // earthen works: no cardinal effect
};

// OpenFlight file with one object per building. A height of 0 gives a level polygon.
inline std::vector<std::byte> flt_of(const std::vector<Building>& buildings, geo::GeoPoint origin) {
  worldgen::OpenFlightWriter writer(origin);
  worldgen::MeshBuilder mesh_builder(writer);
  for (const Building& building : buildings) {
    writer.begin_object("building");
    mesh_builder.kind = {building.material, 0, 0x808080};
    const geo::Vector3 base{building.east_m, building.north_m, 0.0};
    const double e = 0.5 * building.east_side_m, n = 0.5 * building.north_side_m;
    if (building.height_m > 0.0)
      mesh_builder.box(base, building.east_side_m, building.north_side_m, building.height_m);
    else
      mesh_builder.polygon({{base.x - e, base.y - n, 0},
                            {base.x + e, base.y - n, 0},
                            {base.x + e, base.y + n, 0},
                            {base.x - e, base.y + n, 0}});
    writer.end();
  }
  return writer.take();
}

// Places the buildings at `position`. `heading_deg`: true heading of the scene's north axis.
inline model::scene::SceneViewPointer scene_of(
    const std::vector<Building>& buildings, geo::GeoPoint position, double heading_deg = 0.0,
    model::terrain::AnalyticTerrain::Height ground = model::terrain::flat(0)) {
  namespace scene = model::scene;
  const std::vector<std::byte> bytes = flt_of(buildings, position);
  const auto model = scene::read_openflight(bytes, "test.flt");
  scene::KindTable kinds;
  const auto placed = std::make_shared<scene::PlacedScene>(
      scene::place_model(*model, {position, heading_deg}, model::terrain::AnalyticTerrain(std::move(ground)), 0, kinds,
                         scene::SceneUse::scatterers));
  return std::make_shared<scene::PlacedView>(1, std::vector<std::shared_ptr<const scene::PlacedScene>>{placed},
                                             kinds.kinds(), placed->objects);
}

}  // namespace yars::test

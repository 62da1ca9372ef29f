#include "tools/trade/mark_scene.hpp"

namespace yars::tools::trade {

namespace {
constexpr std::uint8_t kMarkMaterial = 1;
constexpr double kMarkGammaDb = 40.0;  // water, which alone returns beside them, is far below
constexpr double kNothingDb = -150.0;
constexpr double kEdgeShare = 0.03;  // of the window: pixels enough for their raster to average out
}  // namespace

MarkScene::MarkScene(const model::hrm::PatchOrder& order) {
  kinds_.push_back({kMarkMaterial, 0, 0});
  const model::hrm::PatchGeometry geometry(order, radar::Fidelity(), 0.0);
  for (int row = 0; row < kMarksAnEdge; ++row)
    for (int column = 0; column < kMarksAnEdge; ++column)
      add(geometry.place_of({((column + 0.5) / kMarksAnEdge - 0.5) * geometry.window_m(),
                             (0.5 - (row + 0.5) / kMarksAnEdge) * geometry.window_m()}),
          kEdgeShare * geometry.window_m());
}

void MarkScene::add(geo::GeoPoint place, double edge_m) {
  model::scene::Tile tile;
  tile.origin = place;
  const auto half = static_cast<float>(0.5 * edge_m);
  tile.bounds = {-half, half, -half, half, 0.0F, 0.0F};
  tile.east_m = {-half, half, half, -half};
  tile.north_m = {-half, -half, half, half};
  tile.up_m.assign(4, 0.0F);
  tile.bare = 4;
  tile.corner = {{{0, 0}, {1, 2}, {2, 3}}};
  tile.on_ground = 2;
  tile.kind.assign(2, 0);
  tile.object.assign(2, static_cast<std::uint32_t>(objects_.size()));
  objects_.push_back({"mark", place, 0.0, 0.0, edge_m, edge_m, 0.0, 0});
  tiles_.push_back(std::move(tile));
}

void MarkScene::tiles_near(geo::GeoPoint /*place*/, double /*radius_m*/,
                           std::vector<const model::scene::Tile*>& found) const {
  found.clear();
  for (const model::scene::Tile& tile : tiles_) found.push_back(&tile);
}

void MarkScene::objects_near(geo::GeoPoint /*place*/, double /*radius_m*/, std::vector<std::uint32_t>& found) const {
  found.clear();
  for (std::size_t i = 0; i < objects_.size(); ++i) found.push_back(static_cast<std::uint32_t>(i));
}

radar::RadarConfiguration marks_alone(radar::RadarConfiguration configuration) {
  configuration.fidelity.map_detail = false;
  configuration.fidelity.map_response = false;
  configuration.receiver.land_gamma_db = kNothingDb;
  for (radar::Material& material : configuration.world.land.materials)
    material.gamma_db = material.code == kMarkMaterial ? kMarkGammaDb : kNothingDb;
  configuration.world.movers.clear();
  return configuration;
}

}  // namespace yars::tools::trade

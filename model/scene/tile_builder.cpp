#include "model/scene/tile_builder.hpp"

#include <algorithm>
#include <cmath>

#include "model/scene/placing.hpp"

namespace yars::model::scene {

namespace {

constexpr double kEqualNormals = 0.9999;  // cosine: less than a degree apart

bool is_curved(const std::array<PlacedCorner, 3>& corners) {
  const Vector3 area = cross(corners[1].place - corners[0].place, corners[2].place - corners[0].place);
  const double least = kEqualNormals * length(area);
  return std::any_of(corners.begin(), corners.end(),
                     [&](const PlacedCorner& corner) { return dot(corner.normal, area) < least; });
}

void find_bounds(const std::vector<float>& values, float& least, float& most) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  least = *low;
  most = *high;
}

template <class Value>
std::uint64_t bytes_in(const std::vector<Value>& values) {
  return values.capacity() * sizeof(Value);
}

}  // namespace

TileBuilders::TileBuilders(const Plane& plane, std::size_t model_vertices) : plane_(plane), copies_(model_vertices) {}

// No room for a triangle more: bare and curved vertices may both be there, three of each.
bool TileBuilders::is_full(const Builder& builder) {
  return 2 * (builder.vertices.size() + 3) > Tile::kMostVertices;
}

TileBuilders::Builder& TileBuilders::builder_at(PlanePoint point) {
  const Square square{static_cast<std::int32_t>(std::floor(point.north_m / kTileSide_m)),
                      static_cast<std::int32_t>(std::floor(point.east_m / kTileSide_m))};
  if (last_ != nullptr && square == last_square_ && !is_full(*last_)) return *last_;
  Pieces& pieces = squares_[square];
  if (pieces.empty()) {
    const PlanePoint middle{(square.second + 0.5) * kTileSide_m, (square.first + 0.5) * kTileSide_m};
    pieces.push_back(std::make_unique<Builder>(LocalMap(plane_, middle), builders_++));
  } else if (is_full(*pieces.back())) {
    pieces.push_back(std::make_unique<Builder>(pieces.back()->map, builders_++));
  }
  last_ = pieces.back().get();
  last_square_ = square;
  return *last_;
}

const LocalMap& TileBuilders::map_at(PlanePoint point) {
  return builder_at(point).map;
}

std::uint16_t TileBuilders::vertex_in(Builder& builder, const PlacedCorner& corner) {
  if (corner.vertex != kNone && copies_[corner.vertex].builder == builder.number) return copies_[corner.vertex].vertex;
  const auto number = static_cast<std::uint16_t>(builder.vertices.size());
  const PlanePoint at = builder.map.to_local({corner.place.x, corner.place.y});
  builder.vertices.push_back({static_cast<float>(at.east_m),
                              static_cast<float>(at.north_m),
                              corner.place.z,
                              {static_cast<float>(corner.normal.x), static_cast<float>(corner.normal.y),
                               static_cast<float>(corner.normal.z)}});
  if (corner.vertex != kNone) copies_[corner.vertex] = {builder.number, number};
  return number;
}

void TileBuilders::add(const std::array<PlacedCorner, 3>& corners, SurfaceTag tag) {
  const Vector3 sum = corners[0].place + corners[1].place + corners[2].place;
  Builder& builder = builder_at({sum.x / 3, sum.y / 3});
  builder.triangles.push_back(
      {{vertex_in(builder, corners[0]), vertex_in(builder, corners[1]), vertex_in(builder, corners[2])},
       tag,
       !is_curved(corners)});
}

std::vector<Tile> TileBuilders::take(double zero_msl_m) {
  copies_.clear();
  last_ = nullptr;
  std::vector<Tile> tiles;
  for (auto& [square, pieces] : squares_) {
    for (std::unique_ptr<Builder>& builder : pieces) {
      if (builder->triangles.empty()) continue;
      Tile tile;
      tile.origin = builder->map.plane().origin();
      tile.zero_msl_m = std::isfinite(zero_msl_m) ? std::floor(zero_msl_m) : 0.0;
      finish_tile(builder->vertices, builder->triangles, tile);
      builder.reset();
      find_bounds(tile.east_m, tile.bounds.east_least_m, tile.bounds.east_most_m);
      find_bounds(tile.north_m, tile.bounds.north_least_m, tile.bounds.north_most_m);
      find_bounds(tile.up_m, tile.bounds.up_least_m, tile.bounds.up_most_m);
      tiles.push_back(std::move(tile));
    }
    pieces.clear();
  }
  squares_.clear();
  return tiles;
}

std::uint64_t bytes_of(const Tile& tile) {
  return sizeof(Tile) + 3 * (bytes_in(tile.up_m) + bytes_in(tile.normal_up)) + 3 * bytes_in(tile.corner[0]) +
         bytes_in(tile.kind) + bytes_in(tile.object);
}

}  // namespace yars::model::scene

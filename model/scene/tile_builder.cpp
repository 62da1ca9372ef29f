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

TileBuilders::Builder& TileBuilders::builder_at(PlanePoint point) {
  const Square square{static_cast<std::int32_t>(std::floor(point.north_m / kTileSide_m)),
                      static_cast<std::int32_t>(std::floor(point.east_m / kTileSide_m))};
  if (last_ != nullptr && square == last_square_) return *last_;
  std::unique_ptr<Builder>& builder = builders_[square];
  if (!builder) {
    const PlanePoint middle{(square.second + 0.5) * kTileSide_m, (square.first + 0.5) * kTileSide_m};
    builder = std::make_unique<Builder>(LocalMap(plane_, middle));
    builder->tile.origin = builder->map.plane().origin();
    builder->number = static_cast<std::uint32_t>(builders_.size() - 1);
  }
  last_ = builder.get();
  last_square_ = square;
  return *builder;
}

const LocalMap& TileBuilders::map_at(PlanePoint point) {
  return builder_at(point).map;
}

std::uint32_t TileBuilders::vertex_in(Builder& builder, const PlacedCorner& corner) {
  if (corner.vertex != kNone && copies_[corner.vertex].builder == builder.number) return copies_[corner.vertex].vertex;
  Tile& tile = builder.tile;
  const auto number = static_cast<std::uint32_t>(tile.east_m.size());
  const PlanePoint at = builder.map.to_local({corner.place.x, corner.place.y});
  tile.east_m.push_back(static_cast<float>(at.east_m));
  tile.north_m.push_back(static_cast<float>(at.north_m));
  builder.altitude_m.push_back(corner.place.z);
  tile.normal_east.push_back(static_cast<float>(corner.normal.x));
  tile.normal_north.push_back(static_cast<float>(corner.normal.y));
  tile.normal_up.push_back(static_cast<float>(corner.normal.z));
  if (corner.vertex != kNone) copies_[corner.vertex] = {builder.number, number};
  return number;
}

void TileBuilders::add(const std::array<PlacedCorner, 3>& corners, SurfaceTag tag) {
  const Vector3 sum = corners[0].place + corners[1].place + corners[2].place;
  Builder& builder = builder_at({sum.x / 3, sum.y / 3});
  builder.tile.corners.push_back(
      {vertex_in(builder, corners[0]), vertex_in(builder, corners[1]), vertex_in(builder, corners[2])});
  builder.tile.kind.push_back(tag.kind);
  builder.tile.object.push_back(tag.object);
  builder.on_ground.push_back(tag.on_ground);
  builder.curved = builder.curved || is_curved(corners);
}

// Puts the triangles on the ground first; among themselves they stay in order, for the later is painted over the
// earlier.
void TileBuilders::sort_by_ground(Builder& builder) {
  Tile& tile = builder.tile;
  const std::size_t count = tile.corners.size();
  Tile sorted;
  for (const bool on_ground : {true, false}) {
    for (std::size_t t = 0; t < count; ++t) {
      if (builder.on_ground[t] != on_ground) continue;
      sorted.corners.push_back(tile.corners[t]);
      sorted.kind.push_back(tile.kind[t]);
      sorted.object.push_back(tile.object[t]);
    }
    if (on_ground) tile.on_ground = static_cast<std::uint32_t>(sorted.corners.size());
  }
  if (tile.on_ground == 0) return;
  tile.corners = std::move(sorted.corners);
  tile.kind = std::move(sorted.kind);
  tile.object = std::move(sorted.object);
}

std::vector<Tile> TileBuilders::take(double zero_msl_m) {
  copies_.clear();
  last_ = nullptr;
  std::vector<Tile> tiles;
  for (auto& [square, builder] : builders_) {
    if (builder->tile.corners.empty()) {
      builder.reset();
      continue;
    }
    sort_by_ground(*builder);
    Tile tile = std::move(builder->tile);
    tile.curved = builder->curved;
    tile.zero_msl_m = std::isfinite(zero_msl_m) ? std::floor(zero_msl_m) : 0.0;
    tile.up_m.reserve(builder->altitude_m.size());
    for (const double altitude_m : builder->altitude_m)
      tile.up_m.push_back(static_cast<float>(altitude_m - tile.zero_msl_m));
    builder.reset();
    for (std::vector<float>* values :
         {&tile.east_m, &tile.north_m, &tile.normal_east, &tile.normal_north, &tile.normal_up})
      values->shrink_to_fit();
    tile.corners.shrink_to_fit();
    tile.kind.shrink_to_fit();
    tile.object.shrink_to_fit();
    find_bounds(tile.east_m, tile.bounds.east_least_m, tile.bounds.east_most_m);
    find_bounds(tile.north_m, tile.bounds.north_least_m, tile.bounds.north_most_m);
    find_bounds(tile.up_m, tile.bounds.up_least_m, tile.bounds.up_most_m);
    tiles.push_back(std::move(tile));
  }
  builders_.clear();
  return tiles;
}

std::uint64_t bytes_of(const Tile& tile) {
  return sizeof(Tile) + 6 * bytes_in(tile.up_m) + bytes_in(tile.corners) + bytes_in(tile.kind) + bytes_in(tile.object);
}

}  // namespace yars::model::scene

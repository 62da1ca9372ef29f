#include "model/scene/placement/tile_builder.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <unordered_map>

#include "lib/geo/frames.hpp"
#include "lib/random/counter_rng.hpp"

namespace yars::model::scene {

namespace {

constexpr std::uint32_t kNoIndex = 0xffffffffU;

// Key for joining vertices: the bits of the coordinates, so that only identical positions are equal.
struct Position {
  explicit Position(const DraftVertex& vertex)
      : east_north(std::uint64_t{std::bit_cast<std::uint32_t>(vertex.east_m)} << 32U |
                   std::bit_cast<std::uint32_t>(vertex.north_m)),
        altitude(std::bit_cast<std::uint64_t>(vertex.altitude_m)) {}
  bool operator==(const Position& other) const = default;

  std::uint64_t east_north, altitude;
};
struct PositionHash {
  std::size_t operator()(const Position& position) const {
    return static_cast<std::size_t>(random::splitmix64(position.east_north ^ random::splitmix64(position.altitude)));
  }
};

// Assigns vertex indices in order of first use, and stores each vertex in the tile.
// without_normal(): returns the index of a flat triangle's vertex. The vertex is stored without a normal. Vertices at
// equal positions share one index. curved(): returns the index of a vertex of a triangle that is not flat. The vertex
// is stored with its normal.
class VertexIndexer {
 public:
  VertexIndexer(const std::vector<DraftVertex>& vertices, Tile& tile)
      : vertices_(vertices), tile_(tile), bare_(vertices.size(), kNoIndex), curved_(bare_) {}

  std::uint16_t without_normal(std::uint16_t vertex) {
    std::uint32_t& number = bare_[vertex];
    if (number == kNoIndex) {
      const auto [found, is_new] = by_position_.try_emplace(Position(vertices_[vertex]), tile_.east_m.size());
      if (is_new) append(vertices_[vertex]);
      number = found->second;
    }
    return static_cast<std::uint16_t>(number);
  }
  std::uint16_t curved(std::uint16_t vertex) {
    std::uint32_t& number = curved_[vertex];
    if (number == kNoIndex) {
      number = static_cast<std::uint32_t>(tile_.east_m.size());
      append(vertices_[vertex]);
      tile_.normal_east.push_back(vertices_[vertex].normal[0]);
      tile_.normal_north.push_back(vertices_[vertex].normal[1]);
      tile_.normal_up.push_back(vertices_[vertex].normal[2]);
    }
    return static_cast<std::uint16_t>(number);
  }

 private:
  void append(const DraftVertex& vertex) {
    tile_.east_m.push_back(vertex.east_m);
    tile_.north_m.push_back(vertex.north_m);
    tile_.up_m.push_back(static_cast<float>(vertex.altitude_m - tile_.zero_msl_m));
  }

  const std::vector<DraftVertex>& vertices_;
  Tile& tile_;
  std::vector<std::uint32_t> bare_, curved_;
  std::unordered_map<Position, std::uint32_t, PositionHash> by_position_;
};

}  // namespace

void finish_tile(const std::vector<DraftVertex>& vertices, std::vector<DraftTriangle>& triangles, Tile& tile) {
  const auto first_above_ground = std::stable_partition(
      triangles.begin(), triangles.end(), [](const DraftTriangle& triangle) { return triangle.tag.on_ground; });
  tile.on_ground = static_cast<std::uint32_t>(first_above_ground - triangles.begin());
  VertexIndexer indexer(vertices, tile);
  for (DraftTriangle& triangle : triangles)
    if (triangle.flat)
      for (std::uint16_t& corner : triangle.corners) corner = indexer.without_normal(corner);
  tile.first_with_normal = static_cast<std::uint32_t>(tile.east_m.size());
  for (DraftTriangle& triangle : triangles)
    if (!triangle.flat)
      for (std::uint16_t& corner : triangle.corners) corner = indexer.curved(corner);
  for (std::vector<float>* numbers :
       {&tile.east_m, &tile.north_m, &tile.up_m, &tile.normal_east, &tile.normal_north, &tile.normal_up})
    numbers->shrink_to_fit();
  for (std::vector<std::uint16_t>& corner : tile.corner) corner.reserve(triangles.size());
  tile.kind.reserve(triangles.size());
  tile.object.reserve(triangles.size());
  for (const DraftTriangle& triangle : triangles) {
    for (std::size_t k = 0; k < triangle.corners.size(); ++k) tile.corner[k].push_back(triangle.corners[k]);
    tile.kind.push_back(triangle.tag.kind);
    tile.object.push_back(triangle.tag.object);
  }
}

namespace {

// Cosine of 0.8 degrees. A vertex normal within this angle of the triangle's normal counts as equal to it.
constexpr double kEqualNormals = 0.9999;

bool is_curved(const std::array<PlacedCorner, 3>& corners) {
  const Vector3 area = cross(corners[1].position - corners[0].position, corners[2].position - corners[0].position);
  const double min_dot = kEqualNormals * length(area);
  return std::any_of(corners.begin(), corners.end(),
                     [&](const PlacedCorner& corner) { return dot(corner.normal, area) < min_dot; });
}

void find_bounds(const std::vector<float>& values, float& min, float& max) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  min = *low;
  max = *high;
}

template <class Value>
std::uint64_t bytes_in(const std::vector<Value>& values) {
  return values.capacity() * sizeof(Value);
}

}  // namespace

TileBuilders::TileBuilders(const geo::AzimuthalEquidistant& plane, std::size_t model_vertices)
    : plane_(plane), copies_(model_vertices) {}

// True if another triangle might not fit. A vertex may be stored twice: without a normal and with one.
bool TileBuilders::is_full(const Builder& builder) {
  return 2 * (builder.vertices.size() + 3) > Tile::kMaxVertices;
}

TileBuilders::Builder& TileBuilders::builder_at(geo::PlanePoint point) {
  const Square square{static_cast<std::int32_t>(std::floor(point.y_m / kTileSide_m)),
                      static_cast<std::int32_t>(std::floor(point.x_m / kTileSide_m))};
  if (last_ != nullptr && square == last_square_ && !is_full(*last_)) return *last_;
  Pieces& pieces = squares_[square];
  if (pieces.empty()) {
    const geo::PlanePoint middle{(square.second + 0.5) * kTileSide_m, (square.first + 0.5) * kTileSide_m};
    pieces.push_back(std::make_unique<Builder>(LocalMap(plane_, middle), builders_++));
  } else if (is_full(*pieces.back())) {
    pieces.push_back(std::make_unique<Builder>(pieces.back()->map, builders_++));
  }
  last_ = pieces.back().get();
  last_square_ = square;
  return *last_;
}

const LocalMap& TileBuilders::map_at(geo::PlanePoint point) {
  return builder_at(point).map;
}

std::uint16_t TileBuilders::vertex_in(Builder& builder, const PlacedCorner& corner) {
  if (corner.vertex != kNone && copies_[corner.vertex].builder == builder.number) return copies_[corner.vertex].vertex;
  const auto number = static_cast<std::uint16_t>(builder.vertices.size());
  const geo::PlanePoint at = builder.map.to_local({corner.position.x, corner.position.y});
  builder.vertices.push_back({static_cast<float>(at.x_m),
                              static_cast<float>(at.y_m),
                              corner.position.z,
                              {static_cast<float>(corner.normal.x), static_cast<float>(corner.normal.y),
                               static_cast<float>(corner.normal.z)}});
  if (corner.vertex != kNone) copies_[corner.vertex] = {builder.number, number};
  return number;
}

void TileBuilders::add(const std::array<PlacedCorner, 3>& corners, SurfaceTag tag) {
  const Vector3 sum = corners[0].position + corners[1].position + corners[2].position;
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
      find_bounds(tile.east_m, tile.bounds.east_min_m, tile.bounds.east_max_m);
      find_bounds(tile.north_m, tile.bounds.north_min_m, tile.bounds.north_max_m);
      find_bounds(tile.up_m, tile.bounds.up_min_m, tile.bounds.up_max_m);
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

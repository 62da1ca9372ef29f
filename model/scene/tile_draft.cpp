#include "model/scene/tile_draft.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <unordered_map>

namespace yars::model::scene {

namespace {

constexpr std::uint32_t kNoNumber = 0xffffffffU;

struct Place {
  explicit Place(const DraftVertex& vertex)
      : level(std::uint64_t{std::bit_cast<std::uint32_t>(vertex.east_m)} << 32U |
              std::bit_cast<std::uint32_t>(vertex.north_m)),
        altitude(std::bit_cast<std::uint64_t>(vertex.altitude_m)) {}
  bool operator==(const Place& other) const = default;

  std::uint64_t level, altitude;
};
struct PlaceHash {
  std::size_t operator()(const Place& place) const {
    const std::uint64_t mixed = (place.level ^ (place.altitude * 0x9e3779b97f4a7c15U)) * 0xbf58476d1ce4e5b9U;
    return static_cast<std::size_t>(mixed ^ (mixed >> 32U));
  }
};

// New numbers for the vertices of a tile, and the vertices by them.
class Numbering {
 public:
  Numbering(const std::vector<DraftVertex>& vertices, Tile& tile)
      : vertices_(vertices), tile_(tile), bare_(vertices.size(), kNoNumber), curved_(bare_) {}

  std::uint16_t bare(std::uint16_t vertex) {
    std::uint32_t& number = bare_[vertex];
    if (number == kNoNumber) {
      const auto [found, is_new] = by_place_.try_emplace(Place(vertices_[vertex]), tile_.east_m.size());
      if (is_new) put(vertices_[vertex]);
      number = found->second;
    }
    return static_cast<std::uint16_t>(number);
  }
  std::uint16_t curved(std::uint16_t vertex) {
    std::uint32_t& number = curved_[vertex];
    if (number == kNoNumber) {
      number = static_cast<std::uint32_t>(tile_.east_m.size());
      put(vertices_[vertex]);
      tile_.normal_east.push_back(vertices_[vertex].normal[0]);
      tile_.normal_north.push_back(vertices_[vertex].normal[1]);
      tile_.normal_up.push_back(vertices_[vertex].normal[2]);
    }
    return static_cast<std::uint16_t>(number);
  }

 private:
  void put(const DraftVertex& vertex) {
    tile_.east_m.push_back(vertex.east_m);
    tile_.north_m.push_back(vertex.north_m);
    tile_.up_m.push_back(static_cast<float>(vertex.altitude_m - tile_.zero_msl_m));
  }

  const std::vector<DraftVertex>& vertices_;
  Tile& tile_;
  std::vector<std::uint32_t> bare_, curved_;
  std::unordered_map<Place, std::uint32_t, PlaceHash> by_place_;
};

}  // namespace

void finish_tile(const std::vector<DraftVertex>& vertices, std::vector<DraftTriangle>& triangles, Tile& tile) {
  const auto standing = std::stable_partition(triangles.begin(), triangles.end(),
                                              [](const DraftTriangle& triangle) { return triangle.tag.on_ground; });
  tile.on_ground = static_cast<std::uint32_t>(standing - triangles.begin());
  Numbering numbering(vertices, tile);
  for (DraftTriangle& triangle : triangles)
    if (triangle.flat)
      for (std::uint16_t& corner : triangle.corners) corner = numbering.bare(corner);
  tile.bare = static_cast<std::uint32_t>(tile.east_m.size());
  for (DraftTriangle& triangle : triangles)
    if (!triangle.flat)
      for (std::uint16_t& corner : triangle.corners) corner = numbering.curved(corner);
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

}  // namespace yars::model::scene

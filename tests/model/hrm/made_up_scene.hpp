// Scene of boxes and quads on one tile, for tests with a known radar cross section.
#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "lib/geo/quantity.hpp"
#include "model/scene/placement/scene_view.hpp"

namespace yars::test {

inline constexpr std::uint8_t kStone = 3;
inline constexpr std::uint8_t kEarthenWorks = 5;  // no cardinal effect

struct Box {
  double east_m = 0.0, north_m = 0.0;  // of the middle
  double heading_deg = 0.0;            // true bearing of the length
  double length_m = 60.0, width_m = 40.0, height_m = 20.0;
  std::uint8_t material = kEarthenWorks;
};

class MadeUpScene final : public model::scene::SceneView {
 public:
  MadeUpScene(geo::GeoPoint origin, double ground_msl_m) {
    tile_.origin = origin;
    tile_.zero_msl_m = ground_msl_m;
    objects_.push_back({"all", origin, ground_msl_m, 0.0, 0.0, 0.0, 0.0, 0});
  }

  // Adds four walls and a roof as an object of its own. Output: its index in objects().
  std::uint32_t add(const Box& box) {
    const auto number = static_cast<std::uint32_t>(objects_.size());
    objects_.push_back(
        {"box", tile_.origin, tile_.zero_msl_m, box.height_m, box.length_m, box.width_m, box.heading_deg, 0});
    object_ = number;
    const double heading_rad = box.heading_deg * geo::kRadiansPerDegree;
    const auto corner = [&](double along, double across, double up) {
      const double a = 0.5 * along * box.length_m;
      const double b = 0.5 * across * box.width_m;
      return std::array<double, 3>{box.east_m + a * std::sin(heading_rad) + b * std::cos(heading_rad),
                                   box.north_m + a * std::cos(heading_rad) - b * std::sin(heading_rad),
                                   up * box.height_m};
    };
    // Signs of (along, across), counter-clockwise as seen from above. At heading 0, along is north and across is east.
    const std::array<std::array<double, 2>, 4> round{{{-1, 1}, {1, 1}, {1, -1}, {-1, -1}}};
    for (std::size_t i = 0; i < round.size(); ++i) {
      const auto& one = round[i];
      const auto& two = round[(i + 1) % round.size()];
      add_quad(
          {corner(one[0], one[1], 0), corner(two[0], two[1], 0), corner(two[0], two[1], 1), corner(one[0], one[1], 1)},
          box.material);
    }
    add_quad({corner(-1, 1, 1), corner(1, 1, 1), corner(1, -1, 1), corner(-1, -1, 1)}, box.material);
    object_ = 0;
    return number;
  }

  // Adds a quad, of object 0 unless it is part of a box. Corners: east, north, up [m], counter-clockwise as seen from
  // outside.
  void add_quad(const std::array<std::array<double, 3>, 4>& corners, std::uint8_t material) {
    const std::size_t first = tile_.east_m.size();
    std::array<double, 3> a{}, b{};
    for (std::size_t k = 0; k < 3; ++k) {
      a[k] = corners[1][k] - corners[0][k];
      b[k] = corners[3][k] - corners[0][k];
    }
    const std::array<double, 3> n{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    const double length = std::hypot(n[0], n[1], n[2]);
    for (const auto& corner : corners) {
      add_vertex(corner);
      ++tile_.first_with_normal;
    }
    // A level quad at a height below 0.5 m lies on the ground. Its triangles precede the tile's other triangles.
    const bool on_ground = n[2] > 0.98 * length && corners[0][2] < 0.5;
    for (const std::array<std::size_t, 3>& triangle :
         {std::array<std::size_t, 3>{0, 1, 2}, std::array<std::size_t, 3>{0, 2, 3}}) {
      const auto at = static_cast<std::ptrdiff_t>(on_ground ? tile_.on_ground++ : tile_.triangles());
      for (std::size_t k = 0; k < triangle.size(); ++k)
        tile_.corner[k].insert(tile_.corner[k].begin() + at, static_cast<std::uint16_t>(first + triangle[k]));
      tile_.kind.insert(tile_.kind.begin() + at, static_cast<std::uint16_t>(kinds_.size()));
      tile_.object.insert(tile_.object.begin() + at, object_);
    }
    kinds_.push_back({material, 0, 0});
  }

  std::uint64_t generation() const override { return 1; }
  std::uint64_t resident_bytes() const override { return 0; }
  const std::vector<model::scene::SurfaceKind>& kinds() const override { return kinds_; }
  const std::vector<model::scene::SceneObject>& objects() const override { return objects_; }
  void tiles_near(geo::GeoPoint /*place*/, double /*radius_m*/,
                  std::vector<const model::scene::Tile*>& found) const override {
    found.assign(1, &tile_);
  }

 private:
  void add_vertex(const std::array<double, 3>& position) {
    model::scene::Bounds& bounds = tile_.bounds;
    const auto east = static_cast<float>(position[0]);
    const auto north = static_cast<float>(position[1]);
    const auto up = static_cast<float>(position[2]);
    if (tile_.east_m.empty()) bounds = {east, east, north, north, up, up};
    bounds = {std::min(bounds.east_min_m, east),   std::max(bounds.east_max_m, east),
              std::min(bounds.north_min_m, north), std::max(bounds.north_max_m, north),
              std::min(bounds.up_min_m, up),       std::max(bounds.up_max_m, up)};
    tile_.east_m.push_back(east);
    tile_.north_m.push_back(north);
    tile_.up_m.push_back(up);
  }

  model::scene::Tile tile_;
  std::vector<model::scene::SurfaceKind> kinds_;
  std::vector<model::scene::SceneObject> objects_;
  std::uint32_t object_ = 0;  // of the quads that are added
};

}  // namespace yars::test

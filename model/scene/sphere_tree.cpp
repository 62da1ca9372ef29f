#include "model/scene/sphere_tree.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace yars::model::scene {

namespace {
constexpr std::uint32_t kLeaf = 8;        // balls that are looked at one by one
constexpr double kRounding = 1.0 + 1e-6;  // nodes are in float: their balls may not become smaller by it
constexpr double kRounding_m = 0.01;      // the same of places, up to 80 km from the origin
}  // namespace

SphereTree::SphereTree(const std::vector<Ball>& balls, std::vector<std::uint32_t>& order) {
  order.resize(balls.size());
  std::iota(order.begin(), order.end(), 0U);
  if (!balls.empty()) grow(balls, order, 0, static_cast<std::uint32_t>(balls.size()));
}

void SphereTree::grow(const std::vector<Ball>& balls, std::vector<std::uint32_t>& order, std::uint32_t first,
                      std::uint32_t end) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  geo::Vector3 least{kFar, kFar, kFar}, most{-kFar, -kFar, -kFar};
  for (std::uint32_t i = first; i < end; ++i) {
    const geo::Vector3 at = balls[order[i]].middle;
    least = {std::min(least.x, at.x), std::min(least.y, at.y), std::min(least.z, at.z)};
    most = {std::max(most.x, at.x), std::max(most.y, at.y), std::max(most.z, at.z)};
  }
  const geo::Vector3 middle = 0.5 * (least + most);
  double radius_m = 0.0;
  for (std::uint32_t i = first; i < end; ++i)
    radius_m = std::max(radius_m, length(balls[order[i]].middle - middle) + balls[order[i]].radius_m);
  const std::size_t own = nodes_.size();
  nodes_.push_back({static_cast<float>(middle.x), static_cast<float>(middle.y), static_cast<float>(middle.z),
                    static_cast<float>(radius_m * kRounding + kRounding_m), first, end, 0});
  if (end - first > kLeaf) {
    const bool by_x = most.x - least.x >= most.y - least.y;
    const auto nearer = [&](std::uint32_t a, std::uint32_t b) {
      const double at_a = by_x ? balls[a].middle.x : balls[a].middle.y;
      const double at_b = by_x ? balls[b].middle.x : balls[b].middle.y;
      return at_a != at_b ? at_a < at_b : a < b;
    };
    const std::uint32_t half = first + (end - first) / 2;
    std::nth_element(order.begin() + first, order.begin() + half, order.begin() + end, nearer);
    grow(balls, order, first, half);
    grow(balls, order, half, end);
  }
  nodes_[own].behind = static_cast<std::uint32_t>(nodes_.size());
}

}  // namespace yars::model::scene

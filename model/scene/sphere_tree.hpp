// Balls in space in an order in which neighbours lie together, with balls around ever larger runs of them: what cuts
// none of a run's ball is passed over whole, so that a search costs what it finds. Immutable once built; a search
// allocates nothing. Equal balls give equal trees.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lib/geo/vector.hpp"

namespace yars::model::scene {

struct Ball {
  geo::Vector3 middle;
  double radius_m = 0.0;
};

class SphereTree {
 public:
  SphereTree() = default;
  // `order` becomes the number of the ball that stands at each place of the tree's order.
  SphereTree(const std::vector<Ball>& balls, std::vector<std::uint32_t>& order);

  // Calls visit(first, end) with runs of that order of which meets(ball) is true for the ball around them, ascending.
  template <class Meets, class Visit>
  void search(const Meets& meets, const Visit& visit) const {
    for (std::size_t at = 0; at < nodes_.size();) {
      const Node& node = nodes_[at];
      const bool met =
          meets(Ball{{static_cast<double>(node.x_m), static_cast<double>(node.y_m), static_cast<double>(node.z_m)},
                     static_cast<double>(node.radius_m)});
      const bool leaf = node.behind == at + 1;
      if (met && leaf) visit(node.first, node.end);
      at = met ? at + 1 : node.behind;
    }
  }

  std::uint64_t bytes() const { return nodes_.capacity() * sizeof(Node); }

 private:
  struct Node {
    float x_m, y_m, z_m, radius_m;
    std::uint32_t first, end;  // in the order
    std::uint32_t behind;      // the node after all that are below this one
  };
  void grow(const std::vector<Ball>& balls, std::vector<std::uint32_t>& order, std::uint32_t first, std::uint32_t end);

  std::vector<Node> nodes_;  // each before those below it
};

}  // namespace yars::model::scene

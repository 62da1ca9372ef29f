// A tree of nodes to a model: transforms multiplied out, instances and replications multiplied, the finest level of
// detail chosen, what `filter` (null: none) leaves out left out. External files come through `load`, which answers null
// where one is to be left out. Errors: what load() fails with; more than the limits allow; nodes nested deeper than
// kDeepestNode, as instances that contain themselves are.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "lib/failure/error.hpp"
#include "model/scene/model.hpp"
#include "model/scene/name_filter.hpp"

namespace yars::model::scene {

inline constexpr int kDeepestNode = 512;

// Bounds on what a small file can blow up to by instances and replications: memory at most 1.6 GB, some ten seconds.
struct FlattenLimits {
  std::size_t triangles = 16'000'000;
  std::size_t vertices = 48'000'000;
  std::size_t visits = 256'000'000;  // of nodes and corners, each as often as it is shown
};

using LoadExternal = std::function<failure::Expected<std::shared_ptr<const Model>>(const std::string& name)>;

failure::Expected<Model> flatten(const NodeTree& tree, const std::string& subject, const LoadExternal& load,
                                 FlattenLimits limits = {}, NameFilter* filter = nullptr);

}  // namespace yars::model::scene

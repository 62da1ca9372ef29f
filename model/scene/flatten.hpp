// A tree of nodes to a model: transforms multiplied out, instances and replications multiplied, the finest level of
// detail chosen. External files come through `load`, which answers null where one is to be left out.
// Errors: what load() fails with; more than kMostTriangles or kMostVisits; nodes nested deeper than kDeepestNode, as
// instances that contain themselves are.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "lib/failure/error.hpp"
#include "model/scene/model.hpp"

namespace yars::model::scene {

inline constexpr std::size_t kMostTriangles = 16'000'000;  // with their vertices at most 1.6 GB
inline constexpr std::size_t kMostModelVertices = 48'000'000;
inline constexpr std::size_t kMostVisits = 256'000'000;  // of nodes and corners, each as often as it is shown
inline constexpr int kDeepestNode = 512;

using LoadExternal = std::function<failure::Expected<std::shared_ptr<const Model>>(const std::string& name)>;

failure::Expected<Model> flatten(const NodeTree& tree, const std::string& subject, const LoadExternal& load);

}  // namespace yars::model::scene

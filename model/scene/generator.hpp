// Made-up scenes as OpenFlight files, the same for the same order: an airfield, a harbour, a bridge, a town. z = 0 is
// the ground; of water there is none, that is the terrain's. What stands in numbers (aircraft, houses, trees) is
// defined once and shown by instances, so that a town of millions of triangles is a file of some megabytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "lib/geo/geodesic.hpp"

namespace yars::model::scene {

enum class GeneratedKind : std::uint8_t { airfield, harbour, bridge, town };
std::optional<GeneratedKind> generated_kind(std::string_view name);

struct SceneOrder {
  GeneratedKind kind = GeneratedKind::airfield;
  std::uint64_t triangles = 20'000;  // about; at least what the kind cannot do without, some thousands
  std::uint64_t seed = 1;
  geo::GeoPoint origin;
};

inline constexpr std::uint64_t kMostGenerated = 8'000'000;

struct GeneratedScene {
  std::vector<std::byte> file;
  std::uint64_t triangles = 0;  // as a reader shows them: finest level of detail, instances counted each time
};

// Called now and then with the triangles made so far.
using GenerationProgress = std::function<void(std::uint64_t triangles)>;

GeneratedScene generate_scene(const SceneOrder& order, const GenerationProgress& progress = {});

}  // namespace yars::model::scene

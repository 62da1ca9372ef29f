#include "model/scene/generator.hpp"

#include <array>
#include <utility>

#include "model/scene/generator_yard.hpp"
#include "model/scene/plane.hpp"

namespace yars::model::scene {

namespace {

struct Named {
  std::string_view name;
  GeneratedKind kind;
  void (*generate)(Yard&);
};

constexpr std::array<Named, 4> kKinds{{{"airfield", GeneratedKind::airfield, generate_airfield},
                                       {"harbour", GeneratedKind::harbour, generate_harbour},
                                       {"bridge", GeneratedKind::bridge, generate_bridge},
                                       {"town", GeneratedKind::town, generate_town}}};

}  // namespace

std::optional<GeneratedKind> generated_kind(std::string_view name) {
  for (const Named& known : kKinds)
    if (known.name == name) return known.kind;
  return std::nullopt;
}

GeneratedScene generate_scene(const SceneOrder& order, const GenerationProgress& progress) {
  Yard yard(order, progress);
  for (const Named& known : kKinds) {
    if (known.kind != order.kind) continue;
    known.generate(yard);
    const Plane plane(order.origin);
    yard.out.set_corners(plane.place_of({-yard.reach_m, -yard.reach_m}), plane.place_of({yard.reach_m, yard.reach_m}));
  }
  return {yard.out.take(), yard.triangles()};
}

}  // namespace yars::model::scene

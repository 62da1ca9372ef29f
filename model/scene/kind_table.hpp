// Kinds of surface by number, each once. Beyond 65,536 of them (colours run out first) the nearest earlier one serves:
// the first of the same material, else number 0.
#pragma once

#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "model/scene/scene_view.hpp"

namespace yars::model::scene {

class KindTable {
 public:
  std::uint16_t number_of(const SurfaceKind& kind);
  const std::vector<SurfaceKind>& kinds() const { return kinds_; }

 private:
  std::vector<SurfaceKind> kinds_;
  std::map<std::tuple<std::uint8_t, std::uint16_t, std::uint32_t>, std::uint16_t> numbers_;
};

}  // namespace yars::model::scene

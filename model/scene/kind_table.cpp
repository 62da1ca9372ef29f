#include "model/scene/kind_table.hpp"

#include <algorithm>

namespace yars::model::scene {

std::uint16_t KindTable::number_of(const SurfaceKind& kind) {
  constexpr std::size_t kMost = 65'536;
  const auto key = std::tuple(kind.material, kind.feature_id, kind.color_rgb);
  if (const auto known = numbers_.find(key); known != numbers_.end()) return known->second;
  if (kinds_.size() >= kMost) {
    const auto alike = std::find_if(kinds_.begin(), kinds_.end(),
                                    [&](const SurfaceKind& other) { return other.material == kind.material; });
    return alike == kinds_.end() ? std::uint16_t{0} : static_cast<std::uint16_t>(alike - kinds_.begin());
  }
  const auto number = static_cast<std::uint16_t>(kinds_.size());
  kinds_.push_back(kind);
  numbers_.emplace(key, number);
  return number;
}

}  // namespace yars::model::scene

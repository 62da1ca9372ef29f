#include "lib/radar/fidelity.hpp"

#include <algorithm>

#include "lib/values/presets.hpp"

namespace yars::radar {

std::span<const std::string_view> fidelity_names() {
  return values::kPresets;
}

std::optional<Fidelity> fidelity_preset(std::string_view name) {
  if (std::ranges::find(values::kPresets, name) == values::kPresets.end()) return std::nullopt;
  Fidelity fidelity;
  values::set_parameters(fidelity, name);
  fidelity.name = name;
  return fidelity;
}

}  // namespace yars::radar

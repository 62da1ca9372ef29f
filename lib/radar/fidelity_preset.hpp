// The named settings of the trade of speed against accuracy; slot `preset` of GUF and `--fidelity` of the tools.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "lib/radar/configuration.hpp"

namespace yars::radar {

// "1996", "draft", "standard", "fine", "reference": from least to most work.
std::span<const std::string_view> fidelity_names();

std::optional<Fidelity> fidelity_preset(std::string_view name);

}  // namespace yars::radar

// What is compared: a preset, or a base preset with one knob set to another value. Names are those of presets and
// GUF slots (`Fidelity`), so that a point of the picture can be typed into a configuration.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "lib/failure/error.hpp"
#include "lib/radar/configuration.hpp"

namespace yars::tools::trade {

struct Contender {
  std::string name;    // "standard", "samples=240"
  std::string family;  // "preset" or the knob: what belongs together in a picture
  radar::Fidelity fidelity;
};

// From "1996,draft"; "all" = every preset, "none" = no preset. Errors: no preset of this name.
failure::Expected<std::vector<Contender>> preset_contenders(std::string_view list);

// What is traded: a knob that does not touch it is refused.
enum class Subject : std::uint8_t { scan, map };

// From "samples=120,240". Errors: an unknown knob, a value that it does not take.
failure::Expected<std::vector<Contender>> knob_contenders(std::string_view sweep, const radar::Fidelity& base,
                                                          Subject subject);

}  // namespace yars::tools::trade

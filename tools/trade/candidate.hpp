// What is compared: presets, and knobs varied about one; the lists of numbers that options give.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lib/error/error.hpp"
#include "lib/radar/configuration.hpp"

namespace yars::tools::trade {

// Lists between commas and numbers in them, as options give them. Nothing may follow a number.

// One field at least; "" is one empty field.
std::vector<std::string_view> fields_of(std::string_view list);

std::optional<int> whole_number_of(std::string_view text);
std::optional<double> number_of(std::string_view text);  // finite

struct Bounds {
  std::string_view name;  // with its unit
  double least, most;
};

// From "37,-122": as many numbers as bounds. Errors, of bad usage, name `subject` and what `form` it takes.
error::Expected<std::vector<double>> numbers_of(std::string_view list, std::span<const Bounds> bounds,
                                                std::string_view subject, std::string_view form);

// Six digits that count, as short as can be.
std::string short_number(double value);

// What is compared: a preset, or a base preset with one knob set to another value. Names are those of presets and
// GUF slots (`Fidelity`), so that a point of the picture can be typed into a configuration.
struct Candidate {
  std::string name;    // "standard", "samples=240"
  std::string family;  // "preset" or the knob: what belongs together in a picture
  radar::Fidelity fidelity;
};

// From "1996,draft"; "all" = every preset, "none" = no preset. Errors: no preset of this name.
error::Expected<std::vector<Candidate>> preset_candidates(std::string_view list);

// What is traded: a knob that does not touch it is refused.
enum class Subject : std::uint8_t { scan, map };

// From "samples=120,240". Errors: an unknown knob, a value that it does not take.
error::Expected<std::vector<Candidate>> knob_candidates(std::string_view sweep, const radar::Fidelity& base,
                                                        Subject subject);

}  // namespace yars::tools::trade

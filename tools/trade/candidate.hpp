// Candidates of `yars trade`: the fidelities to compare. Also parses the comma-separated lists of its options.
// Errors: an unknown name, or a value out of range, is an Error of bad usage that names the option.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lib/error/error.hpp"
#include "lib/radar/fidelity.hpp"

namespace yars::tools::trade {

// Fields of a comma-separated list. At least one: "" has one empty field.
std::vector<std::string_view> fields_of(std::string_view list);

// The number in `text`; none when `text` has other characters before or after it.
std::optional<int> whole_number_of(std::string_view text);
std::optional<double> number_of(std::string_view text);  // finite

// Range of a number; both ends are allowed.
struct Bounds {
  std::string_view name;  // with its unit: "latitude [deg]"
  double min, max;
};

// Numbers of a list such as "37,-122", one for each element of `bounds`. Errors name the option `subject` and the
// expected `form` of the list.
error::Expected<std::vector<double>> numbers_of(std::string_view list, std::span<const Bounds> bounds,
                                                std::string_view subject, std::string_view form);

// At most six significant digits, without trailing zeros.
std::string short_number(double value);

// A fidelity to compare: a preset, or a base preset with one knob changed. Names equal those of presets and of GUF
// slots of `Fidelity`, so a configuration can use them.
struct Candidate {
  std::string name;    // "standard", "samples=240"
  std::string family;  // "preset" or the knob's name; a plot connects the points of one family
  radar::Fidelity fidelity;
};

// Candidates of a list of presets such as "1996,draft"; "all" = every preset, "none" = no preset.
// Errors: an unknown preset.
error::Expected<std::vector<Candidate>> preset_candidates(std::string_view list);

// Kind of picture that a trade compares. knob_candidates() accepts only knobs that affect it.
enum class Subject : std::uint8_t { scan, map };

// Candidates of a knob's values such as "samples=120,240". Errors: an unknown knob, a value that it does not take.
error::Expected<std::vector<Candidate>> knob_candidates(std::string_view sweep, const radar::Fidelity& base,
                                                        Subject subject);

}  // namespace yars::tools::trade

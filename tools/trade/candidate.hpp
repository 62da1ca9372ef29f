// Candidates of `yars trade`: the fidelities to compare.
// Errors: an unknown name, or a value out of range, is an Error of bad usage that names the field of the request.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "lib/error/error.hpp"
#include "lib/radar/fidelity.hpp"

namespace yars::tools::trade {

// A fidelity to compare: a preset, or a base preset with one knob changed. Presets and knobs have the names that a GUF
// file uses for presets and for slots of the form `Fidelity`.
struct Candidate {
  std::string name;    // "standard", "samples=240"
  std::string family;  // "preset" or the knob's name; a plot connects the points of one family
  radar::Fidelity fidelity;
};

// Candidates of a list of presets such as "1996,draft"; "all" = every preset, "none" = no preset.
// Errors: an unknown preset.
error::Expected<std::vector<Candidate>> preset_candidates(std::string_view list);

// The fidelity with its random parts off: speckle of scans and maps, texture of scans, brightness noise of 1996 maps.
// The mean power of thermal noise stays.
radar::Fidelity without_noise(radar::Fidelity fidelity);

// Kind of picture that a trade compares. knob_candidates() accepts only knobs that affect this kind.
enum class Subject : std::uint8_t { scan, map };

// Candidates of a knob's values such as "samples=120,240". Errors: an unknown knob, a value out of the knob's range.
error::Expected<std::vector<Candidate>> knob_candidates(std::string_view sweep, const radar::Fidelity& base,
                                                        Subject subject);

// Candidates of lists of presets (none: all) and of knobs, of which each changes the preset `base`. Throws
// radar::Failure for those that are not valid, or if there is no candidate.
std::vector<Candidate> candidates_of(const std::vector<std::string>& presets, const std::vector<std::string>& knobs,
                                     const std::string& base, Subject subject);

}  // namespace yars::tools::trade

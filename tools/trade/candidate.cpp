#include "tools/trade/candidate.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <utility>

#include "lib/radar/modes.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::tools::trade {

namespace {

using error::Expected;
using radar::Fidelity;

tl::unexpected<error::Error> usage_failure(std::string_view subject, std::string expected, std::string_view found) {
  return tl::unexpected(
      error::usage_error(std::string(subject), std::move(expected), std::string("'").append(found).append("'")));
}

// Sets a knob (one setting) of a fidelity from text. Returns false if the value is not allowed.
using Setter = std::function<bool(Fidelity&, std::string_view)>;

struct Knob {
  std::string_view name;
  std::string_view allowed;  // allowed values, for messages
  Setter set;
  bool of_scan, of_map;  // affects scans, affects patch maps
};

Setter whole_number(int Fidelity::* slot, int min, int max) {
  return [=](Fidelity& fidelity, std::string_view text) {
    const auto value = text::whole_number<int>(text);
    if (!value || *value < min || *value > max) return false;
    fidelity.*slot = *value;
    return true;
  };
}

Setter flag(bool Fidelity::* slot) {
  return [=](Fidelity& fidelity, std::string_view text) {
    if (text != "true" && text != "false") return false;
    fidelity.*slot = text == "true";
    return true;
  };
}

template <class Choice>
Setter choice(Choice Fidelity::* slot, std::array<std::string_view, 3> names) {
  return [=](Fidelity& fidelity, std::string_view text) {
    const auto found = std::find(names.begin(), names.end(), text);
    if (found == names.end()) return false;
    fidelity.*slot = static_cast<Choice>(found - names.begin());
    return true;
  };
}

bool set_posts_per_sample(Fidelity& fidelity, std::string_view text) {
  constexpr double kMaxPosts = 1000.0;  // the limit of the GUF slot
  const auto value = text::finite_number(text);
  if (!value || *value < 0.0 || *value > kMaxPosts) return false;
  fidelity.posts_per_sample = *value;
  return true;
}

// Knots are the 2 to 9 positions on a sweep's geodesic that are computed exactly. All other positions are interpolated
// between them, which needs two knots. With 5 or more, a Taylor series replaces the interpolation where its error is at
// most 1 mm. 0: all positions are exact.
bool set_geodesic_knots(Fidelity& fidelity, std::string_view text) {
  constexpr int kMaxKnots = 9;
  const auto value = text::whole_number<int>(text);
  if (!value || *value < 0 || *value == 1 || *value > kMaxKnots) return false;
  fidelity.geodesic_knots = *value;
  return true;
}

const std::array<Knob, 17>& knobs() {
  static const std::array<Knob, 17> all{{
      {"samples", "whole numbers 1 to 4096", whole_number(&Fidelity::samples, 1, radar::kMaxSamples), true, false},
      {"geodesicKnots", "0 or whole numbers 2 to 9", set_geodesic_knots, true, true},
      {"interpolation", "nearest, bilinear, cubic", choice(&Fidelity::interpolation, {"nearest", "bilinear", "cubic"}),
       true, true},
      {"postsPerSample", "numbers 0 to 1000", set_posts_per_sample, true, false},
      {"earth", "flat, sphere, ellipsoid", choice(&Fidelity::earth, {"flat", "sphere", "ellipsoid"}), true, true},
      {"subBeams", "whole numbers 1 to 15", whole_number(&Fidelity::sub_beams, 1, radar::kMaxSubBeams), true, false},
      {"crossTrackSlope", "true, false", flag(&Fidelity::cross_track_slope), true, false},
      {"pulseSmear", "true, false", flag(&Fidelity::pulse_smear), true, false},
      {"azimuthSmear", "true, false", flag(&Fidelity::azimuth_smear), true, false},
      {"beam", "hard-edge, gaussian, cosecant-squared",
       choice(&Fidelity::beam, {"hard-edge", "gaussian", "cosecant-squared"}), true, false},
      {"mapSize", "whole numbers 16 to 1024", whole_number(&Fidelity::map_size, 16, 1024), false, true},
      {"mapOversampling", "whole numbers 1 to 4", whole_number(&Fidelity::map_oversampling, 1, 4), false, true},
      {"mapLayover", "true, false", flag(&Fidelity::map_layover), false, true},
      {"mapResponse", "true, false", flag(&Fidelity::map_response), false, true},
      {"mapSmoothGround", "true, false", flag(&Fidelity::map_smooth_ground), false, true},
      {"mapDetail", "true, false", flag(&Fidelity::map_detail), false, true},
      {"mapDoubleBounce", "true, false", flag(&Fidelity::map_double_bounce), false, true},
  }};
  return all;
}

template <class Names>
std::string joined(const Names& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + std::string(name);
  return text;
}

std::vector<const Knob*> knobs_of(Subject subject) {
  std::vector<const Knob*> found;
  for (const Knob& knob : knobs())
    if (subject == Subject::scan ? knob.of_scan : knob.of_map) found.push_back(&knob);
  return found;
}

}  // namespace

Expected<std::vector<Candidate>> preset_candidates(std::string_view list) {
  std::vector<Candidate> found;
  if (list == "none") return found;
  std::vector<std::string_view> names = text::fields_of(list, ',');
  if (list == "all") names.assign(radar::fidelity_names().begin(), radar::fidelity_names().end());
  found.reserve(names.size());
  for (const std::string_view name : names) {
    const auto fidelity = radar::fidelity_preset(name);
    if (!fidelity) return usage_failure("--presets", joined(radar::fidelity_names()) + ", all or none", name);
    found.push_back({std::string(name), "preset", *fidelity});
  }
  return found;
}

Expected<std::vector<Candidate>> knob_candidates(std::string_view sweep, const Fidelity& base, Subject subject) {
  const std::size_t equals = sweep.find('=');
  if (equals == std::string_view::npos) return usage_failure("--knob", "KNOB=VALUE,VALUE,...", sweep);
  const std::string_view name = sweep.substr(0, equals);
  const std::vector<const Knob*> known = knobs_of(subject);
  const auto named = std::find_if(known.begin(), known.end(), [&](const Knob* knob) { return knob->name == name; });
  if (named == known.end()) {
    std::vector<std::string_view> names;
    names.reserve(known.size());
    for (const Knob* knob : known) names.push_back(knob->name);
    return usage_failure("--knob", "one of " + joined(names), name);
  }
  std::vector<Candidate> found;
  for (const std::string_view value : text::fields_of(sweep.substr(equals + 1), ',')) {
    Candidate candidate{std::string(name) + "=" + std::string(value), std::string(name), base};
    candidate.fidelity.name = candidate.name;
    if (!(*named)->set(candidate.fidelity, value))
      return usage_failure("--knob " + std::string(name), std::string((*named)->allowed), value);
    found.push_back(std::move(candidate));
  }
  return found;
}

radar::Fidelity without_noise(radar::Fidelity fidelity) {
  fidelity.noise = false;
  fidelity.map_noise = 0.0;
  return fidelity;
}

}  // namespace yars::tools::trade

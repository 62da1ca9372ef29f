#include "tools/trade/candidate.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>
#include <utility>

#include "config/schema/load.hpp"
#include "config/schema/schema.hpp"
#include "lib/text/plain_text.hpp"
#include "radar/failure.hpp"

namespace yars::tools::trade {

namespace {

using error::Expected;
using radar::Fidelity;

tl::unexpected<error::Error> usage_failure(std::string_view subject, std::string expected, std::string_view found) {
  return tl::unexpected(
      error::usage_error(std::string(subject), std::move(expected), std::string("'").append(found).append("'")));
}

// Slots of the form Fidelity that affect scans, patch maps, or both. Their values and limits are those of the form.
constexpr std::array<std::string_view, 3> kOfBoth{"geodesicKnots", "interpolation", "earth"};
constexpr std::array<std::string_view, 7> kOfScans{"samples",    "postsPerSample", "subBeams", "crossTrackSlope",
                                                   "pulseSmear", "azimuthSmear",   "beam"};
constexpr std::array<std::string_view, 7> kOfMaps{"mapSize",         "mapOversampling", "mapLayover",     "mapResponse",
                                                  "mapSmoothGround", "mapDetail",       "mapDoubleBounce"};

std::vector<std::string_view> knobs_of(Subject subject) {
  std::vector<std::string_view> names(kOfBoth.begin(), kOfBoth.end());
  const auto& more = subject == Subject::scan ? kOfScans : kOfMaps;
  names.insert(names.end(), more.begin(), more.end());
  return names;
}

// The base preset with one slot changed.
Expected<Fidelity> with_slot(const Fidelity& base, std::string_view slot, std::string_view value) {
  const auto is_plain = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '.'; };
  const std::string kind = config::value_kind(*config::find_slot(*config::find_form("Fidelity").schema, slot).schema) +
                           " for " + std::string(slot);
  if (value.empty() || !std::ranges::all_of(value, is_plain)) return usage_failure("knob", kind, value);
  auto loaded = config::load_configuration_text(
      "( Fidelity :preset " + base.name + " :" + std::string(slot) + ' ' + std::string(value) + " )", "knob");
  if (!loaded || !loaded->warnings.empty()) return usage_failure("knob", kind, value);
  return std::move(loaded->radar.fidelity);
}

template <class Names>
std::string joined(const Names& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + std::string(name);
  return text;
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
    if (!fidelity) return usage_failure("presets", joined(radar::fidelity_names()) + ", all or none", name);
    found.push_back({std::string(name), "preset", *fidelity});
  }
  return found;
}

Expected<std::vector<Candidate>> knob_candidates(std::string_view sweep, const Fidelity& base, Subject subject) {
  const std::size_t equals = sweep.find('=');
  if (equals == std::string_view::npos) return usage_failure("knob", "KNOB=VALUE,VALUE,...", sweep);
  const std::string_view name = sweep.substr(0, equals);
  const std::vector<std::string_view> known = knobs_of(subject);
  if (std::ranges::find(known, name) == known.end()) return usage_failure("knob", "one of " + joined(known), name);
  std::vector<Candidate> found;
  for (const std::string_view value : text::fields_of(sweep.substr(equals + 1), ',')) {
    auto fidelity = with_slot(base, name, value);
    if (!fidelity) return tl::unexpected(fidelity.error());
    Candidate candidate{std::string(name) + "=" + std::string(value), std::string(name), std::move(*fidelity)};
    candidate.fidelity.name = candidate.name;
    found.push_back(std::move(candidate));
  }
  return found;
}

std::vector<Candidate> candidates_of(const std::vector<std::string>& presets, const std::vector<std::string>& knobs,
                                     const std::string& base, Subject subject) {
  std::vector<Candidate> candidates;
  const auto add = [&candidates](Expected<std::vector<Candidate>> more) {
    if (!more) radar::fail(more.error());
    std::ranges::move(*more, std::back_inserter(candidates));
  };
  for (const std::string& list : presets) add(preset_candidates(list));
  if (presets.empty()) add(preset_candidates("all"));
  const auto changed = radar::fidelity_preset(base);
  if (!changed) radar::fail(usage_failure("base", "one of " + joined(radar::fidelity_names()), base).value());
  for (const std::string& sweep : knobs) add(knob_candidates(sweep, *changed, subject));
  if (candidates.empty()) radar::fail(error::usage_error("presets, knob", "a preset or a knob to compare", "none"));
  return candidates;
}

radar::Fidelity without_noise(radar::Fidelity fidelity) {
  fidelity.noise = false;
  fidelity.map_noise = 0.0;
  return fidelity;
}

}  // namespace yars::tools::trade

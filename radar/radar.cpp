#include "yars/radar.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>

#include "config/schema/load.hpp"
#include "config/schema/slot_text.hpp"
#include "radar/limits.hpp"
#include "radar/theatre.hpp"

namespace yars {

namespace {

// Checks GUF text of the caller. A warning counts as an error, because it means that a part of the text has no effect.
void check_text(const std::string& text, const char* name) {
  const auto loaded = config::load_configuration_text(text, name);
  if (!loaded) radar::fail(error::usage_error(loaded.error()));
  if (!loaded->warnings.empty())
    radar::fail(error::usage_error(name, "forms that have an effect", loaded->warnings.front()));
}

void check_preset(const std::string& preset) {
  if (preset.empty() || radar::fidelity_preset(preset)) return;
  std::string names;
  for (const std::string_view name : radar::fidelity_names()) names += (names.empty() ? "" : ", ") + std::string(name);
  radar::fail(error::usage_error("preset", "one of " + names, '\'' + text::shortened(preset) + '\''));
}

// Value of a knob as GUF. Fails for a text that is no name.
std::string guf_of(const Knob& knob) {
  if (const auto* truth = std::get_if<bool>(&knob.value)) return *truth ? "true" : "false";
  if (const auto* number = std::get_if<double>(&knob.value)) return text::text_of_number(*number);
  const auto& word = std::get<std::string>(knob.value);
  const auto is_plain = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '.'; };
  if (word.empty() || !std::ranges::all_of(word, is_plain))
    radar::fail(error::usage_error(knob.name, "a number, true, false or a name", '\'' + text::shortened(word) + '\''));
  return word;
}

// The form Fidelity of preset and knobs; empty: neither is given.
std::string fidelity_form(const RadarSettings& settings) {
  if (settings.preset.empty() && settings.knobs.empty()) return {};
  std::string form = "( Fidelity" + (settings.preset.empty() ? "" : " :preset " + settings.preset);
  for (const Knob& knob : settings.knobs) form += " :" + knob.name + ' ' + guf_of(knob);
  return form + " )\n";
}

}  // namespace

Expected<Radar> Radar::make(const RadarSettings& settings, const Call& call) {
  return radar::guarded([&] {
    const radar::Warn warn = radar::warn_of(call);
    check_preset(settings.preset);
    const std::string form = fidelity_form(settings);
    check_text(form, "knobs");
    check_text(settings.guf, "guf");
    std::string text;
    if (!settings.config_file.empty()) {
      auto converted = config::convert_configuration(settings.config_file, {});
      if (!converted) radar::fail(converted.error());
      for (const std::string& warning : converted->warnings) warn(warning);
      text = std::move(converted->text);
    }
    auto loaded = config::load_configuration_text(text + '\n' + settings.guf + '\n' + form, "guf");
    if (!loaded) radar::fail(error::usage_error(loaded.error()));
    return Radar(std::move(loaded->radar));
  });
}

Radar::Radar(radar::RadarConfiguration configuration)
    : configuration_(std::make_shared<const radar::RadarConfiguration>(std::move(configuration))) {}

const std::string& Radar::name() const {
  return configuration_->name;
}
const std::string& Radar::preset() const {
  return configuration_->fidelity.name;
}
int Radar::samples() const {
  return configuration_->fidelity.samples;
}
int Radar::map_size() const {
  return configuration_->fidelity.map_size;
}
std::string Radar::guf() const {
  const text::DecimalPoint numbers;
  return config::print_configuration(*configuration_);
}
RadarLimits Radar::limits() const {
  const radar::WindowLimits& table = configuration_->window_limits;
  RadarLimits limits;
  limits.blind_zone_deg = configuration_->high_resolution.blind_zone_deg;
  limits.azimuth_deg = configuration_->antenna.azimuth_limit_deg;
  limits.elevation_deg = configuration_->antenna.elevation_limit_deg;
  for (std::size_t i = 0; i < table.windows_nm.size(); ++i)
    limits.windows.push_back({table.windows_nm[i], table.min_range_nm[i], table.max_range_nm[i]});
  limits.power_up_nm = table.power_up_nm;
  limits.looks = static_cast<int>(configuration_->high_resolution.looks.front());
  return limits;
}
Expected<Terrain> Radar::terrain() const {
  return Terrain::open({configuration_->terrain.directory, configuration_->terrain.missing_cell_is_sea});
}

Expected<Scan> Radar::scan(const Terrain& terrain, const ScanRequest& request, const Scene* scene,
                           const Call& call) const {
  Expected<Scan> scan = Scan::prepare(*this, terrain, request, scene, call);
  if (!scan) return scan;
  if (const auto done = scan->run(call); !done) return tl::unexpected(done.error());
  scan->finish();
  return scan;
}

Expected<Patch> Radar::patch(const Terrain& terrain, const PatchRequest& request, const Scene* scene,
                             const Call& call) const {
  Expected<Patch> patch = Patch::prepare(*this, terrain, request, {scene, {}, LabelUse::heights}, call);
  if (!patch) return patch;
  if (const auto done = patch->run(call); !done) return tl::unexpected(done.error());
  patch->finish();
  return patch;
}

}  // namespace yars

#include "tools/trade/trade_table.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <limits>
#include <span>
#include <utility>

#include "config/schema/load.hpp"
#include "config/schema/schema.hpp"
#include "lib/text/plain_text.hpp"
#include "radar/limits.hpp"

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
constexpr std::array<std::string_view, 6> kOfScans{"samples",    "postsPerSample", "subBeams",
                                                   "pulseSmear", "azimuthSmear",   "beam"};
constexpr std::array<std::string_view, 7> kOfMaps{"mapSize",         "mapOversampling", "mapLayover",     "mapResponse",
                                                  "mapSmoothGround", "mapDetail",       "mapDoubleBounce"};

std::vector<std::string_view> knobs_of(Subject subject) {
  std::vector<std::string_view> names(kOfBoth.begin(), kOfBoth.end());
  if (subject == Subject::scan)
    names.insert(names.end(), kOfScans.begin(), kOfScans.end());
  else
    names.insert(names.end(), kOfMaps.begin(), kOfMaps.end());
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

namespace {

std::string number_text(double value, const char* format) {
  if (std::isnan(value)) return "-";
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

// Number without exponent. Decimals: three below 0.1, two below 10, one below 100, else none. 0 is "0"; else "<0.001"
// below 0.0005.
std::string shown_number(double value) {
  const double size = std::abs(value);
  if (size == 0.0) return "0";
  if (size < 0.0005) return "<0.001";
  return number_text(value, size < 0.1 ? "%.3f" : size < 10.0 ? "%.2f" : size < 100.0 ? "%.1f" : "%.0f");
}

std::string cell_text(const Summary& summary, double scale, bool many_scenes) {
  if (std::isnan(summary.mean)) return "-";
  std::string mean = shown_number(summary.mean * scale);
  if (!many_scenes) return mean;
  return mean + " / " + shown_number(summary.worst * scale) + " @" + std::to_string(summary.worst_scene + 1);
}

using Row = std::vector<std::string>;

std::string aligned(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths(rows.front().size(), 3);
  for (const Row& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  std::string text;
  const auto add = [&](const Row& row) {
    for (std::size_t i = 0; i < row.size(); ++i)
      text += "| " + row[i] + std::string(widths[i] - row[i].size() + 1, ' ');
    text += "|\n";
  };
  add(rows.front());
  for (const std::size_t width : widths) text += "| " + std::string(width, '-') + " ";
  text += "|\n";
  for (const Row& row : std::span(rows).subspan(1)) add(row);
  return text;
}

}  // namespace

Summary summary_of(const TradeTable& table, std::size_t candidate, std::size_t column) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  Summary summary{kNone, kNone, 0};
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t scene = 0; scene < table.scenes.size(); ++scene) {
    const double value = table.values[candidate][scene][column];
    if (std::isnan(value)) continue;
    sum += value;
    ++count;
    const bool worse =
        table.columns[column].min_is_worst ? value < summary.worst : std::abs(value) > std::abs(summary.worst);
    if (count > 1 && !worse) continue;
    summary.worst = value;
    summary.worst_scene = scene;
  }
  if (count > 0) summary.mean = sum / static_cast<double>(count);
  return summary;
}

std::string table_text(const TradeTable& table) {
  std::vector<Row> rows(1, Row{"point"});
  for (const Column& column : table.columns) rows.front().emplace_back(column.title);
  for (std::size_t candidate = 0; candidate < table.candidates.size(); ++candidate) {
    Row row{table.candidates[candidate].name};
    for (std::size_t column = 0; column < table.columns.size(); ++column) {
      const Summary summary = summary_of(table, candidate, column);
      row.push_back(cell_text(summary, table.columns[column].scale, table.scenes.size() > 1));
    }
    rows.push_back(std::move(row));
  }
  std::string text = aligned(rows) + "\n";
  for (std::size_t scene = 0; scene < table.scenes.size(); ++scene)
    text +=
        std::string("@").append(std::to_string(scene + 1)).append(": ").append(table.scenes[scene].name).append("\n");
  return text;
}

std::string csv_text(const TradeTable& table) {
  const auto exact = [](double value) { return std::isnan(value) ? std::string() : number_text(value, "%.9g"); };
  std::string text = "point,family,scene";
  for (const std::string_view name : table.scene_fields) text.append(",").append(name);
  for (const Column& column : table.columns) text.append(",").append(column.name);
  text += "\n";
  for (std::size_t candidate = 0; candidate < table.candidates.size(); ++candidate) {
    for (std::size_t i = 0; i < table.scenes.size(); ++i) {
      text += table.candidates[candidate].name + "," + table.candidates[candidate].family + "," + std::to_string(i + 1);
      for (const double value : table.scenes[i].numbers) text.append(",").append(exact(value));
      for (const double value : table.values[candidate][i]) text.append(",").append(exact(value));
      text += "\n";
    }
  }
  return text;
}

}  // namespace yars::tools::trade

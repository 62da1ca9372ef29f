#include "tools/trade_options.hpp"

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>

#include "config/load.hpp"
#include "databuffer/program.hpp"
#include "lib/file/new_file.hpp"
#include "lib/imageio/png.hpp"
#include "lib/radar/fidelity_preset.hpp"
#include "model/terrain/directory_index.hpp"
#include "tools/output_name.hpp"

namespace yars::tools {

namespace {

nlohmann::ordered_json json_of(const trade::TradeTable& table) {
  // NaN becomes null.
  nlohmann::ordered_json all;
  for (const trade::SceneRow& scene : table.scenes) all["scenes"].push_back(scene.name);
  for (std::size_t i = 0; i < table.contenders.size(); ++i) {
    nlohmann::ordered_json point{{"point", table.contenders[i].name}, {"family", table.contenders[i].family}};
    for (std::size_t column = 0; column < table.columns.size(); ++column) {
      const auto summary = trade::summary_of(table, i, column);
      nlohmann::ordered_json values;
      for (const trade::Values& row : table.values[i]) values.push_back(row[column]);
      point[std::string(table.columns[column].name)] = {{"mean", summary.mean},
                                                        {"worst", summary.worst},
                                                        {"worst_scene", summary.worst_scene + 1},
                                                        {"scenes", values}};
    }
    all["points"].push_back(std::move(point));
  }
  return all;
}

}  // namespace

void add_trade_options(CLI::App& command, TradeOptions& options) {
  command.add_option("--presets", options.presets, "names between commas, all or none");
  command.add_option("--knob", options.knobs, "KNOB=VALUE,VALUE,... about the base; repeatable")
      ->allow_extra_args(false);
  command.add_option("--base", options.base, "preset that the knobs vary")
      ->check(CLI::IsMember(std::vector<std::string>(radar::fidelity_names().begin(), radar::fidelity_names().end())));
  command.add_option("--terrain", options.terrain, "directory of cells (else the configuration's, else hills)");
  command.add_option("--ruler", options.ruler, "reference, or same: the reference algorithm with each point's knobs")
      ->check(CLI::IsMember({"reference", "same"}));
  command.add_option("--repeat", options.repeat, "warm runs to time; their median counts")->check(CLI::Range(1, 1000));
  command.add_option("--csv", options.csv, "file: a row a point and scene");
  command.add_option("--out", options.out, "file: .png of the front");
  command.add_flag("--json", options.json, "instead of the table");
}

void check_trade_output(const TradeOptions& options) {
  check_file_name("--out", options.out, {".png"});
  check_file_name("--csv", options.csv, {".csv"});
}

radar::RadarConfiguration trade_configuration(const CommonOptions& common, const TradeOptions& options) {
  auto loaded = config::load_configuration(common.config);
  if (!loaded) give_up(loaded.error());
  radar::RadarConfiguration configuration = std::move(loaded->radar);
  if (!options.terrain.empty()) configuration.terrain.directory = options.terrain;
  return configuration;
}

std::vector<trade::Contender> contenders_of(const TradeOptions& options, trade::Subject subject) {
  auto contenders = trade::preset_contenders(options.presets);
  if (!contenders) give_up(contenders.error());
  for (const std::string& sweep : options.knobs) {
    auto more = trade::knob_contenders(sweep, *radar::fidelity_preset(options.base), subject);
    if (!more) give_up(more.error());
    std::move(more->begin(), more->end(), std::back_inserter(*contenders));
  }
  if (contenders->empty()) give_up(databuffer::usage_error("yars trade", "a preset or a knob to compare", "none"));
  return std::move(*contenders);
}

void write_trade(const TradeOptions& options, const trade::TradeTable& table, const trade::Front& front) {
  if (!options.csv.empty()) {
    if (auto written = file::write_file(options.csv, trade::csv_text(table)); !written) give_up(written.error());
  }
  if (!options.out.empty()) {
    if (auto written = imageio::write_png(options.out, trade::front_picture(table, front)); !written)
      give_up(written.error());
  }
  std::printf("%s\n", options.json ? json_of(table).dump(2).c_str() : trade::table_text(table).c_str());
}

geo::GeoPoint default_place(const std::string& directory) {
  if (directory.empty()) return {37.0, -122.0};
  const auto index = model::terrain::index_directory(directory);
  if (!index) give_up(index.error());
  const auto middle = std::next(index->begin(), static_cast<std::ptrdiff_t>(index->size() / 2));
  const auto cell = model::terrain::place_of_slot(middle->first);
  return {cell.south_deg + 0.5, cell.west_deg + 0.5};
}

double thread_ms() {
  std::timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace yars::tools

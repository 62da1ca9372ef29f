// `yars trade`: speed against accuracy of the real beam map: presets and knob sweeps over scenes, against the
// reference. Table (or --json) on standard output, --csv and --out FILE.png beside it, progress on standard error.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "config/load.hpp"
#include "databuffer/program.hpp"
#include "lib/imageio/png.hpp"
#include "lib/radar/fidelity_preset.hpp"
#include "lib/radar/limits.hpp"
#include "model/kernel/scan_detail.hpp"
#include "model/terrain/directory_index.hpp"
#include "model/terrain/open_terrain.hpp"
#include "tools/command.hpp"
#include "tools/progress.hpp"
#include "tools/trade/front_picture.hpp"
#include "tools/trade/trade_table.hpp"

namespace yars::tools {

namespace {

using model::kernel::ScanRequest;
using model::terrain::TerrainView;

struct TradeOptions {
  std::string terrain, csv, out;
  std::string presets = "all", base = "standard", ruler = "reference";
  std::vector<std::string> knobs, scenes;
  double width_deg = 100.0;
  int ruler_samples = 1024, repeat = 5;
  bool json = false;
};

// The terrain of one scene by detail: each from a store of its own, so that what is resident is what it needs.
class SceneTerrain {
 public:
  SceneTerrain(const radar::TerrainConfiguration& configuration, const ScanRequest& request)
      : configuration_(configuration), request_(request) {}

  const TerrainView& at(int detail) {
    const auto known = by_detail_.find(detail);
    if (known != by_detail_.end()) return *known->second;
    auto store = model::terrain::open_terrain(configuration_);
    if (!store) give_up(store.error());
    auto view = (*store)->prepare({request_.pose.place, request_.range.metres(), detail});
    for (const std::string& problem : (*store)->take_problems()) std::fprintf(stderr, "yars: %s\n", problem.c_str());
    return *by_detail_.emplace(detail, std::move(view)).first->second;
  }

 private:
  const radar::TerrainConfiguration& configuration_;
  const ScanRequest& request_;
  std::map<int, model::terrain::TerrainViewPointer> by_detail_;
};

double thread_ms() {
  std::timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

// The whole chain to video, warm, one thread; noise as the fidelity has it.
trade::Cost cost_of(const radar::RadarConfiguration& configuration, const ScanRequest& request,
                    const TerrainView& terrain, int repeat) {
  model::kernel::OfflineScan scan(configuration, request, 1);
  std::vector<double> took_ms;
  for (int run = 0; run <= repeat; ++run) {
    const double begin_ms = thread_ms();
    scan.run(terrain);
    if (run > 0) took_ms.push_back(thread_ms() - begin_ms);  // the first warms the caches
  }
  const auto middle = took_ms.begin() + static_cast<std::ptrdiff_t>(took_ms.size() / 2);
  std::nth_element(took_ms.begin(), middle, took_ms.end());
  return {*middle, static_cast<double>(scan.power().size()) / (*middle * 1e-3),
          static_cast<double>(terrain.resident_bytes())};
}

// `same` judges the arithmetic alone: the reference algorithm with the contender's own knobs.
radar::Fidelity ruler_of(const TradeOptions& options, const radar::Fidelity& contender) {
  radar::Fidelity ruler = *radar::fidelity_preset("reference");
  if (options.ruler == "same") {
    ruler = contender;
    ruler.algorithm = radar::Algorithm::reference;
    return ruler;
  }
  ruler.samples = options.ruler_samples;
  return ruler;
}

// The contenders of one scene in turn, with the ruler that they share.
class SceneTrade {
 public:
  SceneTrade(const TradeOptions& options, const radar::RadarConfiguration& configuration, const trade::Scene& scene)
      : options_(options),
        configuration_(configuration),
        request_(trade::request_of(scene, geo::Angle::degrees(options.width_deg))),
        terrain_(configuration_.terrain, request_) {
    // Jammers reach the video alone, rain and ships hide nothing: the world stays as configured.
    if (options_.ruler == "reference") shared_ = measured_ruler(configuration_.fidelity);
  }

  trade::Values values(const radar::Fidelity& fidelity) {
    const radar::RadarConfiguration contender = with(fidelity);
    const TerrainView& terrain = terrain_.at(model::kernel::scan_detail(fidelity, request_.range));
    const trade::Cost cost = cost_of(contender, request_, terrain, options_.repeat);
    const trade::Evidence found = trade::observe(contender, request_, terrain);
    if (options_.ruler == "reference") return trade::values_of(cost, trade::errors_against(shared_, found));
    return trade::values_of(cost, trade::errors_against(measured_ruler(fidelity), found));
  }

 private:
  radar::RadarConfiguration with(const radar::Fidelity& fidelity) const {
    radar::RadarConfiguration configuration = configuration_;
    configuration.fidelity = fidelity;
    return configuration;
  }
  trade::Ruler measured_ruler(const radar::Fidelity& contender) {
    const radar::Fidelity ruler = ruler_of(options_, contender);
    return trade::make_ruler(with(ruler), request_, terrain_.at(model::kernel::scan_detail(ruler, request_.range)));
  }

  const TradeOptions& options_;
  const radar::RadarConfiguration& configuration_;
  ScanRequest request_;
  SceneTerrain terrain_;
  trade::Ruler shared_;
};

// The middle one of the cells, so that there is ground about it; the built-in hills are everywhere.
geo::GeoPoint default_place(const std::string& directory) {
  if (directory.empty()) return {37.0, -122.0};
  const auto index = model::terrain::index_directory(directory);
  if (!index) give_up(index.error());
  const auto middle = std::next(index->begin(), static_cast<std::ptrdiff_t>(index->size() / 2));
  const auto cell = model::terrain::place_of_slot(middle->first);
  return {cell.south_deg + 0.5, cell.west_deg + 0.5};
}

std::vector<trade::Scene> scenes_of(const TradeOptions& options, const std::string& directory) {
  std::vector<trade::Scene> scenes;
  for (const std::string& text : options.scenes) {
    const auto scene = trade::scene_of(text);
    if (!scene) give_up(scene.error());
    scenes.push_back(*scene);
  }
  if (!scenes.empty()) return scenes;
  trade::Scene scene;
  scene.place = default_place(directory);
  for (const double range_nm : {10.0, 40.0, 160.0}) {
    scene.range_nm = range_nm;
    scenes.push_back(scene);
  }
  return scenes;
}

std::vector<trade::Contender> contenders_of(const TradeOptions& options) {
  auto contenders = trade::preset_contenders(options.presets);
  if (!contenders) give_up(contenders.error());
  for (const std::string& sweep : options.knobs) {
    auto more = trade::knob_contenders(sweep, *radar::fidelity_preset(options.base));
    if (!more) give_up(more.error());
    std::move(more->begin(), more->end(), std::back_inserter(*contenders));
  }
  if (contenders->empty()) give_up(databuffer::usage_error("yars trade", "a preset or a knob to compare", "none"));
  return std::move(*contenders);
}

nlohmann::ordered_json json_of(const trade::TradeTable& table) {
  // NaN becomes null.
  nlohmann::ordered_json all;
  for (const trade::Scene& scene : table.scenes) all["scenes"].push_back(trade::scene_name(scene));
  for (std::size_t i = 0; i < table.contenders.size(); ++i) {
    nlohmann::ordered_json point{{"point", table.contenders[i].name}, {"family", table.contenders[i].family}};
    for (std::size_t column = 0; column < trade::kColumnNames.size(); ++column) {
      const auto summary = trade::summary_of(table, i, static_cast<trade::Column>(column));
      nlohmann::ordered_json values;
      for (const trade::Values& row : table.values[i]) values.push_back(row[column]);
      point[std::string(trade::kColumnNames[column])] = {{"mean", summary.mean},
                                                         {"worst", summary.worst},
                                                         {"worst_scene", summary.worst_scene + 1},
                                                         {"scenes", values}};
    }
    all["points"].push_back(std::move(point));
  }
  return all;
}

void write_text(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.flush();
  if (!file) give_up({path, "a file that can be written", "an error", "check the folder and the space left"});
}

trade::TradeTable run_trade(const TradeOptions& options, const radar::RadarConfiguration& configuration) {
  trade::TradeTable table;
  table.contenders = contenders_of(options);
  table.scenes = scenes_of(options, configuration.terrain.directory);
  table.values.resize(table.contenders.size());
  Progress progress(table.contenders.size() * table.scenes.size(), stderr);
  for (const trade::Scene& scene : table.scenes) {
    SceneTrade scene_trade(options, configuration, scene);
    for (std::size_t i = 0; i < table.contenders.size(); ++i) {
      table.values[i].push_back(scene_trade.values(table.contenders[i].fidelity));
      progress.done(table.contenders[i].name + ", " + trade::scene_name(scene));
    }
  }
  return table;
}

void trade_off(const CommonOptions& common, const TradeOptions& options) {
  if (!options.out.empty() && std::filesystem::path(options.out).extension() != ".png")
    give_up(databuffer::usage_error("--out", "a name that ends in .png", options.out));
  auto loaded = config::load_configuration(common.config);
  if (!loaded) give_up(loaded.error());
  radar::RadarConfiguration configuration = std::move(loaded->radar);
  if (!options.terrain.empty()) configuration.terrain.directory = options.terrain;
  const trade::TradeTable table = run_trade(options, configuration);
  if (!options.csv.empty()) write_text(options.csv, trade::csv_text(table));
  if (!options.out.empty()) {
    if (auto written = imageio::write_png(options.out, trade::front_picture(table)); !written) give_up(written.error());
  }
  std::printf("%s\n", options.json ? json_of(table).dump(2).c_str() : trade::table_text(table).c_str());
}

}  // namespace

void add_trade_command(CLI::App& app, const CommonOptions& common) {
  auto options = std::make_shared<TradeOptions>();
  CLI::App* command = app.add_subcommand("trade", "speed against accuracy of the real beam map");
  command->add_option("--presets", options->presets, "names between commas, all or none");
  command->add_option("--knob", options->knobs, "KNOB=VALUE,VALUE,... about the base; repeatable")
      ->allow_extra_args(false);
  command->add_option("--base", options->base, "preset that the knobs vary")
      ->check(CLI::IsMember(std::vector<std::string>(radar::fidelity_names().begin(), radar::fidelity_names().end())));
  command->add_option("--terrain", options->terrain, "directory of cells (else the configuration's, else hills)");
  command->add_option("--scene", options->scenes, "LAT,LON,ALT_FT,HDG,RANGE_NM; repeatable")->allow_extra_args(false);
  command->add_option("--scan-width", options->width_deg, "[deg]")->check(CLI::Range(1.0, 120.0));
  command->add_option("--ruler", options->ruler, "reference, or same: the reference algorithm with each point's knobs")
      ->check(CLI::IsMember({"reference", "same"}));
  command->add_option("--ruler-samples", options->ruler_samples, "a sweep")->check(CLI::Range(1, radar::kMaxSamples));
  command->add_option("--repeat", options->repeat, "warm scans to time; their median counts")
      ->check(CLI::Range(1, 1000));
  command->add_option("--csv", options->csv, "file: a row a point and scene");
  command->add_option("--out", options->out, "file: .png of the front");
  command->add_flag("--json", options->json, "instead of the table");
  command->callback([options, &common] { trade_off(common, *options); });
}

}  // namespace yars::tools

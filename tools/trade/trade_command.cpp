#include "tools/trade/trade_command.hpp"

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <iterator>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "lib/file/output_file.hpp"
#include "lib/radar/configuration.hpp"
#include "lib/radar/modes.hpp"
#include "model/kernel/tick_inputs.hpp"
#include "model/terrain/store/cell_files.hpp"
#include "model/terrain/store/directory_store.hpp"
#include "radar/limits.hpp"
#include "runtime/program.hpp"
#include "tools/command/command.hpp"
#include "tools/trade/scenes.hpp"
#include "tools/trade/trade_table.hpp"

namespace yars::tools {

namespace {

nlohmann::ordered_json json_of(const trade::TradeTable& table, const trade::PlotAxes& axes) {
  nlohmann::ordered_json all;
  const auto axis = [&table](const trade::PlotAxes::Axis& one) {
    return nlohmann::ordered_json{{"column", table.columns[one.column].name}, {"title", one.title}};
  };
  all["axes"] = {{"time", axis(axes.time)}, {"errors", {axis(axes.errors[0]), axis(axes.errors[1])}}};
  for (const trade::SceneRow& scene : table.scenes) all["scenes"].push_back(scene.name);
  for (std::size_t i = 0; i < table.candidates.size(); ++i) {
    nlohmann::ordered_json point{{"point", table.candidates[i].name}, {"family", table.candidates[i].family}};
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

std::string json_text(const TradeResult& result) {
  nlohmann::ordered_json all = json_of(result.table, result.axes);
  all["left_out"] = result.left_out;
  return all.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

void write_trade_files(const std::string& csv, const std::string& out, const TradeResult& result) {
  if (!csv.empty()) {
    if (auto written = file::write_file(csv, trade::csv_text(result.table)); !written) throw_failure(written.error());
  }
  if (!out.empty()) {
    if (auto written = file::write_file(out, json_text(result) + "\n"); !written) throw_failure(written.error());
  }
}

geo::GeoPoint default_position(const std::string& directory) {
  if (directory.empty()) return {37.0, -122.0};
  const auto index = model::terrain::index_directory(directory);
  if (!index) throw_failure(index.error());
  const auto middle = std::next(index->begin(), static_cast<std::ptrdiff_t>(index->size() / 2));
  const auto cell = model::terrain::corner_of_slot(middle->first);
  return {cell.south_deg + 0.5, cell.west_deg + 0.5};
}

void check_above_ground(const char* field, geo::AltitudeMsl altitude, double ground_m) {
  auto problem = radar::beneath_ground(altitude, ground_m);
  if (!problem) return;
  problem->subject = field;
  problem->action = "give a greater ALT_FT";
  throw_failure(*problem);
}

double thread_ms() {
  std::timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

// `yars trade`: speed against accuracy of the real beam map. Compares presets, and series of values of one setting
// (knob), with the reference. A scene is the geometry of one scan: position, altitude, heading and range (scenes.hpp).
// Prints the result on standard output, progress on a terminal.

namespace {

using model::kernel::ScanRequest;
using model::terrain::TerrainView;

// Terrain views of one scene, one view per detail level (TerrainRegion::detail). Each view has a separate store, so
// resident_bytes() counts the cells of that level only.
class SceneTerrain {
 public:
  SceneTerrain(const radar::TerrainConfiguration& configuration, const ScanRequest& request, const Warn& warn,
               LeftOut& left_out)
      : configuration_(configuration), request_(request), warn_(warn), left_out_(left_out) {}

  const TerrainView& at(int detail) {
    const auto known = by_detail_.find(detail);
    if (known != by_detail_.end()) return *known->second;
    auto store = model::terrain::open_terrain(configuration_);
    if (!store) throw_failure(store.error());
    auto view = (*store)->prepare({request_.pose.position, request_.range.metres(), detail});
    radar::check_terrain_read(warn_, configuration_.directory, **store);
    left_out_.add(**store);
    check_above_ground("scene", request_.pose.altitude, view->elevation_m(request_.pose.position));
    return *by_detail_.emplace(detail, std::move(view)).first->second;
  }

 private:
  const radar::TerrainConfiguration& configuration_;
  const ScanRequest& request_;
  const Warn& warn_;
  LeftOut& left_out_;
  std::map<int, model::terrain::TerrainViewPointer> by_detail_;
};

// Median cost of a scan from terrain to video, with warm caches, on one thread, with noise if the fidelity has it. The
// reference algorithm is slow, so it runs once.
trade::Cost cost_of(const radar::RadarConfiguration& configuration, const ScanRequest& request,
                    const TerrainView& terrain, int repeat, const parallel::GoesOn& goes_on) {
  model::kernel::OfflineScan scan(configuration, request, 1);
  std::vector<double> took_ms;
  const bool once = configuration.fidelity.algorithm == radar::Algorithm::reference;
  for (int run = once ? repeat : 0; run <= repeat; ++run) {
    const double begin_ms = thread_ms();
    scan.run(terrain, goes_on);
    if (run > 0) took_ms.push_back(thread_ms() - begin_ms);  // run 0 warms the caches
  }
  const double median_ms = median(took_ms);
  return {median_ms, static_cast<double>(scan.power().size()) / (median_ms * 1e-3),
          static_cast<double>(terrain.resident_bytes())};
}

// Fidelity of the ruler (the scan with which candidates are compared). With --ruler same, the ruler has the candidate's
// settings and the reference algorithm. Then only the error of the algorithm is measured.
radar::Fidelity ruler_of(const ScanTradeRequest& trade, const radar::Fidelity& candidate) {
  radar::Fidelity ruler = *radar::fidelity_preset("reference");
  if (trade.ruler == TradeRuler::same) {
    ruler = candidate;
    ruler.algorithm = radar::Algorithm::reference;
    return ruler;
  }
  ruler.samples = trade.ruler_samples;
  return ruler;
}

// The candidate is its own ruler. Candidates of --knob have other names than presets.
bool is_ruler(const ScanTradeRequest& trade, const radar::Fidelity& candidate) {
  if (trade.ruler == TradeRuler::same) return candidate.algorithm == radar::Algorithm::reference;
  return candidate.name == "reference" && candidate.samples == trade.ruler_samples;
}

// Measures the candidates for one scene. With --ruler reference, all candidates are compared with the same scan.
class SceneTrade {
 public:
  SceneTrade(const ScanTradeRequest& trade, const radar::RadarConfiguration& configuration, const trade::Scene& scene,
             const Warn& warn, LeftOut& left_out, const parallel::GoesOn& goes_on)
      : trade_(trade),
        configuration_(configuration),
        goes_on_(goes_on),
        request_(trade::request_of(scene, geo::Angle::degrees(trade.width_deg), configuration.antenna)),
        terrain_(configuration_.terrain, request_, warn, left_out) {
    // Jammers, rain and ships stay as configured in all scans. Jammers affect only the video; rain and ships cast no
    // shadow.
    if (trade_.ruler == TradeRuler::reference) shared_ = measured_ruler(configuration_.fidelity);
  }

  trade::Values values(const radar::Fidelity& fidelity) {
    const radar::RadarConfiguration candidate = with(fidelity);
    const TerrainView& terrain = terrain_.at(model::kernel::scan_detail(fidelity, request_.range));
    const trade::Cost cost = cost_of(candidate, request_, terrain, trade_.repeat, goes_on_);
    const trade::Ruler& ruler = trade_.ruler == TradeRuler::reference ? shared_ : (own_ = measured_ruler(fidelity));
    if (is_ruler(trade_, fidelity))  // it is not computed again
      return trade::values_of(cost, trade::errors_against(ruler, ruler.observation));
    const trade::ScanObservation found = trade::observe(candidate, request_, terrain, goes_on_);
    return trade::values_of(cost, trade::errors_against(ruler, found));
  }

 private:
  radar::RadarConfiguration with(const radar::Fidelity& fidelity) const {
    radar::RadarConfiguration configuration = configuration_;
    configuration.fidelity = fidelity;
    return configuration;
  }
  trade::Ruler measured_ruler(const radar::Fidelity& candidate) {
    const radar::Fidelity ruler = ruler_of(trade_, candidate);
    return trade::make_ruler(with(ruler), request_, terrain_.at(model::kernel::scan_detail(ruler, request_.range)),
                             goes_on_);
  }

  const ScanTradeRequest& trade_;
  const radar::RadarConfiguration& configuration_;
  const parallel::GoesOn& goes_on_;
  ScanRequest request_;
  SceneTerrain terrain_;
  trade::Ruler shared_, own_;  // of all candidates, and of the last one
};

std::vector<trade::Scene> scenes_of(const std::vector<std::string>& texts, const std::string& directory) {
  std::vector<trade::Scene> scenes;
  for (const std::string& text : texts) {
    const auto scene = trade::scene_of(text);
    if (!scene) throw_failure(scene.error());
    scenes.push_back(*scene);
  }
  if (!scenes.empty()) return scenes;
  trade::Scene scene;
  scene.position = default_position(directory);
  for (const double range_nm : {10.0, 40.0, 160.0}) {
    scene.range_nm = range_nm;
    scenes.push_back(scene);
  }
  return scenes;
}

}  // namespace

TradeResult measure_trade(const ScanTradeRequest& request, const radar::RadarConfiguration& configuration,
                          const Warn& warn, const parallel::GoesOn& goes_on) {
  radar::check_fields(request);
  trade::TradeTable table;
  table.columns = trade::kScanColumns;
  table.scene_fields = trade::kScanFields;
  table.candidates = trade::candidates_of(request.presets, request.knob, request.base, trade::Subject::scan);
  table.values.resize(table.candidates.size());
  const std::vector<trade::Scene> scenes = scenes_of(request.scene, configuration.terrain.directory);
  Progress progress(table.candidates.size() * scenes.size());
  LeftOut left_out;
  for (const trade::Scene& scene : scenes) {
    table.scenes.push_back(trade::row_of(scene));
    SceneTrade scene_trade(request, configuration, scene, warn, left_out, goes_on);
    for (std::size_t i = 0; i < table.candidates.size(); ++i) {
      table.values[i].push_back(scene_trade.values(table.candidates[i].fidelity));
      progress.done(table.candidates[i].name + ", " + trade::scene_name(scene));
    }
  }
  return {std::move(table),
          {{trade::kScanMs, "time per scan (ms of one core)"},
           {{{trade::kScanGray, "video error (gray levels of 255 RMS)"},
             {trade::kScanShadow, "shadow mismatch (% of ground)"}}}},
          left_out.sentences()};
}

namespace {

// Adds the options of a trade, and what it does. `name`: of the command, for warnings.
template <class Request>
void add_trade(runtime::Command command, const CommonOptions& common, const char* name) {
  struct Options {
    Request request;
    ConfigurationOptions configuration;
    std::string csv, out;
    bool json = false;
  };
  const auto options = std::make_shared<Options>();
  add_request_options(command, options->request);
  command.find("--presets").value_name("NAMES");
  command.find("--knob").value_name("VALUES");
  command.find("--base").one_of({radar::fidelity_names().begin(), radar::fidelity_names().end()});
  add_terrain_option(command, options->configuration.terrain).otherwise("the configuration's, else built-in hills");
  command.option("--csv", options->csv, "CSV file with one row per candidate and scene")
      .value_name("FILE")
      .otherwise("none");
  command.option("--out", options->out, "JSON file (.json), which plot_trade draws")
      .value_name("FILE")
      .otherwise("none");
  add_json_flag(command, options->json, "print one JSON object in place of the table");
  command.callback([command, options, &common, name] {
    if (command.has_subcommand()) return;
    check_file_name("--out", options->out, {".json"});
    check_file_name("--csv", options->csv, {".csv"});
    const radar::RadarConfiguration configuration = read_configuration(common.config, options->configuration);
    const TradeResult result = measure_trade(options->request, configuration, warn_as(name));
    write_trade_files(options->csv, options->out, result);
    std::printf("%s\n", options->json ? json_text(result).c_str() : trade::table_text(result.table).c_str());
    std::fflush(stdout);
    fail_if_left_out(result.left_out);
  });
}

}  // namespace

void add_trade_command(runtime::Command app, const CommonOptions& common) {
  runtime::Command scans =
      app.subcommand("trade", "speed against accuracy of the real beam map; `trade maps`: of patch maps");
  add_trade<ScanTradeRequest>(scans, common, "yars trade");
  scans.find("--scene").value_name("SCENE");
  runtime::Command maps = scans.subcommand("maps", "speed against accuracy of patch maps");
  add_trade<MapTradeRequest>(maps, common, "yars trade maps");
  maps.find("--scene").value_name("FILE");
  maps.find("--scene-without").value_name("NAME");
  maps.find("--view").value_name("VIEW");
}

}  // namespace yars::tools

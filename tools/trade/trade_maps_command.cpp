// `yars trade maps`: speed against accuracy of patch maps. Compares presets, and series of values of one setting
// (knob), with the reference over several views. Prints progress on a terminal.

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "model/scene/index/scene_index.hpp"
#include "model/scene/index/scene_store.hpp"
#include "model/terrain/store/directory_store.hpp"
#include "radar/limits.hpp"
#include "tools/command/command.hpp"
#include "tools/trade/scenes.hpp"
#include "tools/trade/trade_command.hpp"
#include "tools/trade/trade_errors.hpp"
#include "tools/trade/trade_table.hpp"

namespace yars::tools {

namespace {

namespace hrm = model::hrm;

// Terrain and scenes of one map view. Each detail level of the terrain (TerrainRegion::detail) has a separate store, so
// resident_bytes() counts only the cells of that level.
class ViewEnvironment {
 public:
  ViewEnvironment(const radar::RadarConfiguration& configuration, const Warn& warn, LeftOut& left_out)
      : configuration_(configuration), warn_(warn), left_out_(left_out) {}

  hrm::PatchEnvironment of(const hrm::PatchNeed& need) {
    if (!scene_known_) scene_ = read_scene(need);
    scene_known_ = true;
    return {terrain(need.window, window_), terrain(need.path, path_), scene_};
  }

 private:
  using ByDetail = std::map<int, model::terrain::TerrainViewPointer>;

  const model::terrain::TerrainViewPointer& terrain(const model::terrain::TerrainRegion& region, ByDetail& known) {
    const auto found = known.find(region.detail);
    if (found != known.end()) return found->second;
    auto store = model::terrain::open_terrain(configuration_.terrain);
    if (!store) throw_failure(store.error());
    auto view = (*store)->prepare(region);
    radar::check_terrain_read(warn_, configuration_.terrain.directory, **store);
    left_out_.add(**store);
    return known.emplace(region.detail, std::move(view)).first->second;
  }

  model::scene::SceneViewPointer read_scene(const hrm::PatchNeed& need) const {
    auto scenes = model::scene::open_scenes(configuration_.world.scenes, configuration_.terrain);
    if (!scenes) throw_failure(scenes.error());
    if (!*scenes) return nullptr;
    auto view = (*scenes)->prepare(need.window);
    radar::check_scenes_read(warn_, **scenes);
    left_out_.add(**scenes);
    return view;
  }

  const radar::RadarConfiguration& configuration_;
  const Warn& warn_;
  LeftOut& left_out_;
  ByDetail window_, path_;
  model::scene::SceneViewPointer scene_;
  bool scene_known_ = false;
};

// Measures the candidates for one map view. With --ruler reference, all candidates are compared with the same map.
class ViewTrade {
 public:
  ViewTrade(const MapTradeRequest& trade, const radar::RadarConfiguration& configuration, const trade::MapView& view,
            const Warn& warn, LeftOut& left_out, const parallel::GoesOn& goes_on)
      : trade_(trade),
        configuration_(configuration),
        goes_on_(goes_on),
        order_(trade::order_of(view)),
        environment_(configuration_, warn, left_out) {
    if (trade_.ruler == TradeRuler::same) return;
    radar::Fidelity reference = *radar::fidelity_preset("reference");
    reference.map_size = trade_.ruler_size;
    shared_ = observe(reference);
  }

  trade::Values values(const radar::Fidelity& fidelity) {
    const trade::MapObservation found = observe(fidelity);
    const hrm::PatchEnvironment environment = environment_of(fidelity);
    const auto bytes = static_cast<double>(environment.window->resident_bytes() + environment.path->resident_bytes());
    const trade::MapCost cost{time_of(fidelity, environment, found), bytes};
    if (trade_.ruler == TradeRuler::reference) return trade::values_of(cost, trade::errors_against(shared_, found));
    radar::Fidelity same = fidelity;
    same.algorithm = radar::Algorithm::reference;
    return trade::values_of(cost, trade::errors_against(observe(same), found));
  }

 private:
  radar::RadarConfiguration with(const radar::Fidelity& fidelity) const {
    radar::RadarConfiguration configuration = configuration_;
    configuration.fidelity = fidelity;
    return configuration;
  }
  hrm::PatchEnvironment environment_of(const radar::Fidelity& fidelity) {
    return environment_.of(hrm::PatchFormation(with(fidelity), {}).begin(order_));
  }
  trade::MapObservation observe(const radar::Fidelity& fidelity) {
    const hrm::PatchEnvironment environment = environment_of(fidelity);
    check_above_ground("view", order_.altitude, environment.path->elevation_m(order_.apex));
    return trade::observe_map(with(fidelity), order_, environment, thread_ms, goes_on_);
  }
  // Median time of a map [ms] with warm caches, on one thread, with noise as the fidelity sets it. The reference
  // algorithm is slow, so it does not run again: its time is found.took_ms, from one run without noise.
  double time_of(const radar::Fidelity& fidelity, const hrm::PatchEnvironment& environment,
                 const trade::MapObservation& found) const {
    if (fidelity.algorithm == radar::Algorithm::reference) return found.took_ms;
    hrm::PatchFormation patch_formation(with(fidelity), {});
    trade::time_map(patch_formation, order_, environment, thread_ms, goes_on_);
    std::vector<double> took_ms;
    took_ms.reserve(static_cast<std::size_t>(trade_.repeat));
    for (int run = 0; run < trade_.repeat; ++run)
      took_ms.push_back(trade::time_map(patch_formation, order_, environment, thread_ms, goes_on_));
    return median(std::move(took_ms));
  }

  const MapTradeRequest& trade_;
  const radar::RadarConfiguration& configuration_;
  const parallel::GoesOn& goes_on_;
  hrm::PatchOrder order_;
  ViewEnvironment environment_;
  trade::MapObservation shared_;
};

// Three views of one target: 10 NM away with a 0.67 NM window, 20 NM with 4.7 NM, and 80 NM with 20 NM. On the built-in
// hills also a view in the far north and a view across the antimeridian.
std::vector<trade::MapView> default_views(const std::string& directory) {
  const geo::GeoPoint middle = default_position(directory);
  std::vector<trade::MapView> views{trade::view_of_target(middle, 10.0, 200.0, 15000.0, 0.67),
                                    trade::view_of_target(middle, 20.0, 200.0, 15000.0, 4.7),
                                    trade::view_of_target(middle, 80.0, 200.0, 30000.0, 20.0)};
  if (!directory.empty()) return views;
  views.push_back(trade::view_of_target({78.2, 16.0}, 80.0, 120.0, 30000.0, 20.0));
  views.push_back(trade::view_of_target({-16.5, 179.9}, 40.0, 100.0, 15000.0, 10.0));
  return views;
}

std::vector<trade::MapView> views_of(const std::vector<std::string>& texts, const std::string& directory) {
  std::vector<trade::MapView> views;
  for (const std::string& text : texts) {
    const auto view = trade::map_view_of(text);
    if (!view) throw_failure(view.error());
    views.push_back(*view);
  }
  return views.empty() ? default_views(directory) : views;
}

}  // namespace

TradeResult measure_trade(const MapTradeRequest& request, radar::RadarConfiguration configuration, const Warn& warn,
                          const parallel::GoesOn& goes_on) {
  radar::check_fields(request);
  if (auto added = model::scene::add_scenes(configuration.world.scenes, request.scene, request.scene_without); !added)
    throw_failure(error::usage_error(added.error()));
  trade::TradeTable table;
  table.columns = trade::kMapColumns;
  table.scene_fields = trade::kMapFields;
  table.candidates = trade::candidates_of(request.presets, request.knob, request.base, trade::Subject::map);
  table.values.resize(table.candidates.size());
  const std::vector<trade::MapView> views = views_of(request.view, configuration.terrain.directory);
  Progress progress(table.candidates.size() * views.size());
  LeftOut left_out;
  for (const trade::MapView& view : views) {
    table.scenes.push_back(trade::row_of(view));
    ViewTrade view_trade(request, configuration, view, warn, left_out, goes_on);
    for (std::size_t i = 0; i < table.candidates.size(); ++i) {
      table.values[i].push_back(view_trade.values(table.candidates[i].fidelity));
      progress.done(table.candidates[i].name + ", " + trade::map_view_name(view));
    }
  }
  return {std::move(table),
          {{trade::kMapMs, "time per map (ms of one core)"},
           {{{trade::kMapPower, "power error (dB RMS)"}, {trade::kMapShadow, "shadow mismatch (% of pixels)"}}}},
          left_out.sentences()};
}

}  // namespace yars::tools

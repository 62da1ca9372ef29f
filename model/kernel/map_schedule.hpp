// Schedule of patch maps (which map forms when), and the hash of a map's record.
// Inputs: one ModelTick per step (radar command, sim time), pose, elevation of the ground.
// Outputs: the pending map with its parameters, start and end tick; fields of ModelStatus.
// Errors: a command for a map that cannot be made is completed without a map; ModelStatus::map_stopped names the
//   exceeded limit, if there is one.
// Threads: one at a time. The schedule makes no picture; hrm::PatchFormation does.
// Source: docs/pilots_manual.md#rule-5, #rule-6, #rule-7, #rule-8; docs/spec/physics.md#formation-time.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "databuffer/messages/model_records.hpp"
#include "databuffer/messages/pictures.hpp"
#include "lib/radar/mission.hpp"
#include "model/hrm/patch_geometry.hpp"
#include "model/kernel/tick_inputs.hpp"

namespace yars::model::kernel {

// Patch map in formation.
struct PendingMap {
  hrm::PatchOrder order;
  std::uint64_t id = 0;
  std::uint32_t request = 0;
  std::int64_t start_tick = 0;
  std::int64_t end_tick = 0;  // tick at which the map is due
  bool blank_window = false;  // no window is selected; the window follows from the range
  double up_deg = 0.0;        // true bearing from the aircraft to the centre; this direction is up in the picture
  double distance_m = 0.0;    // over ground, to the centre
  geo::Duration formation{};
};

// Parameters of the schedule. Keeps references to lists and tables of the configuration.
struct MapParameters {
  // Converts from a structure with these sections, such as radar::RadarConfiguration.
  template <class Configuration>
    requires requires(const Configuration& whole) { whole.window_limits; }
  MapParameters(const Configuration& whole) : looks(whole.high_resolution.looks), array(whole), limits(whole) {}

  const std::vector<double>& looks;  // number of averaged looks: first ML1, last ML2
  radar::SyntheticArray array;
  radar::MapLimits limits;
};

// Schedule without clock, thread or file. step() advances the schedule by one tick. A map is due when its formation
// time has passed. The caller forms the picture and then calls complete().
class MapSchedule {
 public:
  explicit MapSchedule(const MapParameters& parameters);

  void resume(const databuffer::ModelStatus& status);
  // Centre of the map that the command starts next: the commanded map, or a re-map (repetition of the shown map).
  geo::GeoPoint next_centre(const databuffer::RadarCommand& command, const Pose& pose) const;
  // Starts or cancels maps. `ground_m`: elevation [m MSL] at next_centre(); NaN counts as sea level. `dish_free`: true
  // if re-maps may start. A commanded map does not need the dish to be free. The limits of radar::map_rejection() apply
  // to commanded maps and re-maps.
  void step(const databuffer::ModelTick& tick, const Pose& pose, double ground_m, bool dish_free = true);
  // Completes the pending map, which becomes the newest map. Precondition: forming().
  void complete();

  bool forming() const { return map_.has_value(); }
  const PendingMap& map() const { return *map_; }
  // True at and after the tick at which the picture must be complete.
  bool due(std::int64_t tick) const { return map_ && tick >= map_->end_tick; }
  // True while a map is commanded or shown. The radar then does not scan.
  bool blocks_scanning(const databuffer::RadarCommand& command) const;
  // Target of the dish: the centre of the forming map, else of the next re-map; nullopt if there is neither.
  std::optional<geo::GeoPoint> pointing_target(const databuffer::ModelTick& tick, const Pose& pose) const;
  // Formation time [s] of a map at a target; NaN if the window is not positive. `ground_m`: elevation [m MSL] at the
  // target; NaN counts as sea level.
  double estimate_s(const databuffer::RadarCommand& command, const Pose& pose, geo::GeoPoint target, double ground_m,
                    double window_nm) const;
  void describe(std::int64_t tick, databuffer::ModelStatus& status) const;

  std::uint64_t newest() const { return newest_; }  // id of the newest complete map, 0: none

 private:
  std::optional<hrm::PatchOrder> order_of(const databuffer::ModelTick& tick, const Pose& pose) const;
  // Starts the next map. Starts none if `stopped_` has a limit or order_of() gives no order; a commanded map is then
  // completed without a picture.
  void start(const databuffer::ModelTick& tick, const Pose& pose, double ground_m);
  std::optional<std::string_view> exceeded_limit(const databuffer::RadarCommand& command, const Pose& pose,
                                                 double ground_m) const;
  int looks_of(const databuffer::RadarCommand& command) const;

  MapParameters parameters_;
  std::optional<PendingMap> map_;
  std::uint64_t newest_ = 0;
  std::uint32_t request_ = 0;       // last request that was started or cannot be mapped
  std::uint32_t done_request_ = 0;  // last request that is completed or cannot be mapped
  std::uint32_t epoch_ = 0;
  // Last started map: angle of its centre off the ground track, positive to the right, and distance over ground. PROG
  // re-maps keep these values.
  double off_track_deg_ = 0.0;
  double distance_m_ = 0.0;
  bool has_last_map_ = false;
  std::optional<std::string_view> stopped_;  // limit that prevents the commanded map, or the re-map of the shown patch
};

}  // namespace yars::model::kernel

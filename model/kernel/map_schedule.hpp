// Patch maps in the kernel: the hash of a map's record, and the schedule of formations.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "databuffer/messages/model_records.hpp"
#include "databuffer/messages/pictures.hpp"
#include "lib/radar/configuration.hpp"
#include "model/hrm/patch_geometry.hpp"
#include "model/kernel/tick_inputs.hpp"

namespace yars::model::kernel {

// The hash of a patch map: equal maps, equal hashes, whoever made them.
// XXH3 64 over the record's fields before `hash` but for id and ticks, then, seeded with that, over the pixels.
std::uint64_t map_hash(const databuffer::PatchMap& map, std::span<const std::uint8_t> pixels);

// A map on its way.
struct PendingMap {
  hrm::PatchOrder order;
  std::uint64_t id = 0;
  std::uint32_t request = 0;
  std::int64_t start_tick = 0;
  std::int64_t end_tick = 0;  // complete at this one
  bool blank_window = false;  // its window was chosen by range: none was selected
  double up_deg = 0.0;        // true bearing of the centre
  double distance_m = 0.0;    // over ground, to the centre
  geo::Duration formation{};
};

// When the radar forms which patch map, as a pure step: radar command, place and tick in; what is forming out. The
// picture is another's work (hrm::PatchFormation); it is complete at the tick that the formation time gives, and
// whoever drives the kernel has it ready by then. Source: docs/spec/pilots_interface.md#rule-5, #rule-6, #rule-7,
// #rule-8; docs/spec/physics.md#formation-time.
class MapSchedule {
 public:
  explicit MapSchedule(const radar::RadarConfiguration& configuration);

  void resume(const databuffer::ModelStatus& status);
  // Starts, ends or gives up. `ground_m`: elevation [m] at the place asked for, or at the last one; NaN = unknown.
  // `dish_free`: what stands may be mapped again; a command never waits.
  void step(const databuffer::ModelTick& tick, const Pose& pose, double ground_m, bool dish_free = true);
  // Whoever has the picture of a map that is due says so: it is the newest from the next status on.
  void complete();

  bool forming() const { return map_.has_value(); }
  const PendingMap& map() const { return *map_; }
  // True from the tick on at which the picture has to be there.
  bool due(std::int64_t tick) const { return map_ && tick >= map_->end_tick; }
  // No scan while a map is commanded or shown.
  bool keeps_from_scanning(const databuffer::RadarCommand& command) const;
  // What the dish looks at: the middle of the map that forms, else of the one that comes next; nothing where none does.
  std::optional<geo::GeoPoint> looked_at(const databuffer::ModelTick& tick, const Pose& pose) const;
  // Time for a map of this window there [s]; NaN for a window of 0.
  double estimate_s(const databuffer::RadarCommand& command, const Pose& pose, geo::GeoPoint target, double ground_m,
                    double window_nm) const;
  void describe(std::int64_t tick, databuffer::ModelStatus& status) const;

  std::uint64_t newest() const { return newest_; }

 private:
  geo::GeoPoint centre_of(const databuffer::RadarCommand& command, const Pose& pose, bool commanded) const;
  std::optional<hrm::PatchOrder> order_of(const databuffer::ModelTick& tick, const Pose& pose, bool commanded) const;
  void start(const databuffer::ModelTick& tick, const Pose& pose, double ground_m, bool commanded);
  std::optional<std::string_view> why_not_again(const databuffer::RadarCommand& command, const Pose& pose) const;
  int looks_of(const databuffer::RadarCommand& command) const;

  const radar::RadarConfiguration* configuration_;
  std::optional<PendingMap> map_;
  std::uint64_t newest_ = 0;
  std::uint32_t request_ = 0;       // the last one taken up
  std::uint32_t done_request_ = 0;  // that the newest map answers, or that could not be answered
  std::uint32_t epoch_ = 0;
  // Where the last map lay against the aircraft, for PROG.
  double off_track_deg_ = 0.0;
  double distance_m_ = 0.0;
  bool placed_ = false;
  std::optional<std::string_view> stopped_;  // why the patch shown is not mapped again
};

}  // namespace yars::model::kernel

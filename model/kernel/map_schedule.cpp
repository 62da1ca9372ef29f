#include "model/kernel/map_schedule.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "databuffer/messages/pictures.hpp"
#include "lib/radar/modes.hpp"
#include "model/kernel/tick_inputs.hpp"

namespace yars::model::kernel {

using databuffer::ModelStatus;
using databuffer::ModelTick;
using databuffer::RadarCommand;

namespace {
// Minimum ratio of a map's distance to its window. At 0.5 the near edge of the window is below the aircraft. PatchOrder
// requires more than 0.71, half the window's diagonal.
constexpr double kMinDistanceInWindows = 0.75;

bool operates(const RadarCommand& command) {
  return command.power == static_cast<std::uint8_t>(radar::Power::operate);
}
bool is_commanded(const RadarCommand& command) {
  return operates(command) && (command.flags & databuffer::kMapping) != 0U;
}
bool shows_map(const RadarCommand& command) {
  return operates(command) && command.mode == static_cast<std::uint8_t>(radar::Mode::patch);
}
bool is_frozen_or_silent(const RadarCommand& command) {
  return (command.flags & (databuffer::kFreeze | databuffer::kSniff)) != 0U;
}
bool is_position(geo::GeoPoint point) {
  return std::isfinite(point.latitude_deg) && std::isfinite(point.longitude_deg) &&
         std::abs(point.latitude_deg) <= 90.0;
}
}  // namespace

MapSchedule::MapSchedule(const MapParameters& parameters) : parameters_(parameters) {}

// A map that was forming before the restart of the radar model starts again, because its request counts as not started.
void MapSchedule::resume(const ModelStatus& status) {
  // An id above half of the largest id is replaced by 0. This leaves room for the ids of all later maps.
  newest_ = status.map_newest <= databuffer::kLatestPictureId / 2 ? status.map_newest : 0;
  done_request_ = status.map_done_request;
  request_ = status.map_done_request;
  epoch_ = status.epoch;
}

int MapSchedule::looks_of(const RadarCommand& command) const {
  const auto& looks = parameters_.looks;
  return static_cast<int>((command.flags & databuffer::kMultiLook2) != 0U ? looks.back() : looks.front());
}

bool MapSchedule::blocks_scanning(const RadarCommand& command) const {
  return is_commanded(command) || shows_map(command);
}

// Centre of a commanded map or of a re-map. With STAB (stabilized) a re-map keeps the commanded position on the ground.
// With PROG (progressive) it keeps the last map's angle off the ground track and its distance over ground.
geo::GeoPoint MapSchedule::next_centre(const RadarCommand& command, const Pose& pose) const {
  const bool progressive = (command.flags & databuffer::kProgressive) != 0U;
  if (!progressive || is_commanded(command) || !has_last_map_)
    return {command.map_latitude_deg, command.map_longitude_deg};
  return geo::geodesic_direct(pose.position, pose.platform.ground_track + geo::Angle::degrees(off_track_deg_),
                              geo::Length::metres(distance_m_));
}

std::optional<geo::GeoPoint> MapSchedule::pointing_target(const ModelTick& tick, const Pose& pose) const {
  if (map_) return map_->order.centre;
  if (!shows_map(tick.command) || is_frozen_or_silent(tick.command) || stopped_) return std::nullopt;
  const geo::GeoPoint centre = next_centre(tick.command, pose);
  return is_position(centre) ? std::optional(centre) : std::nullopt;
}

std::optional<hrm::PatchOrder> MapSchedule::order_of(const ModelTick& tick, const Pose& pose) const {
  const RadarCommand& command = tick.command;
  hrm::PatchOrder order;
  order.apex = pose.position;
  order.altitude = pose.altitude;
  order.ground_track = pose.platform.ground_track;
  order.ground_speed = pose.ground_speed;
  order.window = geo::Length::nautical_miles(static_cast<double>(command.map_window_nm));
  order.looks = looks_of(command);
  order.sim_time = geo::Duration::seconds(static_cast<double>(tick.sim_time_ns) * 1e-9);
  order.map = static_cast<std::uint32_t>(newest_ + 1);
  order.band = command.band;
  order.channel = command.channel;
  order.centre = next_centre(command, pose);
  if (!is_position(order.centre) || !std::isfinite(order.window.metres()) || !(order.window.metres() > 0.0))
    return std::nullopt;
  const double distance_m = geo::geodesic_inverse(order.apex, order.centre).distance.metres();
  if (distance_m < kMinDistanceInWindows * order.window.metres()) return std::nullopt;
  return order;
}

void MapSchedule::start(const ModelTick& tick, const Pose& pose, double ground_m) {
  map_.reset();
  request_ = tick.command.map_request;
  const auto order = order_of(tick, pose);
  if (stopped_ || !order) {
    // No map is possible at this position. A commanded map is completed without a picture. The shown map stays.
    if (is_commanded(tick.command)) done_request_ = request_;
    return;
  }
  PendingMap map;
  map.order = *order;
  const geo::GeodesicInverse path = geo::geodesic_inverse(order->apex, order->centre);
  const geo::Angle squint = path.azimuth_at_start - order->ground_track;
  map.id = newest_ + 1;
  map.request = request_;
  map.start_tick = tick.tick;
  map.blank_window = (tick.command.flags & databuffer::kMapWindowBlank) != 0U;
  map.up_deg = path.azimuth_at_start.degrees();
  map.distance_m = path.distance.metres();
  const double height_m = pose.altitude.metres() - (std::isnan(ground_m) ? 0.0 : ground_m);
  map.formation = radar::formation_time({geo::Length::metres(std::hypot(map.distance_m, height_m)), order->window,
                                         squint, order->ground_speed, order->looks},
                                        parameters_.array);
  map.end_tick = tick.tick + std::max<std::int64_t>(1, std::llround(map.formation.seconds() / radar::kTickSeconds));
  map_ = map;
  off_track_deg_ = squint.degrees();
  distance_m_ = map.distance_m;
  has_last_map_ = true;
}

// Limit that the next map would exceed. Re-maps have the limits of commanded maps.
std::optional<std::string_view> MapSchedule::exceeded_limit(const RadarCommand& command, const Pose& pose,
                                                            double ground_m) const {
  const geo::GeoPoint centre = next_centre(command, pose);
  if (!is_position(centre) || !(command.map_window_nm > 0.0F)) return std::nullopt;  // order_of() gives no order
  const radar::MapWindow window{geo::Length::nautical_miles(static_cast<double>(command.map_window_nm)),
                                (command.flags & databuffer::kMapWindowBlank) != 0U};
  return radar::map_rejection(viewpoint_of(pose), {centre, ground_m}, window, parameters_.limits);
}

void MapSchedule::step(const ModelTick& tick, const Pose& pose, double ground_m, bool dish_free) {
  const RadarCommand& command = tick.command;
  const bool jumped = tick.epoch != epoch_;
  epoch_ = tick.epoch;
  if (is_commanded(command)) {
    // The request is completed, but the state machine has not yet received the status. `stopped_` remains until then.
    if (command.map_request == done_request_) return;
    if (map_ && map_->request == command.map_request && !jumped) return;
    stopped_ = exceeded_limit(command, pose, ground_m);
    start(tick, pose, ground_m);
    return;
  }
  stopped_.reset();
  if (!shows_map(command)) {
    map_.reset();
    return;
  }
  // A re-map in progress continues under freeze. A new epoch or SNIFF (receive only) cancels it.
  const bool silent = (command.flags & databuffer::kSniff) != 0U;
  if (map_ && (map_->request != command.map_request || jumped || silent)) map_.reset();
  if (map_ || is_frozen_or_silent(command)) return;
  stopped_ = exceeded_limit(command, pose, ground_m);
  if (!stopped_ && dish_free) start(tick, pose, ground_m);
}

void MapSchedule::complete() {
  newest_ = map_->id;
  done_request_ = map_->request;
  map_.reset();
}

double MapSchedule::estimate_s(const RadarCommand& command, const Pose& pose, geo::GeoPoint target, double ground_m,
                               double window_nm) const {
  if (!(window_nm > 0.0)) return kUnknown;
  const geo::GeodesicInverse path = geo::geodesic_inverse(pose.position, target);
  const double height_m = pose.altitude.metres() - (std::isnan(ground_m) ? 0.0 : ground_m);
  return radar::formation_time(
             {geo::Length::metres(std::hypot(path.distance.metres(), height_m)), geo::Length::nautical_miles(window_nm),
              path.azimuth_at_start - pose.platform.ground_track, pose.ground_speed, looks_of(command)},
             parameters_.array)
      .seconds();
}

void MapSchedule::describe(std::int64_t tick, ModelStatus& status) const {
  status.map_newest = newest_;
  status.map_request = request_;
  status.map_done_request = done_request_;
  status.map_latitude_deg = map_ ? map_->order.centre.latitude_deg : 0.0;
  status.map_longitude_deg = map_ ? map_->order.centre.longitude_deg : 0.0;
  status.map_up_deg = map_ ? map_->up_deg : 0.0;
  status.map_window_nm = map_ ? map_->order.window.nautical_miles() : 0.0;
  status.map_progress = kUnknown;
  std::fill(std::begin(status.map_stopped), std::end(status.map_stopped), '\0');
  if (stopped_) stopped_->copy(status.map_stopped, sizeof status.map_stopped - 1);
  if (!map_) return;
  const double remaining_s = static_cast<double>(map_->end_tick - tick) * radar::kTickSeconds;
  status.map_timer_s = std::max(remaining_s, 0.0);
  const auto formation_ticks = static_cast<double>(map_->end_tick - map_->start_tick);
  status.map_progress = std::min(static_cast<double>(tick - map_->start_tick) / formation_ticks, 1.0);
}

}  // namespace yars::model::kernel

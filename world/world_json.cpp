#include "world/world_json.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "databuffer/messages/inspection.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/radar/route.hpp"
#include "lib/text/plain_text.hpp"
#include "world/world_edit.hpp"

namespace yars::world {

namespace {

using nlohmann::ordered_json;
using text::text_of;

// JSON has no NaN: a value that is not given becomes null.
ordered_json null_if_missing(double value) {
  return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

ordered_json object_of(const databuffer::WorldRainCell& cell) {
  return {{"id", cell.id},
          {"latitude_deg", cell.latitude_deg},
          {"longitude_deg", cell.longitude_deg},
          {"radius_nm", cell.radius_m / geo::kMetresPerNauticalMile},
          {"rate_mmh", cell.rate_mmh},
          {"top_ft", cell.top_m / geo::kMetresPerFoot}};
}

ordered_json object_of(const databuffer::WorldJammer& jammer) {
  ordered_json channels = ordered_json::array();
  for (unsigned bit = 0; bit < 8; ++bit)
    if ((jammer.channels >> bit & 1U) != 0U) channels.push_back(bit + 1);
  return {{"id", jammer.id},
          {"name", std::string(text_of(jammer.name))},
          {"latitude_deg", jammer.latitude_deg},
          {"longitude_deg", jammer.longitude_deg},
          {"altitude_ft", null_if_missing(jammer.altitude_m / geo::kMetresPerFoot)},
          {"band", band_name(jammer.band)},
          {"channels", channels},
          {"power_w", jammer.power_w}};
}

ordered_json object_of(const databuffer::WorldMover& mover) {
  return {{"id", mover.id},
          {"name", std::string(text_of(mover.name))},
          {"latitude_deg", mover.latitude_deg},
          {"longitude_deg", mover.longitude_deg},
          {"speed_kt", geo::Speed::metres_per_second(mover.speed_mps).knots()},
          {"heading_deg", mover.heading_deg},
          {"cross_section_m2", mover.cross_section_m2},
          {"height_ft", mover.height_m / geo::kMetresPerFoot}};
}

ordered_json object_of(const databuffer::WorldPoint& point) {
  return {{"id", point.id},
          {"name", std::string(text_of(point.name))},
          {"kind", kind_name(point)},
          {"latitude_deg", point.latitude_deg},
          {"longitude_deg", point.longitude_deg},
          {"elevation_ft", null_if_missing(point.elevation_m / geo::kMetresPerFoot)}};
}

template <class Entries>
ordered_json list_of(const Entries& entries) {
  ordered_json list = ordered_json::array();
  for (const auto& entry : entries) list.push_back(object_of(entry));
  return list;
}

}  // namespace

const char* band_name(std::int32_t band) {
  constexpr std::array kNames{"A", "B", "C", "D", "E"};
  return band >= 0 && band < static_cast<std::int32_t>(kNames.size()) ? kNames[static_cast<std::size_t>(band)] : "all";
}

std::string_view kind_name(const databuffer::WorldPoint& point) {
  return radar::kPointKindNames[std::min<std::size_t>(point.kind, radar::kPointKindNames.size() - 1)];
}

nlohmann::ordered_json world_json(const databuffer::WorldState& world, std::int64_t sim_time_ns) {
  ordered_json movers = ordered_json::array();
  for (const databuffer::WorldMover& mover : databuffer::used(world.movers, world.mover_count))
    movers.push_back(object_of(at_sim_time(mover, sim_time_ns)));
  return {{"edit", world.edit},
          {"tick", world.tick},
          {"configured", (world.flags & databuffer::kWorldConfigured) != 0U},
          {"sea_state", null_if_missing(world.sea_state)},
          {"wind_kt", geo::Speed::metres_per_second(world.wind_speed_mps).knots()},
          {"wind_from_deg", world.wind_from_deg},
          {"rain", list_of(databuffer::used(world.rain, world.rain_count))},
          {"jammers", list_of(databuffer::used(world.jammers, world.jammer_count))},
          {"movers", movers},
          {"points_changed", (world.flags & databuffer::kWorldPointsChanged) != 0U},
          {"points", list_of(databuffer::used(world.points, world.point_count))}};
}

}  // namespace yars::world

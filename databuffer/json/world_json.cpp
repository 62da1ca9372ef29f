#include "databuffer/json/world_json.hpp"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "databuffer/messages/inspection.hpp"
#include "databuffer/messages/world_edit.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::databuffer {

namespace {

using nlohmann::ordered_json;
using text::text_of;

// JSON has no NaN: a value that is not given becomes null.
ordered_json null_if_missing(double value) {
  return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

ordered_json object_of(const WorldRainCell& cell) {
  return {{"id", cell.id},
          {"latitude_deg", cell.latitude_deg},
          {"longitude_deg", cell.longitude_deg},
          {"radius_nm", cell.radius_m / geo::kMetresPerNauticalMile},
          {"rate_mmh", cell.rate_mmh},
          {"top_ft", cell.top_m / geo::kMetresPerFoot}};
}

ordered_json object_of(const WorldJammer& jammer) {
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

ordered_json object_of(const WorldMover& mover) {
  return {{"id", mover.id},
          {"name", std::string(text_of(mover.name))},
          {"latitude_deg", mover.latitude_deg},
          {"longitude_deg", mover.longitude_deg},
          {"speed_kt", geo::Speed::metres_per_second(mover.speed_mps).knots()},
          {"heading_deg", mover.heading_deg},
          {"cross_section_m2", mover.cross_section_m2},
          {"height_ft", mover.height_m / geo::kMetresPerFoot}};
}

}  // namespace

const char* band_name(std::int32_t band) {
  constexpr std::array kNames{"A", "B", "C", "D", "E"};
  return band >= 0 && band < static_cast<std::int32_t>(kNames.size()) ? kNames[static_cast<std::size_t>(band)] : "all";
}

nlohmann::ordered_json world_json(const WorldState& world, std::int64_t sim_time_ns) {
  ordered_json rain = ordered_json::array(), jammers = ordered_json::array(), movers = ordered_json::array();
  for (const WorldRainCell& cell : used(world.rain, world.rain_count)) rain.push_back(object_of(cell));
  for (const WorldJammer& jammer : used(world.jammers, world.jammer_count)) jammers.push_back(object_of(jammer));
  for (const WorldMover& mover : used(world.movers, world.mover_count))
    movers.push_back(object_of(at_sim_time(mover, sim_time_ns)));
  return {{"edit", world.edit},
          {"tick", world.tick},
          {"configured", (world.flags & kWorldConfigured) != 0U},
          {"sea_state", null_if_missing(world.sea_state)},
          {"wind_kt", geo::Speed::metres_per_second(world.wind_speed_mps).knots()},
          {"wind_from_deg", world.wind_from_deg},
          {"rain", rain},
          {"jammers", jammers},
          {"movers", movers}};
}

}  // namespace yars::databuffer

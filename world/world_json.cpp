#include "world/world_json.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>

#include "databuffer/messages/world_lists.hpp"
#include "lib/radar/modes.hpp"
#include "lib/radar/world.hpp"
#include "lib/text/plain_text.hpp"
#include "lib/values/fields.hpp"
#include "world/world_edit.hpp"

namespace yars::world {

namespace {

using nlohmann::ordered_json;
using text::text_of;

// JSON has no NaN: a value that is not given becomes null.
ordered_json null_if_missing(double value) {
  return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

// Names and units of the values are those of lib/values/world_state.idl.
template <class Entry>
ordered_json object_of(const Entry& entry) {
  ordered_json object{{"id", entry.id}};
  if constexpr (requires { entry.name; }) object["name"] = std::string(text_of(entry.name));
  values::visit_fields(entry, [&object](const values::Field& field, double value) {
    object[std::string(field.name)] = null_if_missing(field.given(value));
  });
  if constexpr (std::is_same_v<Entry, databuffer::WorldJammer>) {
    object["band"] = band_name(entry.band);
    ordered_json& channels = object["channels"] = ordered_json::array();
    for (int channel = 0; channel < radar::kChannels; ++channel)
      if ((entry.channels >> channel & 1U) != 0U) channels.push_back(channel + 1);
  }
  if constexpr (std::is_same_v<Entry, databuffer::WorldMover>) {
    object["echo"] = echo_name(entry);
    object["facing_deg"] = entry.facing_deg;
    object["tilt_deg"] = entry.tilt_deg;
  }
  if constexpr (std::is_same_v<Entry, databuffer::WorldPoint>) object["kind"] = kind_name(entry);
  return object;
}

}  // namespace

const char* band_name(std::int32_t band) {
  constexpr std::array kNames{"A", "B", "C", "D", "E"};
  return band >= 0 && band < static_cast<std::int32_t>(kNames.size()) ? kNames[static_cast<std::size_t>(band)] : "all";
}

std::string_view kind_name(const databuffer::WorldPoint& point) {
  return radar::kPointKindNames[std::min<std::size_t>(point.kind, radar::kPointKindNames.size() - 1)];
}

std::string_view echo_name(const databuffer::WorldMover& mover) {
  return radar::kTargetEchoNames[std::min<std::size_t>(mover.echo, radar::kTargetEchoNames.size() - 1)];
}

nlohmann::ordered_json world_json(const databuffer::WorldState& world, std::int64_t sim_time_ns) {
  ordered_json object{{"edit", world.edit},
                      {"tick", world.tick},
                      {"configured", (world.flags & databuffer::kWorldConfigured) != 0U},
                      {"sea_state", null_if_missing(world.sea_state)},
                      {"wind_kt", values::WorldState::wind_speed.given(world.wind_speed_mps)},
                      {"wind_from_deg", world.wind_from_deg},
                      {"points_changed", (world.flags & databuffer::kWorldPointsChanged) != 0U}};
  databuffer::for_each_list([&]<class Entry>(std::type_identity<Entry>) {
    ordered_json& list = object[std::string(Entry::Values::list.name)] = ordered_json::array();
    for (const Entry& entry : databuffer::ListOf<Entry>::entries_in_use(world)) {
      if constexpr (std::is_same_v<Entry, databuffer::WorldMover>)
        list.push_back(object_of(at_sim_time(entry, sim_time_ns)));
      else
        list.push_back(object_of(entry));
    }
  });
  return object;
}

}  // namespace yars::world

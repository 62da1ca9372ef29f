#include "station/world_message.hpp"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "databuffer/messages/inspection.hpp"
#include "lib/geo/quantity.hpp"
#include "world/world_edit.hpp"

namespace yars::station {

namespace {

using databuffer::WorldState;
using error::Expected;
using nlohmann::json;
using world::WorldList;

constexpr double kMetresPerSecondPerKnot = geo::kMetresPerNauticalMile / 3600.0;

// Number of an object; NaN if it is absent or something else.
double number(const json& object, const char* name) {
  const auto found = object.find(name);
  return found != object.end() && found->is_number() ? found->get<double>() : std::numeric_limits<double>::quiet_NaN();
}

std::string text(const json& object, const char* name) {
  const auto found = object.find(name);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

// Ids of entries are whole numbers from 1; 0 for anything else, which no entry has.
std::uint32_t item_of(const json& object) {
  const double id = number(object, "item");
  return id >= 1.0 && id <= 4294967295.0 && std::trunc(id) == id ? static_cast<std::uint32_t>(id) : 0;
}

// The world after `change(world)`, or its error.
template <class Change>
WorldEdit edit_by(Change change) {
  return [change](WorldState world, std::int64_t sim_time_ns) -> Expected<WorldState> {
    auto done = change(world, sim_time_ns);
    if (!done) return tl::unexpected(done.error());
    return world;
  };
}

Expected<WorldEdit> refused(const char* subject, const char* expected) {
  return error::fail(subject, expected, "something else");
}

Expected<WorldEdit> add_edit(WorldList list, geo::GeoPoint position) {
  switch (list) {
    case WorldList::rain:
      return edit_by(
          [=](WorldState& world, std::int64_t) { return world::add(world, world::default_rain_cell(position)); });
    case WorldList::jammers:
      return edit_by(
          [=](WorldState& world, std::int64_t) { return world::add(world, world::default_jammer(position)); });
    case WorldList::movers:
      return edit_by([=](WorldState& world, std::int64_t sim_time_ns) {
        return world::add(world, world::default_mover(position, sim_time_ns));
      });
    case WorldList::points:
      return edit_by([=](WorldState& world, std::int64_t) -> Expected<std::uint32_t> {
        const auto point = world::default_point(world, position);
        if (!point) return tl::unexpected(point.error());
        return world::add(world, *point);
      });
  }
  return refused("list", kWorldLists);
}

// Replaces the values of an entry that the object has.
Expected<WorldEdit> change_edit(WorldList list, std::uint32_t id, const json& object) {
  const auto changed = [](auto entries, std::uint32_t wanted) {
    for (const auto& entry : entries)
      if (entry.id == wanted) return entry;
    typename decltype(entries)::value_type absent{};
    absent.id = wanted;
    return absent;
  };
  switch (list) {
    case WorldList::rain: {
      const double radius_nm = number(object, "radius_nm"), rate_mmh = number(object, "rate_mmh"),
                   top_ft = number(object, "top_ft");
      return edit_by([=](WorldState& world, std::int64_t) {
        auto cell = changed(databuffer::used(std::as_const(world.rain), world.rain_count), id);
        cell.radius_m = radius_nm * geo::kMetresPerNauticalMile;
        cell.rate_mmh = rate_mmh;
        cell.top_m = top_ft * geo::kMetresPerFoot;
        return world::replace(world, cell);
      });
    }
    case WorldList::jammers: {
      const double power_w = number(object, "power_w");
      return edit_by([=](WorldState& world, std::int64_t) {
        auto jammer = changed(databuffer::used(std::as_const(world.jammers), world.jammer_count), id);
        jammer.power_w = power_w;
        return world::replace(world, jammer);
      });
    }
    case WorldList::movers: {
      const double speed_kt = number(object, "speed_kt"), heading_deg = number(object, "heading_deg");
      return edit_by([=](WorldState& world, std::int64_t sim_time_ns) {
        return world::steer(world, id, speed_kt * kMetresPerSecondPerKnot, heading_deg, sim_time_ns);
      });
    }
    case WorldList::points: {
      const std::string name = text(object, "name");
      const auto elevation = object.find("elevation_ft");
      const bool is_unknown = elevation != object.end() && elevation->is_null();
      const double elevation_ft = number(object, "elevation_ft");
      if (!is_unknown && !std::isfinite(elevation_ft)) return refused("elevation_ft", "a number, or null: unknown");
      return edit_by([=](WorldState& world, std::int64_t) -> Expected<void> {
        auto point = changed(databuffer::used(std::as_const(world.points), world.point_count), id);
        if (auto named = world::set_name(point, name); !named) return named;
        point.elevation_m = elevation_ft * geo::kMetresPerFoot;
        return world::replace(world, point);
      });
    }
  }
  return refused("list", kWorldLists);
}

Expected<WorldEdit> entry_edit(std::string_view command, const json& object) {
  const auto list = world_list(object, "list");
  if (!list) return refused("list", kWorldLists);
  const std::uint32_t id = item_of(object);
  const geo::GeoPoint position{number(object, "lat"), number(object, "lon")};
  const bool has_position = std::isfinite(position.latitude_deg) && std::isfinite(position.longitude_deg);
  if ((command == "add" || command == "move") && !has_position) return refused("lat, lon", "two numbers");
  if (command == "add") return add_edit(*list, position);
  if (command == "change") return change_edit(*list, id, object);
  if (command == "move")
    return edit_by([=, list = *list](WorldState& world, std::int64_t sim_time_ns) {
      return world::move(world, list, id, position, sim_time_ns);
    });
  return edit_by([=, list = *list](WorldState& world, std::int64_t) { return world::remove(world, list, id); });
}

}  // namespace

std::optional<WorldList> world_list(const json& object, const char* name) {
  const std::string list = text(object, name);
  if (list == "rain") return WorldList::rain;
  if (list == "jammers") return WorldList::jammers;
  if (list == "movers") return WorldList::movers;
  if (list == "points") return WorldList::points;
  return std::nullopt;
}

std::string_view world_commands() {
  return "add, move, change, remove, sea, wind, fidelity";
}

std::optional<Expected<WorldEdit>> world_edit(std::string_view command, const json& object) {
  if (command == "add" || command == "move" || command == "change" || command == "remove")
    return entry_edit(command, object);
  if (command == "sea") {
    const auto state = object.find("state");
    const bool by_wind = state != object.end() && state->is_null();
    const double value = number(object, "state");
    if (!by_wind && !std::isfinite(value)) return refused("state", "a number, or null: from the wind");
    return edit_by([=](WorldState& world, std::int64_t) { return world::set_sea_state(world, value); });
  }
  if (command == "wind") {
    const double speed_mps = number(object, "speed_kt") * kMetresPerSecondPerKnot, from_deg = number(object, "from");
    return edit_by([=](WorldState& world, std::int64_t) { return world::set_wind(world, speed_mps, from_deg); });
  }
  if (command == "fidelity") {
    const auto given = object.find("preset");
    if (given == object.end() || !given->is_string()) return refused("preset", "a text; empty: the configured one");
    const std::string preset = text(object, "preset");
    return edit_by([=](WorldState& world, std::int64_t) { return world::set_fidelity(world, preset); });
  }
  return std::nullopt;
}

}  // namespace yars::station

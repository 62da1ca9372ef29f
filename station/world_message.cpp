#include "station/world_message.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <variant>

#include "lib/geo/geodesy.hpp"
#include "lib/values/fields.hpp"
#include "world/world_edit.hpp"

namespace yars::station {

namespace {

using databuffer::WorldState;
using error::Expected;
using nlohmann::json;
using world::WorldList;

// Number of an object; NaN if it is absent or something else.
double number(const json& object, std::string_view name) {
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

Expected<WorldEdit> refused(const char* subject, const std::string& expected) {
  return error::fail(subject, expected, "something else");
}

// Replaces the values of an entry that the object has, by their names in world_json.hpp; null: not known.
Expected<void> write_values(world::WorldEntry& entry, const json& object) {
  if (object.contains("name"))
    if (auto named = world::set_name(entry, text(object, "name")); !named) return named;
  std::visit(
      [&object](auto& one) {
        values::visit_fields(one, [&object](const values::Field& field, double& value) {
          if (object.contains(field.name)) value = field.recorded(number(object, field.name));
        });
      },
      entry);
  return {};
}

Expected<WorldEdit> change_edit(WorldList list, std::uint32_t id, const json& object) {
  Expected<WorldEdit> wrong;
  databuffer::for_list(list, [&]<class Entry>(std::type_identity<Entry>) {
    for (const values::Field& field : Entry::Values::all) {
      const auto found = object.find(field.name);
      if (wrong && found != object.end() && !found->is_number() && !found->is_null())
        wrong = error::fail(std::string(field.name), "a number, or null", "something else");
    }
  });
  if (!wrong) return wrong;
  return edit_by([=](WorldState& world, std::int64_t sim_time_ns) -> Expected<void> {
    auto entry = world::entry_with(world, list, id, sim_time_ns);
    if (!entry) return tl::unexpected(entry.error());
    if (auto written = write_values(*entry, object); !written) return written;
    return world::replace(world, *entry);
  });
}

Expected<WorldEdit> add_edit(WorldList list, geo::GeoPoint position) {
  return edit_by([=](WorldState& world, std::int64_t sim_time_ns) -> Expected<std::uint32_t> {
    const auto entry = world::default_entry(world, list, position, sim_time_ns);
    if (!entry) return tl::unexpected(entry.error());
    return world::add(world, *entry);
  });
}

Expected<WorldEdit> entry_edit(std::string_view command, const json& object) {
  const auto list = world_list(object, "list");
  if (!list) return refused("list", world_lists());
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
  const auto found = std::ranges::find(databuffer::kWorldLists, text(object, name), &values::List::name);
  if (found == databuffer::kWorldLists.end()) return std::nullopt;
  return static_cast<WorldList>(found - databuffer::kWorldLists.begin());
}

std::string world_lists() {
  std::string names;
  for (const values::List* const list : databuffer::kWorldLists)
    names += (list == databuffer::kWorldLists.front()  ? ""
              : list == databuffer::kWorldLists.back() ? " or "
                                                       : ", ") +
             std::string(list->name);
  return names;
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
    const double speed_mps = values::WorldState::wind_speed.recorded(number(object, "speed_kt"));
    const double from_deg = number(object, "from");
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

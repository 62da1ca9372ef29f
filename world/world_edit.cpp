#include "world/world_edit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "databuffer/messages/inspection.hpp"
#include "lib/radar/fidelity.hpp"
#include "lib/radar/modes.hpp"
#include "lib/radar/world.hpp"
#include "lib/text/plain_text.hpp"
#include "lib/values/fields.hpp"

namespace yars::world {

using error::Expected;
using error::fail;

namespace {

std::string number_with_unit(double value, std::string_view unit) {
  return text::text_of_number(value) + (unit.empty() ? "" : " ") + std::string(unit);
}

// Checks a value of a record against its limits in the unit in which people give it.
Expected<void> check(std::string_view subject, const values::Field& field, double recorded) {
  constexpr double kRounding = 1e-9;  // relative; the conversion of a limit to another unit rounds it
  const double value = field.given(recorded);
  const double slack = kRounding * std::max(std::abs(field.low), std::abs(field.high));
  if (value >= field.low - slack && value <= field.high + slack) return {};
  if (std::isnan(value) && !field.otherwise.empty()) return {};
  return fail(std::string(subject) + ": " + std::string(field.label),
              text::text_of_number(field.low) + " to " + number_with_unit(field.high, field.unit),
              number_with_unit(value, field.unit), "give a value within these limits");
}

// Checks the values of an entry that people give. change_world() checks the whole record.
template <class Entry>
Expected<void> check(std::string_view subject, const Entry& entry) {
  Expected<void> outcome;
  values::visit_fields(entry, [&](const values::Field& field, double recorded) {
    if (outcome) outcome = check(subject, field, recorded);
  });
  return outcome;
}

// Word for an entry, for messages.
template <class Entry>
constexpr std::string_view kWord = Entry::Values::list.entry;

// The entries in use of the list of a world.
template <class Entry, class World>
auto in_use(World& world) {
  return databuffer::ListOf<Entry>::entries_in_use(world);
}

void mark_changed(databuffer::WorldState& world) {
  world.flags &= ~databuffer::kWorldConfigured;
}
template <class Entry>
void mark_list_changed(databuffer::WorldState& world) {
  mark_changed(world);
  if constexpr (std::is_same_v<Entry, databuffer::WorldPoint>) world.flags |= databuffer::kWorldPointsChanged;
}

template <std::size_t size>
Expected<void> store_name(char (&into)[size], std::string_view subject, std::string_view name) {
  const auto printable = [](char letter) { return letter >= ' ' && letter <= '~'; };
  if (name.size() >= size || !std::ranges::all_of(name, printable))
    return fail(std::string(subject) + ": name",
                "at most " + std::to_string(size - 1) + " characters of printable ASCII",
                '"' + text::printable(std::string(name)) + '"', "choose a shorter or plainer name");
  std::ranges::fill(into, '\0');
  std::ranges::copy(name, into);
  return {};
}

template <class Entry>
Expected<void> name_entry(Entry& entry, std::string_view name) {
  if constexpr (requires { entry.name; }) return store_name(entry.name, kWord<Entry>, name);
  return fail(std::string(kWord<Entry>) + ": name", "none", '"' + text::printable(std::string(name)) + '"');
}
Expected<void> name_entry(databuffer::WorldPoint& point, std::string_view name) {
  const auto parts = radar::point_name(name);
  if (!parts)
    return fail("point: name", "2, target 2., offset 2.1 or target offset 2.01, with a number from 1 to 100",
                '"' + text::printable(std::string(name.substr(0, 40))) + '"');
  if (!radar::is_kind_of(static_cast<radar::PointKind>(point.kind), *parts))
    point.kind = static_cast<std::uint8_t>(radar::kind_by_name(*parts));
  return store_name(point.name, "point", name);
}

// ---- Rules of sequence points among each other
std::vector<radar::NamedPoint> named_points(const databuffer::WorldState& world, std::uint32_t without_id = 0) {
  std::vector<radar::NamedPoint> points;
  for (const databuffer::WorldPoint& point : databuffer::used(world.points, world.point_count)) {
    const auto name = radar::point_name(text::text_of(point.name));
    if (name && point.id != without_id) points.push_back({*name, static_cast<radar::PointKind>(point.kind)});
  }
  return points;
}

// Entries of other kinds go together with all others.
template <class Entry>
Expected<void> check_beside_others(const databuffer::WorldState& /*world*/, const Entry& /*entry*/) {
  return {};
}
Expected<void> check_beside_others(const databuffer::WorldState& world, const databuffer::WorldPoint& point) {
  const std::string text(text::text_of(point.name));
  const auto name = radar::point_name(text);
  if (!name || !radar::is_kind_of(static_cast<radar::PointKind>(point.kind), *name))
    return fail("point: name", "a name such as 2, 2., 2.1 or 2.01 with a kind that fits it", text);
  const auto others = named_points(world, point.id);
  const radar::NamedPoint* const other = radar::conflict(*name, others);
  if (other == nullptr) return {};
  return fail("point: name", "a name that no other point has, and a number that no other steer point or target has",
              text + " beside " + radar::text_of(other->name),
              "choose another number, or give an offset such as " + radar::text_of({name->number, 1, name->target}));
}

// The last steer point before a target becomes an initial point. Other points change nothing.
void make_initial_point(databuffer::WorldState& world, const databuffer::WorldPoint& target) {
  const auto name = radar::point_name(text::text_of(target.name));
  if (!name || target.kind != static_cast<std::uint8_t>(radar::PointKind::target)) return;
  const auto index = radar::initial_point_before(name->number, named_points(world));
  if (index) world.points[*index].kind = static_cast<std::uint8_t>(radar::PointKind::initial);
}

template <class Entry>
std::string ids_of(std::span<Entry> entries) {
  std::string ids;
  for (const Entry& entry : entries) ids += (ids.empty() ? "" : ", ") + std::to_string(entry.id);
  return ids.empty() ? "no entry in the world" : "one of the ids " + ids;
}

template <class Entry, class World>
auto find(World& world, std::uint32_t id) -> Expected<decltype(in_use<Entry>(world).data())> {
  const auto entries = in_use<Entry>(world);
  const auto found = std::ranges::find(entries, id, &Entry::id);
  if (found == entries.end())
    return fail(std::string(kWord<Entry>), ids_of(entries), "id " + std::to_string(id), "see `yars world`");
  return &*found;
}

// An id that no entry of the list has. It was not given before, unless all numbers have been.
template <class Entry>
std::uint32_t new_id(databuffer::WorldState& world) {
  do {
    world.last_id = std::max(world.last_id + 1, 1U);
  } while (find<Entry>(world, world.last_id));
  return world.last_id;
}

template <class Entry>
Expected<void> append_entry(databuffer::WorldState& world, const Entry& entry) {
  using List = databuffer::ListOf<Entry>;
  if (in_use<Entry>(world).size() == List::entries(world).size())
    return fail(std::string(kWord<Entry>), "at most " + std::to_string(List::entries(world).size()) + " in the world",
                "one more", "remove another one first");
  if (auto fitting = check_beside_others(world, entry); !fitting) return fitting;
  List::entries(world)[List::count(world)++] = entry;
  mark_list_changed<Entry>(world);
  return {};
}

// The entries behind the removed one keep their order.
template <class Entry>
Expected<void> remove_entry(databuffer::WorldState& world, std::uint32_t id) {
  const auto found = find<Entry>(world, id);
  if (!found) return tl::unexpected(found.error());
  const auto entries = in_use<Entry>(world);
  std::copy(*found + 1, entries.data() + entries.size(), *found);
  entries.back() = {};
  --databuffer::ListOf<Entry>::count(world);
  mark_list_changed<Entry>(world);
  return {};
}

template <class Entry>
Expected<std::uint32_t> add_entry(databuffer::WorldState& world, Entry& entry) {
  if (auto valid = check(kWord<Entry>, entry); !valid) return tl::unexpected(valid.error());
  const std::uint32_t last_id = world.last_id;
  entry.id = new_id<Entry>(world);
  if (auto added = append_entry(world, entry); !added) {
    world.last_id = last_id;
    return tl::unexpected(added.error());
  }
  if constexpr (std::is_same_v<Entry, databuffer::WorldPoint>) make_initial_point(world, entry);
  return entry.id;
}

template <class Entry>
Expected<void> replace_entry(databuffer::WorldState& world, const Entry& entry) {
  const auto found = find<Entry>(world, entry.id);
  if (!found) return tl::unexpected(found.error());
  if (auto valid = check(kWord<Entry>, entry); !valid) return valid;
  if (auto fitting = check_beside_others(world, entry); !fitting) return fitting;
  const Entry before = std::exchange(**found, entry);
  mark_list_changed<Entry>(world);
  if constexpr (std::is_same_v<Entry, databuffer::WorldPoint>)
    if (text::text_of(before.name) != text::text_of(entry.name)) make_initial_point(world, entry);
  return {};
}

template <class Entry>
Expected<void> restore_entry(databuffer::WorldState& world, const Entry& entry) {
  if (auto valid = check(kWord<Entry>, entry); !valid) return valid;
  if (find<Entry>(world, entry.id))
    return fail(std::string(kWord<Entry>), "one that was removed", "id " + std::to_string(entry.id) + " in the world");
  return append_entry(world, entry);
}

// Name of a steer point: the number that is one greater than the last, or else the lowest free one.
Expected<void> give_number(const databuffer::WorldState& world, databuffer::WorldPoint& point) {
  const auto others = named_points(world);
  const auto is_free = [&others](int number) { return radar::conflict({number, 0, false}, others) == nullptr; };
  int last = 0;
  for (const radar::NamedPoint& other : others) last = std::max(last, other.name.number);
  int number = last + 1;
  if (number > radar::kMaxPointNumber)
    for (number = 1; number <= radar::kMaxPointNumber && !is_free(number);) ++number;
  if (number > radar::kMaxPointNumber)
    return fail("point", "a free number from 1 to 100", "none", "remove another point first, or add an offset");
  return name_entry(point, std::to_string(number));
}

// What a new entry has beside the defaults of its values.
template <class Entry>
Expected<void> complete(const databuffer::WorldState& /*world*/, Entry& /*entry*/, std::int64_t /*sim_time_ns*/) {
  return {};
}
Expected<void> complete(const databuffer::WorldState& /*world*/, databuffer::WorldJammer& jammer, std::int64_t /*t*/) {
  jammer.band = radar::kEveryBand;
  jammer.channels = (1U << radar::kChannels) - 1U;
  return {};
}
Expected<void> complete(const databuffer::WorldState& /*world*/, databuffer::WorldMover& mover,
                        std::int64_t sim_time_ns) {
  mover.since_ns = sim_time_ns;
  return {};
}
Expected<void> complete(const databuffer::WorldState& world, databuffer::WorldPoint& point, std::int64_t /*t*/) {
  return give_number(world, point);
}

}  // namespace

Expected<WorldEntry> default_entry(const databuffer::WorldState& world, WorldList list, geo::GeoPoint position,
                                   std::int64_t sim_time_ns) {
  return databuffer::for_list(list, [&]<class Entry>(std::type_identity<Entry>) -> Expected<WorldEntry> {
    Entry entry{};
    values::visit_fields(entry,
                         [](const values::Field& field, double& value) { value = field.recorded(field.initial); });
    entry.latitude_deg = position.latitude_deg;
    entry.longitude_deg = position.longitude_deg;
    if (auto completed = complete(world, entry, sim_time_ns); !completed) return tl::unexpected(completed.error());
    return entry;
  });
}

Expected<void> set_name(WorldEntry& entry, std::string_view name) {
  return std::visit([name](auto& one) { return name_entry(one, name); }, entry);
}

Expected<std::uint32_t> add(databuffer::WorldState& world, WorldEntry entry) {
  return std::visit([&world](auto& one) { return add_entry(world, one); }, entry);
}

Expected<void> replace(databuffer::WorldState& world, const WorldEntry& entry) {
  return std::visit([&world](const auto& one) { return replace_entry(world, one); }, entry);
}

Expected<void> restore(databuffer::WorldState& world, const WorldEntry& entry) {
  return std::visit([&world](const auto& one) { return restore_entry(world, one); }, entry);
}

Expected<WorldEntry> entry_with(const databuffer::WorldState& world, WorldList list, std::uint32_t id,
                                std::int64_t sim_time_ns) {
  return databuffer::for_list(list, [&]<class Entry>(std::type_identity<Entry>) -> Expected<WorldEntry> {
    const auto found = find<Entry>(world, id);
    if (!found) return tl::unexpected(found.error());
    if constexpr (std::is_same_v<Entry, databuffer::WorldMover>) return at_sim_time(**found, sim_time_ns);
    return **found;
  });
}

Expected<void> move(databuffer::WorldState& world, WorldList list, std::uint32_t id, geo::GeoPoint position,
                    std::int64_t sim_time_ns) {
  auto moved = entry_with(world, list, id, sim_time_ns);
  if (!moved) return tl::unexpected(moved.error());
  return std::visit(
      [&](auto& entry) {
        entry.latitude_deg = position.latitude_deg;
        entry.longitude_deg = position.longitude_deg;
        return replace_entry(world, entry);
      },
      *moved);
}

Expected<void> steer(databuffer::WorldState& world, std::uint32_t id, double speed_mps, double heading_deg,
                     std::int64_t sim_time_ns) {
  auto found = entry_with(world, WorldList::movers, id, sim_time_ns);
  if (!found) return tl::unexpected(found.error());
  auto& mover = std::get<databuffer::WorldMover>(*found);
  mover.speed_mps = speed_mps;
  mover.heading_deg = heading_deg;
  return replace_entry(world, mover);
}

Expected<void> remove(databuffer::WorldState& world, WorldList list, std::uint32_t id) {
  return databuffer::for_list(list,
                              [&]<class Entry>(std::type_identity<Entry>) { return remove_entry<Entry>(world, id); });
}

Expected<void> set_sea_state(databuffer::WorldState& world, double state) {
  if (auto valid = check("world", values::WorldState::sea_state, state); !valid) return valid;
  world.sea_state = state;
  mark_changed(world);
  return {};
}

Expected<void> set_wind(databuffer::WorldState& world, double speed_mps, double from_deg) {
  if (auto valid = check("world", values::WorldState::wind_speed, speed_mps); !valid) return valid;
  if (auto valid = check("world", values::WorldState::wind_from, from_deg); !valid) return valid;
  world.wind_speed_mps = speed_mps;
  world.wind_from_deg = from_deg;
  mark_changed(world);
  return {};
}

Expected<void> set_fidelity(databuffer::WorldState& world, std::string_view preset) {
  if (!preset.empty() && !radar::fidelity_preset(preset)) {
    std::string names;
    for (const std::string_view name : radar::fidelity_names()) names += std::string(name) + ", ";
    return fail("fidelity", names + "or an empty text for the configured one", std::string(preset.substr(0, 40)));
  }
  std::fill(std::begin(world.fidelity), std::end(world.fidelity), '\0');
  preset.copy(world.fidelity, sizeof world.fidelity - 1);
  mark_changed(world);
  return {};
}

databuffer::WorldMover at_sim_time(const databuffer::WorldMover& mover, std::int64_t sim_time_ns) {
  const geo::GeodesicRay way({mover.latitude_deg, mover.longitude_deg}, geo::Bearing::degrees(mover.heading_deg));
  const double elapsed_s = static_cast<double>(sim_time_ns - mover.since_ns) * 1e-9;
  const auto there = way.position_and_azimuth(geo::Length::metres(mover.speed_mps * elapsed_s));
  databuffer::WorldMover now = mover;
  now.latitude_deg = there.point.latitude_deg;
  now.longitude_deg = there.point.longitude_deg;
  now.heading_deg = there.azimuth.degrees();
  now.since_ns = sim_time_ns;
  return now;
}

}  // namespace yars::world

#include "station/instructor_message.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "databuffer/messages/inspection.hpp"
#include "databuffer/messages/limits.hpp"
#include "lib/geo/geodesy.hpp"
#include "lib/text/plain_text.hpp"
#include "lib/values/fields.hpp"
#include "world/world_edit.hpp"

namespace yars::station {

using databuffer::WorldState;

void RemovedEntries::note(const WorldState& before, const WorldState& after) {
  databuffer::for_each_list([&]<class Entry>(std::type_identity<Entry>) {
    const auto remaining = databuffer::ListOf<Entry>::entries_in_use(after);
    for (const Entry& entry : databuffer::ListOf<Entry>::entries_in_use(before)) {
      if (std::ranges::find(remaining, entry.id, &Entry::id) != remaining.end()) continue;
      entries_.emplace_front(entry);
      if (entries_.size() > kMaxEntries) entries_.pop_back();
    }
  });
}

error::Expected<void> RemovedEntries::restore(WorldState& world, world::WorldList list, std::uint32_t id) const {
  for (const world::WorldEntry& entry : entries_) {
    if (entry.index() != static_cast<std::size_t>(list)) continue;
    if (std::visit([](const auto& removed) { return removed.id; }, entry) != id) continue;
    return world::restore(world, entry);
  }
  return error::fail("restore", "an entry that a page has removed", "id " + std::to_string(id), "add a new one");
}

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

namespace {

using error::Expected;
using nlohmann::json;

constexpr std::size_t kMaxPathLetters = 1000, kMaxNoteLetters = 100;
constexpr double kMaxTime_s = databuffer::kLatestSimTime_s, kMaxTicks = 2000.0;

struct Limits {
  double min, max;
};
Limits limits(const values::Field& field) {
  return {field.low, field.high};
}

// Arguments of one command, by name.
class Arguments {
 public:
  Arguments(const json& object, std::string command) : object_(object), command_(std::move(command)) {}

  double number(const char* name, Limits limits) { return number(name, limits, "a number", false); }
  std::int64_t whole_number(const char* name, Limits limits) {
    const double value = number(name, limits, "a whole number", true);
    return problem_ ? 0 : static_cast<std::int64_t>(value);
  }
  std::optional<double> optional_number(const char* name, Limits limits) {
    const auto found = object_.find(name);
    if (found == object_.end() || found->is_null()) return std::nullopt;
    return number(name, limits);
  }
  std::string text(const char* name, std::size_t letters) {
    const auto found = object_.find(name);
    if (found != object_.end() && found->is_string()) {
      const auto& value = found->get_ref<const std::string&>();
      if (!value.empty() && value.size() <= letters && value.find('\0') == std::string::npos) return value;
    }
    refuse(name, "a text of 1 to " + std::to_string(letters) + " bytes", found);
    return {};
  }
  world::WorldList list(const char* name) {
    if (const auto list = world_list(object_, name)) return *list;
    refuse(name, world_lists(), object_.find(name));
    return {};
  }
  const std::optional<error::Error>& problem() const { return problem_; }

 private:
  double number(const char* name, Limits limits, const char* kind, bool whole) {
    const auto found = object_.find(name);
    const double value = found != object_.end() && found->is_number() ? found->get<double>() : NAN;
    if (!(value >= limits.min && value <= limits.max) || (whole && std::trunc(value) != value))
      refuse(
          name,
          std::string(kind) + " from " + text::text_of_number(limits.min) + " to " + text::text_of_number(limits.max),
          found);
    return value;
  }
  void refuse(const char* name, const std::string& expected, const json::const_iterator& found) {
    if (problem_) return;
    problem_ =
        error::Error{command_ + ": " + name,
                     expected,
                     found == object_.end() ? "nothing" : found->dump(-1, ' ', true, json::error_handler_t::replace),
                     {}};
  }

  const json& object_;
  std::string command_;
  std::optional<error::Error> problem_;
};

using Make = InstructorCommand (*)(Arguments& arguments);

constexpr std::array<std::pair<std::string_view, Make>, 16> kCommands{{
    {"run", [](Arguments&) -> InstructorCommand { return SetRunning{true}; }},
    {"freeze", [](Arguments&) -> InstructorCommand { return SetRunning{false}; }},
    {"rate",
     [](Arguments& of) -> InstructorCommand { return SetRate{of.number("rate", {0.0, databuffer::kMaxClockRate})}; }},
    {"step", [](Arguments& of) -> InstructorCommand { return Step{of.whole_number("ticks", {1.0, kMaxTicks})}; }},
    {"reset", [](Arguments& of) -> InstructorCommand { return Reset{of.number("time", {0.0, kMaxTime_s})}; }},
    {"reposition",
     [](Arguments& of) -> InstructorCommand {
       using To = values::Reposition;
       return Reposition{{of.number("lat", limits(To::latitude)), of.number("lon", limits(To::longitude))},
                         of.number("alt_ft", limits(To::altitude)),
                         of.number("heading", limits(To::heading)),
                         of.optional_number("speed_kt", limits(To::speed))};
     }},
    {"restore",
     [](Arguments& of) -> InstructorCommand {
       const world::WorldList list = of.list("list");
       return RestoreEntry{list, static_cast<std::uint32_t>(of.whole_number("item", {1.0, 4294967295.0}))};
     }},
    {"reset world", [](Arguments&) -> InstructorCommand { return ResetWorld{}; }},
    {"undo reset", [](Arguments&) -> InstructorCommand { return UndoReset{}; }},
    {"kill", [](Arguments& of) -> InstructorCommand { return KillRole{of.text("role", 30)}; }},
    {"note", [](Arguments& of) -> InstructorCommand { return WriteNote{of.text("text", kMaxNoteLetters)}; }},
    {"record", [](Arguments&) -> InstructorCommand { return StartRecorder{}; }},
    {"recordings", [](Arguments&) -> InstructorCommand { return ListRecordings{}; }},
    {"play",
     [](Arguments& of) -> InstructorCommand {
       return PlayRecording{of.text("file", kMaxPathLetters), of.number("at", {0.0, kMaxTime_s})};
     }},
    {"fly out",
     [](Arguments& of) -> InstructorCommand {
       return FlyOut{of.text("file", kMaxPathLetters), of.number("at", {0.0, kMaxTime_s})};
     }},
    {"end", [](Arguments& of) -> InstructorCommand { return EndSet{of.text("session", 40)}; }},
}};

std::string names_of_commands() {
  std::string names;
  for (const auto& [name, make] : kCommands) names += (names.empty() ? "" : ", ") + std::string(name);
  return names + ", " + std::string(world_commands());
}

}  // namespace

bool is_id(const json& value) {
  return value.is_number_integer() && (!value.is_number_unsigned() || value.get<std::uint64_t>() <= INT64_MAX);
}

Expected<InstructorMessage> instructor_message(const json& object) {
  const auto name = object.find("do"), id = object.find("id");
  const std::string word = name != object.end() && name->is_string() ? name->get<std::string>() : "";
  const auto entry = std::ranges::find_if(kCommands, [&](const auto& command) { return command.first == word; });
  if (id == object.end() || !is_id(*id)) return error::fail("id", "a whole number", "something else");
  if (auto edit = world_edit(word, object)) {
    if (!*edit) return tl::unexpected(edit->error());
    return InstructorMessage{id->get<std::int64_t>(), EditWorld{std::move(**edit)}};
  }
  if (entry == kCommands.end())
    return error::fail("do", "one of " + names_of_commands(), word.empty() ? "nothing" : word.substr(0, 40));
  Arguments arguments(object, word);
  InstructorMessage message{id->get<std::int64_t>(), entry->second(arguments)};
  if (arguments.problem()) return tl::unexpected(*arguments.problem());
  return message;
}

std::string answer_to(std::int64_t id, const std::optional<std::string>& problem) {
  nlohmann::ordered_json answer{{"answer", id}, {"problem", nullptr}};
  if (problem) answer["problem"] = *problem;
  return answer.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace yars::station

// `yars world`: prints the world in effect, and changes it while the set flies: sea, wind, and the entries of its
// lists.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include "databuffer/messages/world_lists.hpp"
#include "databuffer/session/session_changes.hpp"
#include "lib/radar/world.hpp"
#include "lib/text/plain_text.hpp"
#include "lib/values/fields.hpp"
#include "tools/command/command.hpp"
#include "world/world_edit.hpp"
#include "world/world_json.hpp"

namespace yars::tools {

namespace {

using databuffer::Session;
using databuffer::WorldState;
using error::Expected;
using world::WorldList;

struct WorldOptions {
  const CommonOptions& common;
  bool json = false;
};

// A change, given the world before and the session's sim time. It ends with a text for the user: what was done.
using Edit = std::function<Expected<std::string>(WorldState& world, std::int64_t sim_time_ns)>;

// ---- Output
std::string number(double value) {
  return text::text_of_number(value);
}

bool is_of_position(const values::Field& field) {
  return field.name == values::WorldPoint::latitude.name || field.name == values::WorldPoint::longitude.name;
}

std::string position_text(double latitude_deg, double longitude_deg) {
  char text[48];
  std::snprintf(text, sizeof text, "%.5f %.5f", latitude_deg, longitude_deg);
  return text;
}

// A value of a record with six digits, in the unit in which people give it.
std::string rounded(double recorded, const values::Field& field) {
  char text[48];
  std::snprintf(text, sizeof text, "%.6g ", field.given(recorded));
  return text + std::string(field.unit);
}

// What an entry has beside its position, name and values.
template <class Entry>
std::string others_of(const Entry& /*entry*/) {
  return "";
}
std::string others_of(const databuffer::WorldJammer& jammer) {
  return std::string(", band ") + world::band_name(jammer.band);
}
std::string others_of(const databuffer::WorldMover& mover) {
  std::string text = ", " + std::string(world::echo_name(mover));
  if (radar::is_reflector(static_cast<radar::TargetEcho>(mover.echo)))
    text += ", facing " + std::to_string(mover.facing_deg) + " deg, tilt " + std::to_string(mover.tilt_deg) + " deg";
  return text;
}
std::string others_of(const databuffer::WorldPoint& point) {
  return ", " + std::string(world::kind_name(point));
}

// The number of an entry, and its name: "3", "3 \"ferry\"".
template <class Entry>
std::string number_and_name(const Entry& entry, std::uint32_t id) {
  std::string text = std::to_string(id);
  if constexpr (requires { entry.name; })
    if (entry.name[0] != '\0') text += " \"" + std::string(text::text_of(entry.name)) + '"';
  return text;
}

template <class Entry>
void print_entry(const Entry& entry) {
  std::string text = std::string(Entry::Values::list.command) + ' ' + number_and_name(entry, entry.id);
  text += ": " + position_text(entry.latitude_deg, entry.longitude_deg);
  values::visit_fields(entry, [&text](const values::Field& field, double value) {
    if (is_of_position(field)) return;
    text += ", " + std::string(field.label) + ' ';
    text += std::isnan(value) ? std::string(field.otherwise) : rounded(value, field);
  });
  std::printf("%s%s\n", text.c_str(), others_of(entry).c_str());
}

void print_entries(const WorldState& world, std::int64_t sim_time_ns) {
  databuffer::for_each_list([&]<class Entry>(std::type_identity<Entry>) {
    for (const Entry& entry : databuffer::ListOf<Entry>::entries_in_use(world)) {
      if constexpr (std::is_same_v<Entry, databuffer::WorldMover>)
        print_entry(world::at_sim_time(entry, sim_time_ns));
      else
        print_entry(entry);
    }
  });
}

bool is_in_effect(const Session& session, const WorldState& world) {
  const auto in_effect = databuffer::world_in_effect(session.layout());
  return in_effect && in_effect->edit == world.edit;
}

// Prints a world; `done`: line about a change that led to it, or empty.
void report(const Session& session, const WorldState& world, const std::string& done, bool json) {
  const std::int64_t now_ns = session.reached_sim_time_ns();
  const bool in_effect = is_in_effect(session, world);
  if (json) {
    auto object = world::world_json(world, now_ns);
    object["in_effect"] = in_effect;
    return print_json(object);
  }
  const char* waiting = in_effect ? "" : "; radar-model latches it at its next tick (frozen clock: yars sim run)";
  if (!done.empty()) {
    std::printf("%s; edit %llu%s\n", done.c_str(), static_cast<unsigned long long>(world.edit), waiting);
    return;
  }
  std::printf("edit %llu%s%s\n", static_cast<unsigned long long>(world.edit),
              (world.flags & databuffer::kWorldConfigured) != 0U ? ", the configuration's world" : "", waiting);
  std::printf("sea state %s, wind %s from %s\n",
              std::isnan(world.sea_state) ? "from the wind" : number(world.sea_state).c_str(),
              rounded(world.wind_speed_mps, values::WorldState::wind_speed).c_str(),
              rounded(world.wind_from_deg, values::WorldState::wind_from).c_str());
  print_entries(world, now_ns);
}

void print_world(const WorldOptions& options) {
  const auto session = Session::open_read_only(options.common.session);
  if (!session) throw_failure(session.error());
  const auto world = databuffer::newest_world(std::as_const(*session).layout());
  if (!world)
    throw_failure(
        {"world", "a world that radar-model has published", "none", "start radar-model, or let it run a tick"});
  report(*session, *world, "", options.json);
}

// ---- Changes
Session open_world_session(const CommonOptions& common) {
  // A command that changes the world makes no session.
  if (const auto running = Session::open_read_only(common.session); !running) throw_failure(running.error());
  auto session = Session::open(common.session, "yars world");
  if (!session) throw_failure(session.error());
  return std::move(*session);
}

// radar-model latches a change within a tick if the clock runs. From another host that takes a transmission more.
WorldState await_effect(const Session& session, const WorldState& world) {
  const int attempts = session.is_mirrored(databuffer::Role::radar_model) ? 200 : 40;
  for (int attempt = 0; attempt < attempts && !is_in_effect(session, world); ++attempt)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  return is_in_effect(session, world) ? databuffer::world_in_effect(session.layout()).value_or(world) : world;
}

void change(const WorldOptions& options, const Edit& edit) {
  Session session = open_world_session(options.common);
  const std::int64_t now_ns = session.reached_sim_time_ns();
  std::string done;
  const auto changed = databuffer::change_world(session, [&](const WorldState& before) -> Expected<WorldState> {
    WorldState next = before;
    auto outcome = edit(next, now_ns);
    if (!outcome) return tl::unexpected(outcome.error());
    done = std::move(*outcome);
    return next;
  });
  if (!changed) throw_failure(changed.error());
  report(session, await_effect(std::as_const(session), *changed), done, options.json);
}

void reset(const WorldOptions& options) {
  Session session = open_world_session(options.common);
  const auto changed = databuffer::change_world(session, databuffer::reset_of(session));
  if (!changed) throw_failure(changed.error());
  report(session, await_effect(std::as_const(session), *changed), "the configuration's world", options.json);
}

// Result of an edit without a value, as a text.
Expected<std::string> text_if_done(Expected<void> outcome, std::string done) {
  if (!outcome) return tl::unexpected(outcome.error());
  return done;
}

struct Place {
  double latitude_deg = 0.0, longitude_deg = 0.0;
  std::uint64_t id = 0;
  geo::GeoPoint point() const { return {latitude_deg, longitude_deg}; }
};

void add_id(runtime::Command command, Place& place) {
  command.option("ID", place.id, "number of the entry, as `yars world` prints it")
      .range(std::uint64_t{1}, std::uint64_t{std::numeric_limits<std::uint32_t>::max()})
      .required();
}

void add_position(runtime::Command command, Place& place) {
  add_value(command, "LAT", values::WorldPoint::latitude, place.latitude_deg).required();
  add_value(command, "LON", values::WorldPoint::longitude, place.longitude_deg).required();
}

// Options of the values that an entry has beside those of lib/values/fields.hpp.
template <class Entry>
struct OtherOptions {
  void add(runtime::Command /*command*/, const std::string& /*otherwise*/) {}
  void write(Entry& /*entry*/) const {}
};
template <>
struct OtherOptions<databuffer::WorldJammer> {
  std::string band;
  std::vector<double> channels;
  void add(runtime::Command command, const std::string& otherwise) {
    command.option("--band", band, "jammed band")
        .one_of({"A", "B", "C", "D", "E", "all"})
        .otherwise(otherwise.empty() ? "all" : otherwise);
    command.option("--channel", channels, "jammed channel; repeatable")
        .one_of({"1", "2", "3", "4", "5", "6", "7", "8"})
        .repeatable()
        .otherwise(otherwise.empty() ? "all channels" : otherwise);
  }
  void write(databuffer::WorldJammer& jammer) const {
    if (!band.empty()) jammer.band = band == "all" ? radar::kEveryBand : band.front() - 'A';
    if (!channels.empty()) jammer.channels = 0;
    for (const double channel : channels) jammer.channels |= 1U << (static_cast<unsigned>(channel) - 1U);
  }
};

template <>
struct OtherOptions<databuffer::WorldMover> {
  std::string echo;
  std::optional<int> facing_deg, tilt_deg;
  void add(runtime::Command command, const std::string& otherwise) {
    const std::vector<std::string> echoes(radar::kTargetEchoNames.begin(), radar::kTargetEchoNames.end());
    command.option("--echo", echo, "fluctuation from scan to scan, or a corner reflector")
        .one_of(echoes)
        .otherwise(otherwise.empty() ? echoes.front() : otherwise);
    command.option("--facing", facing_deg, "[deg] true azimuth of a reflector's axis")
        .range(0, 359)
        .otherwise(otherwise.empty() ? "0" : otherwise);
    command.option("--tilt", tilt_deg, "[deg] elevation of a reflector's axis")
        .range(-90, 90)
        .otherwise(otherwise.empty() ? "0" : otherwise);
  }
  void write(databuffer::WorldMover& mover) const {
    const auto found = std::ranges::find(radar::kTargetEchoNames, echo);
    if (!echo.empty()) mover.echo = static_cast<std::uint8_t>(found - radar::kTargetEchoNames.begin());
    if (facing_deg) mover.facing_deg = static_cast<std::uint16_t>(*facing_deg);
    if (tilt_deg) mover.tilt_deg = static_cast<std::int8_t>(*tilt_deg);
  }
};

constexpr const char* kAsItIs = "as it is";

// What a user gives of an entry: name and values, in the units in which people give them.
template <class Entry>
class EntryOptions {
 public:
  // `otherwise`: what holds for what is left out; empty: its default.
  void add(runtime::Command command, const std::string& otherwise) {
    constexpr bool kIsPoint = std::is_same_v<Entry, databuffer::WorldPoint>;
    if constexpr (requires { Entry::name; })
      command
          .option("--name", name_,
                  kIsPoint ? "\"2\", target \"2.\", offset \"2.1\", target offset \"2.01\""
                           : "name, at most " + std::to_string(sizeof(Entry::name) - 1) + " characters")
          .otherwise(!otherwise.empty() ? otherwise
                     : kIsPoint         ? "a steer point with the next number"
                                        : "none");
    auto value = values_.begin();
    for (const values::Field& field : Entry::Values::given) {
      runtime::Option option = add_value(command, "--" + std::string(field.option), field, *value++);
      if (!otherwise.empty())
        option.otherwise(otherwise);
      else if (!std::isnan(field.initial))
        option.otherwise(number(field.initial));
    }
    others_.add(command, otherwise);
  }

  Expected<void> write(world::WorldEntry& entry) const {
    if (!name_.empty())
      if (auto named = world::set_name(entry, name_); !named) return named;
    auto value = values_.begin();
    values::visit_fields(std::get<Entry>(entry), [&](const values::Field& field, double& recorded) {
      if (is_of_position(field)) return;
      if (*value) recorded = field.recorded(**value);
      ++value;
    });
    others_.write(std::get<Entry>(entry));
    return {};
  }

 private:
  std::string name_;
  std::array<std::optional<double>, Entry::Values::given.size()> values_;
  OtherOptions<Entry> others_;
};

using Shared = std::shared_ptr<WorldOptions>;

runtime::Command add_action(runtime::Command parent, const char* name, const std::string& help, const Shared& options,
                            const std::function<void()>& call) {
  runtime::Command command = parent.subcommand(name, help);
  add_json_flag(command, options->json);
  command.callback(call);
  return command;
}
runtime::Command add_edit(runtime::Command parent, const char* name, const std::string& help, const Shared& options,
                          const Edit& edit) {
  return add_action(parent, name, help, options, [options, edit] { change(*options, edit); });
}

template <class Entry>
struct EntryArguments {
  Place place;
  EntryOptions<Entry> options;
  std::uint32_t id() const { return static_cast<std::uint32_t>(place.id); }
  std::string word() const { return std::string(Entry::Values::list.entry) + ' '; }
  // "jammer 3 moved"
  Expected<std::string> done(Expected<void> outcome, const char* what) const {
    return text_if_done(std::move(outcome), word() + std::to_string(id()) + what);
  }
};

// `add`, `change`, `move` and `remove` of a list.
template <class Entry>
runtime::Command add_list(runtime::Command parent, const Shared& options) {
  constexpr WorldList kList = databuffer::ListOf<Entry>::list;
  const std::string word(Entry::Values::list.entry);
  runtime::Command list = parent.subcommand(std::string(Entry::Values::list.command), word + 's');
  list.require_subcommand();

  const auto added = std::make_shared<EntryArguments<Entry>>();
  runtime::Command adding = add_edit(list, "add", "add a " + word, options,
                                     [added](WorldState& world, std::int64_t now_ns) -> Expected<std::string> {
                                       auto entry = world::default_entry(world, kList, added->place.point(), now_ns);
                                       if (!entry) return tl::unexpected(entry.error());
                                       if (auto written = added->options.write(*entry); !written)
                                         return tl::unexpected(written.error());
                                       const auto id = world::add(world, *entry);
                                       if (!id) return tl::unexpected(id.error());
                                       return added->word() + number_and_name(std::get<Entry>(*entry), *id) + " added";
                                     });
  add_position(adding, added->place);
  added->options.add(adding, "");

  const auto changed = std::make_shared<EntryArguments<Entry>>();
  runtime::Command changing = add_edit(list, "change", "change the name or the values of a " + word, options,
                                       [changed](WorldState& world, std::int64_t now_ns) -> Expected<std::string> {
                                         auto entry = world::entry_with(world, kList, changed->id(), now_ns);
                                         if (!entry) return tl::unexpected(entry.error());
                                         if (auto written = changed->options.write(*entry); !written)
                                           return tl::unexpected(written.error());
                                         return changed->done(world::replace(world, *entry), " changed");
                                       });
  add_id(changing, changed->place);
  changed->options.add(changing, kAsItIs);

  const auto moved = std::make_shared<EntryArguments<Entry>>();
  runtime::Command moving = add_edit(
      list, "move", "move a " + word + " to a position", options, [moved](WorldState& world, std::int64_t now_ns) {
        return moved->done(world::move(world, kList, moved->id(), moved->place.point(), now_ns), " moved");
      });
  add_id(moving, moved->place);
  add_position(moving, moved->place);

  const auto removed = std::make_shared<EntryArguments<Entry>>();
  add_id(add_edit(list, "remove", "remove a " + word, options,
                  [removed](WorldState& world, std::int64_t) {
                    return removed->done(world::remove(world, kList, removed->id()), " removed");
                  }),
         removed->place);
  return list;
}

void add_steer(runtime::Command mover, const Shared& options) {
  struct Values {
    Place place;
    double speed_kt = 0.0, heading_deg = 0.0;
  };
  const auto values = std::make_shared<Values>();
  runtime::Command command =
      add_edit(mover, "steer", "change speed and heading where the mover is", options,
               [values](WorldState& world, std::int64_t now_ns) {
                 const auto id = static_cast<std::uint32_t>(values->place.id);
                 const double speed_mps = values::WorldMover::speed.recorded(values->speed_kt);
                 return text_if_done(world::steer(world, id, speed_mps, values->heading_deg, now_ns),
                                     "mover " + std::to_string(id) + " steered");
               });
  add_id(command, values->place);
  add_value(command, "SPEED_KT", values::WorldMover::speed, values->speed_kt).required();
  add_value(command, "HDG", values::WorldMover::heading, values->heading_deg).required();
}

void add_wind(runtime::Command parent, const Shared& options) {
  struct Values {
    double speed_kt = 0.0, from_deg = 0.0;
  };
  const auto values = std::make_shared<Values>();
  runtime::Command command =
      add_edit(parent, "wind", "set the wind over the sea", options, [values](WorldState& world, std::int64_t) {
        const double speed_mps = values::WorldState::wind_speed.recorded(values->speed_kt);
        return text_if_done(world::set_wind(world, speed_mps, values->from_deg),
                            "wind " + number(values->speed_kt) + " kt from " + number(values->from_deg) + " deg");
      });
  add_value(command, "SPEED_KT", values::WorldState::wind_speed, values->speed_kt).required();
  add_value(command, "FROM_DEG", values::WorldState::wind_from, values->from_deg).required();
}

void set_sea(const WorldOptions& options, const std::string& word) {
  double state = std::numeric_limits<double>::quiet_NaN();
  if (word != "auto") {
    char* end = nullptr;
    state = std::strtod(word.c_str(), &end);
    if (end == word.c_str() || *end != '\0' || std::isnan(state))
      throw_failure(error::usage_error(
          "STATE", "a sea state from 0 to " + number(values::WorldState::sea_state.high) + ", or auto",
          '\'' + word + '\''));
  }
  change(options, [state, &word](WorldState& world, std::int64_t) {
    return text_if_done(world::set_sea_state(world, state),
                        word == "auto" ? "sea state from the wind" : "sea state " + word);
  });
}

}  // namespace

void add_world_command(runtime::Command app, const CommonOptions& common) {
  runtime::Command world = app.subcommand("world", "print or change the world: sea, wind, and what is in its lists");
  const auto options = std::make_shared<WorldOptions>(WorldOptions{common});
  add_json_flag(world, options->json);
  world.callback([world, options] {
    if (!world.has_subcommand()) print_world(*options);
  });
  const auto state = std::make_shared<std::string>();
  add_action(world, "sea", "set the sea state", options, [options, state] { set_sea(*options, *state); })
      .option("STATE", *state, std::string(values::WorldState::sea_state.purpose) + "; auto: from the wind")
      .required();
  add_wind(world, options);
  databuffer::for_each_list([&]<class Entry>(std::type_identity<Entry>) {
    runtime::Command list = add_list<Entry>(world, options);
    if constexpr (std::is_same_v<Entry, databuffer::WorldMover>) add_steer(list, options);
  });
  add_action(world, "reset", "the configuration's world", options, [options] { reset(*options); });
}

}  // namespace yars::tools

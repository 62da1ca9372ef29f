// `yars world`: prints the world in effect, and changes it while the set flies: sea, wind, rain, jammers, movers,
// sequence points.

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

#include "databuffer/messages/inspection.hpp"
#include "databuffer/session/session_world.hpp"
#include "lib/text/plain_text.hpp"
#include "lib/values/fields.hpp"
#include "tools/command/command.hpp"
#include "tools/command/json_output.hpp"
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

std::string named(std::uint32_t id, const char* name) {
  std::string text = std::to_string(id);
  if (*name != '\0') text.append(" ").append(name);
  return text;
}

void print_entries(const WorldState& world, std::int64_t sim_time_ns) {
  using Rain = values::WorldRainCell;
  using Jammer = values::WorldJammer;
  using Mover = values::WorldMover;
  for (const auto& cell : databuffer::used(world.rain, world.rain_count))
    std::printf("rain %u: %s, radius %s, %s, top %s\n", cell.id,
                position_text(cell.latitude_deg, cell.longitude_deg).c_str(),
                rounded(cell.radius_m, Rain::radius).c_str(), rounded(cell.rate_mmh, Rain::rate).c_str(),
                rounded(cell.top_m, Rain::top).c_str());
  for (const auto& jammer : databuffer::used(world.jammers, world.jammer_count))
    std::printf(
        "jammer %s: %s, %s, band %s, %s\n", named(jammer.id, jammer.name).c_str(),
        position_text(jammer.latitude_deg, jammer.longitude_deg).c_str(),
        std::isnan(jammer.altitude_m) ? "10 m above ground" : rounded(jammer.altitude_m, Jammer::altitude).c_str(),
        world::band_name(jammer.band), rounded(jammer.power_w, Jammer::power).c_str());
  for (const auto& mover : databuffer::used(world.movers, world.mover_count)) {
    const auto now = world::at_sim_time(mover, sim_time_ns);
    std::printf("mover %s: %s, %s, heading %s, %s\n", named(now.id, now.name).c_str(),
                position_text(now.latitude_deg, now.longitude_deg).c_str(),
                rounded(now.speed_mps, Mover::speed).c_str(), rounded(now.heading_deg, Mover::heading).c_str(),
                rounded(now.cross_section_m2, Mover::cross_section).c_str());
  }
  for (const auto& point : databuffer::used(world.points, world.point_count))
    std::printf("point %u \"%s\": %s, %s, %s\n", point.id, point.name,
                position_text(point.latitude_deg, point.longitude_deg).c_str(),
                std::isnan(point.elevation_m) ? "elevation unknown"
                                              : rounded(point.elevation_m, values::WorldPoint::elevation).c_str(),
                std::string(world::kind_name(point)).c_str());
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

template <class Entry>
Expected<std::string> added(WorldState& world, const Entry& entry, const std::string& what) {
  const auto id = world::add(world, entry);
  if (!id) return tl::unexpected(id.error());
  return what + " " + std::to_string(*id) + " added";
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

// What a user gives for a new entry: position, name, and its other values in the units in which people give them.
template <class Entry>
class NewEntry {
 public:
  geo::GeoPoint position() const { return place_.point(); }

  void add_options(runtime::Command command) {
    add_position(command, place_);
    if constexpr (requires { Entry::name; })
      command.option("--name", name_, "name, at most " + std::to_string(sizeof(Entry::name) - 1) + " characters")
          .otherwise("none");
    auto number = numbers_.begin();
    for (const values::Field& field : Entry::Values::all) {
      const std::string option = "--" + std::string(field.option);
      if (is_of_position(field)) continue;
      number->value = field.initial;
      if (std::isnan(field.initial))
        add_value(command, option, field, number++->optional);
      else
        add_value(command, option, field, number++->value);
    }
  }

  Expected<void> write(Entry& entry) const {
    auto number = numbers_.begin();
    values::visit_fields(entry, [&](const values::Field& field, double& value) {
      if (is_of_position(field)) return;
      value = field.recorded(std::isnan(field.initial) ? number->optional.value_or(field.initial) : number->value);
      ++number;
    });
    if constexpr (requires { Entry::name; }) return world::set_name(entry, name_);
    return {};
  }

 private:
  struct Number {
    double value = 0.0;
    std::optional<double> optional;  // of a value without a default
  };
  static bool is_of_position(const values::Field& field) {
    return field.name == values::WorldPoint::latitude.name || field.name == values::WorldPoint::longitude.name;
  }

  Place place_;
  std::string name_;
  std::array<Number, Entry::Values::all.size()> numbers_;
};

using Shared = std::shared_ptr<WorldOptions>;

runtime::Command add_action(runtime::Command parent, const char* name, const char* help, const Shared& options,
                            const std::function<void()>& call) {
  runtime::Command command = parent.subcommand(name, help);
  add_json_flag(command, options->json);
  command.callback(call);
  return command;
}

// `move` and `remove` of one list.
void add_move_and_remove(runtime::Command list_command, WorldList list, const std::string& what,
                         const Shared& options) {
  const auto place = std::make_shared<Place>();
  runtime::Command moving =
      add_action(list_command, "move", "move an entry to a position", options, [options, place, list, what] {
        change(*options, [&](WorldState& world, std::int64_t now_ns) {
          const auto id = static_cast<std::uint32_t>(place->id);
          return text_if_done(world::move(world, list, id, place->point(), now_ns),
                              what + " " + std::to_string(id) + " moved");
        });
      });
  add_id(moving, *place);
  add_position(moving, *place);
  runtime::Command removing =
      add_action(list_command, "remove", "remove an entry", options, [options, place, list, what] {
        change(*options, [&](WorldState& world, std::int64_t) {
          const auto id = static_cast<std::uint32_t>(place->id);
          return text_if_done(world::remove(world, list, id), what + " " + std::to_string(id) + " removed");
        });
      });
  add_id(removing, *place);
}

void add_rain(runtime::Command parent, const Shared& options) {
  runtime::Command rain = parent.subcommand("rain", "rain cells");
  rain.require_subcommand();
  const auto given = std::make_shared<NewEntry<databuffer::WorldRainCell>>();
  given->add_options(add_action(rain, "add", "add a rain cell", options, [options, given] {
    change(*options, [&](WorldState& world, std::int64_t) -> Expected<std::string> {
      auto cell = world::default_rain_cell(given->position());
      if (auto written = given->write(cell); !written) return tl::unexpected(written.error());
      return added(world, cell, "rain cell");
    });
  }));
  add_move_and_remove(rain, WorldList::rain, "rain cell", options);
}

void add_jammer(runtime::Command parent, const Shared& options) {
  struct Given : NewEntry<databuffer::WorldJammer> {
    std::string band = "all";
    std::vector<double> channels;
  };
  runtime::Command jammer = parent.subcommand("jammer", "noise jammers");
  jammer.require_subcommand();
  const auto given = std::make_shared<Given>();
  runtime::Command command = add_action(jammer, "add", "add a jammer", options, [options, given] {
    change(*options, [&](WorldState& world, std::int64_t) -> Expected<std::string> {
      auto entry = world::default_jammer(given->position());
      if (auto written = given->write(entry); !written) return tl::unexpected(written.error());
      entry.band = given->band == "all" ? -1 : given->band.front() - 'A';
      if (!given->channels.empty()) entry.channels = 0;
      for (const double channel : given->channels) entry.channels |= 1U << (static_cast<unsigned>(channel) - 1U);
      return added(world, entry, "jammer");
    });
  });
  given->add_options(command);
  command.option("--band", given->band, "jammed band").one_of({"A", "B", "C", "D", "E", "all"});
  command.option("--channel", given->channels, "jammed channel; repeatable")
      .one_of({"1", "2", "3", "4", "5", "6", "7", "8"})
      .repeatable()
      .otherwise("all channels");
  add_move_and_remove(jammer, WorldList::jammers, "jammer", options);
}

void add_steer(runtime::Command mover, const Shared& options) {
  struct Values {
    Place place;
    double speed_kt = 0.0, heading_deg = 0.0;
  };
  const auto values = std::make_shared<Values>();
  runtime::Command command =
      add_action(mover, "steer", "change speed and heading where the mover is", options, [options, values] {
        change(*options, [&](WorldState& world, std::int64_t now_ns) {
          const auto id = static_cast<std::uint32_t>(values->place.id);
          const double speed_mps = values::WorldMover::speed.recorded(values->speed_kt);
          return text_if_done(world::steer(world, id, speed_mps, values->heading_deg, now_ns),
                              "mover " + std::to_string(id) + " steered");
        });
      });
  add_id(command, values->place);
  add_value(command, "SPEED_KT", values::WorldMover::speed, values->speed_kt).required();
  add_value(command, "HDG", values::WorldMover::heading, values->heading_deg).required();
}

void add_mover(runtime::Command parent, const Shared& options) {
  runtime::Command mover = parent.subcommand("mover", "moving targets: ships and vehicles");
  mover.require_subcommand();
  const auto given = std::make_shared<NewEntry<databuffer::WorldMover>>();
  given->add_options(add_action(mover, "add", "add a moving target", options, [options, given] {
    change(*options, [&](WorldState& world, std::int64_t now_ns) -> Expected<std::string> {
      auto entry = world::default_mover(given->position(), now_ns);
      if (auto written = given->write(entry); !written) return tl::unexpected(written.error());
      return added(world, entry, "mover");
    });
  }));
  add_move_and_remove(mover, WorldList::movers, "mover", options);
  add_steer(mover, options);
}

// Writes the given name and elevation into a point.
struct PointValues {
  Place place;
  std::string name;
  std::optional<double> elevation_ft;
  Expected<void> write(databuffer::WorldPoint& point) const {
    if (elevation_ft) point.elevation_m = values::WorldPoint::elevation.recorded(*elevation_ft);
    if (name.empty()) return {};
    return world::set_name(point, name);
  }
};

void add_point_options(runtime::Command command, PointValues& values, const char* name_otherwise,
                       const char* elevation_otherwise) {
  command.option("--name", values.name, "\"2\", target \"2.\", offset \"2.1\", target offset \"2.01\"")
      .otherwise(name_otherwise);
  add_value(command, "--elevation-ft", values::WorldPoint::elevation, values.elevation_ft)
      .otherwise(elevation_otherwise);
}

void add_point(runtime::Command parent, const Shared& options) {
  runtime::Command point = parent.subcommand("point", "sequence points");
  point.require_subcommand();
  const auto values = std::make_shared<PointValues>();
  runtime::Command adding = add_action(point, "add", "add a sequence point", options, [options, values] {
    change(*options, [&](WorldState& world, std::int64_t) -> Expected<std::string> {
      auto entry = world::default_point(world, values->place.point());
      if (!entry) return tl::unexpected(entry.error());
      if (auto written = values->write(*entry); !written) return tl::unexpected(written.error());
      return added(world, *entry, std::string("sequence point ") + entry->name + ", id");
    });
  });
  add_position(adding, values->place);
  add_point_options(adding, *values, "a steer point with the next number", "unknown");
  const auto changes = std::make_shared<PointValues>();
  runtime::Command changing =
      add_action(point, "change", "change the name or the elevation of a point", options, [options, changes] {
        change(*options, [&](WorldState& world, std::int64_t now_ns) -> Expected<std::string> {
          const auto id = static_cast<std::uint32_t>(changes->place.id);
          auto entry = world::entry_with<databuffer::WorldPoint>(world, id, now_ns);
          if (!entry) return tl::unexpected(entry.error());
          if (auto written = changes->write(*entry); !written) return tl::unexpected(written.error());
          return text_if_done(world::replace(world, *entry), "point " + std::to_string(id) + " changed");
        });
      });
  add_id(changing, changes->place);
  add_point_options(changing, *changes, "as it is", "as it is");
  add_move_and_remove(point, WorldList::points, "point", options);
}

void add_wind(runtime::Command parent, const Shared& options) {
  struct Values {
    double speed_kt = 0.0, from_deg = 0.0;
  };
  const auto values = std::make_shared<Values>();
  runtime::Command command = add_action(parent, "wind", "set the wind over the sea", options, [options, values] {
    change(*options, [&](WorldState& world, std::int64_t) {
      const double speed_mps = values::WorldState::wind_speed.recorded(values->speed_kt);
      return text_if_done(world::set_wind(world, speed_mps, values->from_deg),
                          "wind " + number(values->speed_kt) + " kt from " + number(values->from_deg) + " deg");
    });
  });
  add_value(command, "SPEED_KT", values::WorldState::wind_speed, values->speed_kt).required();
  add_value(command, "FROM_DEG", values::WorldState::wind_from, values->from_deg).required();
}

}  // namespace

void add_world_command(runtime::Command app, const CommonOptions& common) {
  runtime::Command world =
      app.subcommand("world", "print or change sea, wind, rain, jammers, movers and sequence points");
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
  add_rain(world, options);
  add_jammer(world, options);
  add_mover(world, options);
  add_point(world, options);
  add_action(world, "reset", "the configuration's world", options, [options] { reset(*options); });
}

}  // namespace yars::tools

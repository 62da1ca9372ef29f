// Commands of the instructor's page: clock, aircraft, world (sea, wind, entries of its lists, fidelity), roles,
// recordings. Removed entries of the world, which the page can bring back. Inputs: an object of JSON with "do", the
// name of a command, its arguments, and "id", a number for the answer; the world before and after a change.
// Outputs: the command with checked arguments; a change of the world, for change_world(); a world with a removed entry
// as it was. Errors: an unknown command, an argument that is absent or out of range; each says what was expected. When
// a change is made: a value out of range, an unknown id, an entry not removed or forgotten; those of world::restore().
// Threads: one for RemovedEntries; any for the functions.
// Source: docs/station.md#commands; names, units and limits of the world: lib/values/world_state.idl.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "databuffer/messages/world_state.hpp"
#include "lib/error/error.hpp"
#include "lib/geo/geodesy.hpp"
#include "world/world_edit.hpp"

namespace yars::station {

class RemovedEntries {
 public:
  static constexpr std::size_t kMaxEntries = 512;  // of all lists; a world has at most 400

  // Remembers the entries of `before` that `after` lacks.
  void note(const databuffer::WorldState& before, const databuffer::WorldState& after);
  // Adds a removed entry to the world, with its id and all its values. A mover has gone on meanwhile.
  error::Expected<void> restore(databuffer::WorldState& world, world::WorldList list, std::uint32_t id) const;

 private:
  std::deque<world::WorldEntry> entries_;  // the newest first
};

// Makes the world after the change from the world before it and the sim time.
using WorldEdit =
    std::function<error::Expected<databuffer::WorldState>(databuffer::WorldState world, std::int64_t sim_time_ns)>;

// nullopt: the name is not that of a command of the world.
std::optional<error::Expected<WorldEdit>> world_edit(std::string_view command, const nlohmann::json& object);

// List that an object names; nullopt: none of world_lists().
std::optional<world::WorldList> world_list(const nlohmann::json& object, const char* name);
// Names of the lists, for messages.
std::string world_lists();

// Names of the commands, for messages.
std::string_view world_commands();

struct SetRunning {
  bool running;
};
struct SetRate {
  double rate;
};
struct Step {
  std::int64_t ticks;
};
struct Reset {
  double time_s;
};
struct Reposition {
  geo::GeoPoint position;
  double altitude_ft, heading_deg;
  std::optional<double> speed_kt;  // nullopt: the source of the flight chooses
};
struct KillRole {
  std::string role;
};
struct WriteNote {
  std::string text;
};
struct StartRecorder {};
struct ListRecordings {};
struct PlayRecording {
  std::string file;
  double at_s;
};
struct FlyOut {
  std::string file;
  double at_s;
};
struct EndSet {
  std::string session;
};
struct EditWorld {
  WorldEdit edit;
};
struct RestoreEntry {  // that a page removed
  world::WorldList list;
  std::uint32_t item;
};
struct ResetWorld {};  // to that of the configuration
struct UndoReset {};   // back to the world before the last reset
using InstructorCommand =
    std::variant<SetRunning, SetRate, Step, Reset, Reposition, EditWorld, RestoreEntry, ResetWorld, UndoReset, KillRole,
                 WriteNote, StartRecorder, ListRecordings, PlayRecording, FlyOut, EndSet>;

struct InstructorMessage {
  std::int64_t id = 0;  // of the page; the answer bears it
  InstructorCommand command;
};

// True for a whole number that fits into InstructorMessage::id.
bool is_id(const nlohmann::json& value);
error::Expected<InstructorMessage> instructor_message(const nlohmann::json& object);

// Answer to a message. `problem`: null if the command was done.
std::string answer_to(std::int64_t id, const std::optional<std::string>& problem);

}  // namespace yars::station

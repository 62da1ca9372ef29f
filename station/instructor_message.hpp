// Commands of the instructor's page: the clock, the aircraft, the world, roles, recordings.
// Inputs: an object of JSON with "do", the name of a command, its arguments, and "id", a number for the answer.
// Outputs: the command with checked arguments.
// Errors: an unknown command, an argument that is absent or out of range; each says what was expected.
// Source: docs/station.md#commands.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <variant>

#include "lib/error/error.hpp"
#include "lib/geo/geodesy.hpp"
#include "station/world_message.hpp"
#include "world/world_edit.hpp"

namespace yars::station {

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

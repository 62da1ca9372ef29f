#include "station/instructor_message.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "databuffer/messages/clock_limits.hpp"
#include "databuffer/messages/limits.hpp"
#include "lib/text/plain_text.hpp"
#include "lib/values/fields.hpp"

namespace yars::station {

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

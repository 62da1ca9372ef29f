// `yars note` writes a line into the flight recorder of a session. `yars inject` sends input events to a session.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "databuffer/messages/input_event.hpp"
#include "databuffer/session/receivers.hpp"
#include "databuffer/session/session.hpp"
#include "lib/text/plain_text.hpp"
#include "runtime/process.hpp"
#include "runtime/program.hpp"
#include "statemachine/advice.hpp"
#include "tools/command/command.hpp"

namespace yars::tools {

// Prefix of the supervisor's notes about a restarted role.
inline constexpr std::string_view kRestartNote = "started again: ";

// `yars note`: writes a line into the flight recorder of a running session. scripts/start uses it.

namespace {

struct NoteOptions {
  std::string text;
  std::string restarted;  // restarted role; empty = a note about something else
};

void note(const CommonOptions& common, const NoteOptions& options) {
  if (auto running = databuffer::Session::open_read_only(common.session); !running) throw_failure(running.error());
  auto session = databuffer::Session::open(common.session, "yars note");
  if (!session) throw_failure(session.error());
  if (options.restarted.empty())
    session->note(databuffer::NoteKind::supervision, options.text);
  else {
    session->count_restart(options.restarted);
    session->note(databuffer::NoteKind::supervision, std::string(kRestartNote) + options.text, options.restarted);
  }
}

}  // namespace

void add_note_command(runtime::Command app, const CommonOptions& common) {
  runtime::Command command = app.subcommand("note", "write a note into the session's flight recorder");
  auto options = std::make_shared<NoteOptions>();
  command.option("TEXT", options->text, "what happened; at most 87 bytes are kept, 72 with --restarted").required();
  command.option("--restarted", options->restarted, "role that was restarted; TEXT is the reason")
      .value_name("ROLE")
      .otherwise("none");
  command.callback([&common, options] { note(common, *options); });
}

// `yars inject`: sends events into the session and waits until the state machine has applied them.

namespace {

using databuffer::AppliedEvent;
using databuffer::InputEvent;
using databuffer::Session;

constexpr const char* kSubject = "yars inject";  // with what its errors begin

constexpr std::int64_t kTimeout_ns = 2'000'000'000;  // [ns] 2 s: docs/commands.md#inject

// Parses the arguments. Either all arguments together are one event (pb 13), or each is one event ('pb 13' 'sp 2').
std::vector<InputEvent> parse_events(const std::vector<std::string>& arguments) {
  const auto refuse = [](const error::Error& error) {
    // An advice is a question, or a sentence without its end.
    std::string action = error.action;
    action += action.empty() ? "see" : action.ends_with('?') ? " See" : "; see";
    throw_failure(error::usage_error(kSubject, error.expected, error.found, action + " yars inject --help"));
  };
  std::string joined;
  for (const auto& argument : arguments) joined += (joined.empty() ? "" : " ") + argument;
  const auto single = databuffer::event_from_text(joined);
  if (single) return {*single};
  // Words of one event are single words, of which the first names the event.
  const auto is_word = [](const std::string& argument) { return argument.find(' ') == std::string::npos; };
  if (std::ranges::all_of(arguments, is_word) && !databuffer::event_from_text(arguments.front()))
    refuse(single.error());
  std::vector<InputEvent> events;
  for (const auto& argument : arguments) {
    const auto event = databuffer::event_from_text(argument);
    if (!event) refuse(event.error());
    events.push_back(*event);
  }
  return events;
}

// Result of each event (kEventDone, kEventDead or kEventRefused), in the order of sending.
using Outcome = std::vector<std::uint32_t>;

// Waits for the results of `count` events that this process sent through input lane `lane`, and for the records of the
// tick that applied the last of them: the state machine publishes Outputs last in a tick. The results arrive in the
// order of sending. Returns fewer after the timeout (2 s) or a stop request. `cursor`: position in the ring of applied
// events before the first event was sent.
Outcome wait_until_applied(Session& session, std::uint32_t lane, std::uint64_t cursor, std::size_t count) {
  Outcome outcome;
  const std::int64_t deadline_ns = databuffer::monotonic_ns() + kTimeout_ns;
  AppliedEvent applied{};
  std::int64_t tick = 0;
  const auto is_published = [&] {
    const auto outputs = databuffer::read_valid(session.layout().outputs);
    return outcome.size() >= count && outputs && outputs->tick >= tick;
  };
  while (!is_published() && databuffer::monotonic_ns() < deadline_ns && !runtime::stop_requested()) {
    while (session.layout().applied_events.read(cursor, applied).delivered) {
      if (applied.lane != lane) continue;
      outcome.push_back(applied.effective);
      tick = applied.tick;
    }
    if (!is_published()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return outcome;
}

std::string events_text(std::size_t count) {
  return text::counted(count, "event");
}

databuffer::RadarState published_state(Session& session) {
  return databuffer::read_valid(session.layout().radar_state).value_or(databuffer::RadarState{});
}

std::size_t count_of(const statemachine::AppliedSequence& applied, std::uint32_t effect) {
  return static_cast<std::size_t>(std::ranges::count(applied.effects, effect));
}

const char* effect_name(std::uint32_t effect) {
  if (effect == databuffer::kEventDone) return "done";
  return effect == databuffer::kEventRefused ? "refused" : "without effect";
}

// Prints {"done": 1, "without_effect": 1, "refused": 0, "events": [{"event", "effect", "reason" or null}]}.
void report_json(const statemachine::AppliedSequence& applied) {
  nlohmann::ordered_json events = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < applied.events.size(); ++i) {
    const bool done = applied.effects[i] == databuffer::kEventDone;
    const auto reason = done ? std::nullopt : statemachine::certain_reason(applied, i);
    events.push_back({{"event", databuffer::text_of(applied.events[i])},
                      {"effect", effect_name(applied.effects[i])},
                      {"reason", reason ? nlohmann::ordered_json(reason->words) : nlohmann::ordered_json(nullptr)}});
  }
  print_json({{"done", count_of(applied, databuffer::kEventDone)},
              {"without_effect", count_of(applied, databuffer::kEventDead)},
              {"refused", count_of(applied, databuffer::kEventRefused)},
              {"events", events}});
}

// Prints "3 events: 1 done, 1 without effect, 1 refused", and a line for each event without effect.
void report(const statemachine::AppliedSequence& applied) {
  std::printf("%s: %zu done", events_text(applied.events.size()).c_str(), count_of(applied, databuffer::kEventDone));
  if (const auto dead = count_of(applied, databuffer::kEventDead)) std::printf(", %zu without effect", dead);
  if (const auto refused = count_of(applied, databuffer::kEventRefused)) std::printf(", %zu refused", refused);
  std::printf("\n");
  for (std::size_t i = 0; i < applied.events.size(); ++i) {
    if (applied.effects[i] != databuffer::kEventDead) continue;
    const auto reason = statemachine::certain_reason(applied, i);
    std::printf("  %s: %s\n", databuffer::text_of(applied.events[i]).c_str(),
                reason ? statemachine::text_of(*reason).c_str() : "without effect; send it alone for the reason");
  }
}

// "did you mean 'sp 2.1'?", or the known points, for an `sp` that names no point. Known are the points that the state
// has: those on the display. Empty: another event, or no point is known.
std::string advice_on_point(const statemachine::AppliedSequence& applied, const InputEvent& event) {
  if (event.kind != static_cast<std::uint16_t>(databuffer::EventKind::sequence_point)) return {};
  std::vector<std::string> points;
  std::string names;
  for (int i = 0; i < applied.after.points_drawn && i < radar::kMaxPointsDrawn; ++i) {
    const std::string name(text::text_of(applied.after.points[i].name));
    points.push_back(name);
    names += (names.empty() ? "" : ", ") + name;
  }
  if (const auto meant = text::nearest_word(text::text_of(event.text), points))
    return "did you mean 'sp " + *meant + "'?";
  return names.empty() ? std::string() : "points on the display: " + names;
}

[[noreturn]] void give_up_refused(const statemachine::AppliedSequence& applied) {
  std::string refused, advice;
  bool all_certain = true;
  for (std::size_t i = 0; i < applied.events.size(); ++i) {
    if (applied.effects[i] != databuffer::kEventRefused) continue;
    const auto reason = statemachine::certain_reason(applied, i);
    all_certain = all_certain && reason;
    refused += refused.empty() ? "'" : ", '";
    refused += databuffer::text_of(applied.events[i]);
    refused += reason ? "' refused: " + reason->words : "' refused";
    std::string remedy = advice_on_point(applied, applied.events[i]);
    if (remedy.empty() && reason) remedy = reason->remedy;
    if (!remedy.empty()) advice += (advice.empty() ? "" : "; ") + remedy;
  }
  if (!all_certain)
    advice = "send an event alone for its reason";
  else if (advice.empty())
    advice = "see points, cursor and limits in `yars watch --json`";
  throw_failure({kSubject, "events that can be carried out", refused, advice});
}

struct InjectOptions {
  std::vector<std::string> events;
  bool json = false;
};

void inject(const CommonOptions& common, const InjectOptions& options) {
  auto events = parse_events(options.events);
  if (auto running = Session::open_read_only(common.session); !running) throw_failure(running.error());
  auto session = Session::open(common.session, "yars inject");
  if (!session) throw_failure(session.error());
  auto lane = session->claim_input_lane("inject");
  if (!lane) throw_failure(lane.error());
  const databuffer::RadarState before = published_state(*session);
  const std::uint64_t cursor = session->layout().applied_events.next();
  std::uint32_t number = 0;
  for (auto& event : events) {
    event.session_time_ns = session->sim_time_ns();
    event.monotonic_ns = databuffer::monotonic_ns();
    event.number = ++number;
    const auto push = [&] { return session->layout().input.push(static_cast<std::size_t>(lane->lane()), event); };
    const std::int64_t deadline_ns = event.monotonic_ns + kTimeout_ns;
    bool sent = push();
    while (!sent && databuffer::monotonic_ns() < deadline_ns && !runtime::stop_requested()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      sent = push();
    }
    if (!sent)
      throw_failure({kSubject, "free space in the input lane", "a full lane",
                     "start state-machine, or send fewer events at once"});
  }
  const Outcome outcome = wait_until_applied(*session, static_cast<std::uint32_t>(lane->lane()), cursor, events.size());
  if (outcome.size() < events.size())
    throw_failure({kSubject, events_text(events.size()) + " applied within 2 s", std::to_string(outcome.size()),
                   "check with `yars status` that state-machine and the clock run"});
  const databuffer::RadarState after = published_state(*session);
  const auto advice = databuffer::read_valid(session->layout().advice).value_or(databuffer::PilotAdvice{});
  const statemachine::AppliedSequence applied{
      events, outcome, before, after, session->role_is_held(databuffer::Role::recorder), advice.remedy};
  options.json ? report_json(applied) : report(applied);
  std::fflush(stdout);
  if (std::ranges::find(outcome, databuffer::kEventRefused) != outcome.end()) give_up_refused(applied);
}

}  // namespace

void add_inject_command(runtime::Command app, const CommonOptions& common) {
  runtime::Command command =
      app.subcommand("inject", "send events, e.g. yars inject 'power opr' 'pb 13' 'elevation -5'");
  auto options = std::make_shared<InjectOptions>();
  command.option("EVENT", options->events, "event, in upper or lower case:\n" + databuffer::event_forms())
      .value_name("EVENT")
      .required();
  add_json_flag(command, options->json);
  command.callback([&common, options] { inject(common, *options); });
}

}  // namespace yars::tools

// `yars inject`: sends events into the session and waits until the state machine says that it applied them.
#include <chrono>
#include <cstdio>
#include <string>
#include <thread>
#include <vector>

#include "databuffer/program.hpp"
#include "databuffer/records/event_text.hpp"
#include "databuffer/session.hpp"
#include "tools/command.hpp"

namespace yars::tools {

namespace {

using databuffer::AppliedEvent;
using databuffer::InputEvent;
using databuffer::Session;

constexpr std::int64_t kPatience_ns = 2'000'000'000;  // [ns] spec: waits at most 2 s

// Each argument is a whole event ("pb 13"); a single list of bare words is one event too (pb 13).
std::vector<InputEvent> parse_events(const std::vector<std::string>& arguments) {
  std::vector<InputEvent> events;
  std::string joined;
  for (const auto& argument : arguments) joined += (joined.empty() ? "" : " ") + argument;
  if (auto whole = databuffer::event_from_text(joined)) {
    events.push_back(*whole);
    return events;
  }
  for (const auto& argument : arguments) {
    auto event = databuffer::event_from_text(argument);
    if (!event) {
      auto error = event.error();
      error.bad_usage = true;
      give_up(error);
    }
    events.push_back(*event);
  }
  return events;
}

struct Outcome {
  std::size_t applied = 0;
  std::size_t dead = 0;
};

// Applied events of our lane come back in the order in which they were sent.
Outcome wait_until_applied(Session& session, std::uint32_t lane, std::uint64_t cursor, std::size_t count) {
  Outcome outcome;
  const std::int64_t deadline_ns = databuffer::monotonic_ns() + kPatience_ns;
  AppliedEvent applied{};
  while (outcome.applied < count && databuffer::monotonic_ns() < deadline_ns && !databuffer::stop_requested()) {
    while (session.layout().applied_events.read(cursor, applied).delivered) {
      if (applied.lane != lane) continue;
      ++outcome.applied;
      if (applied.effective == 0) ++outcome.dead;
    }
    if (outcome.applied < count) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return outcome;
}

void inject(const CommonOptions& common, const std::vector<std::string>& arguments) {
  auto events = parse_events(arguments);
  if (auto running = Session::open_read_only(common.session); !running) give_up(running.error());
  auto session = Session::open(common.session, "yars inject");
  if (!session) give_up(session.error());
  auto lane = session->claim_input_lane("inject");
  if (!lane) give_up(lane.error());
  const std::uint64_t cursor = session->layout().applied_events.next();
  std::uint32_t number = 0;
  for (auto& event : events) {
    event.session_time_ns = session->sim_time_ns();
    event.monotonic_ns = databuffer::monotonic_ns();
    event.number = ++number;
    const auto push = [&] { return session->layout().input.push(static_cast<std::size_t>(lane->lane()), event); };
    const std::int64_t deadline_ns = event.monotonic_ns + kPatience_ns;
    bool sent = push();
    while (!sent && databuffer::monotonic_ns() < deadline_ns && !databuffer::stop_requested()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      sent = push();
    }
    if (!sent)
      give_up({"inject", "room in the input lane", "a full lane", "start state-machine, or send fewer events at once",
               false});
  }
  const Outcome outcome = wait_until_applied(*session, static_cast<std::uint32_t>(lane->lane()), cursor, events.size());
  if (outcome.applied < events.size())
    give_up({"inject", std::to_string(events.size()) + " events applied within 2 s", std::to_string(outcome.applied),
             "is state-machine running, and the clock not frozen? (yars status)", false});
  std::printf("%zu applied", outcome.applied);
  if (outcome.dead > 0) std::printf(", %zu of them dead in this mode", outcome.dead);
  std::printf("\n");
}

}  // namespace

void add_inject_command(CLI::App& app, const CommonOptions& common) {
  auto* command = app.add_subcommand("inject", "send events, e.g. yars inject 'power opr' 'pb 13' 'elevation -5'");
  auto arguments = std::make_shared<std::vector<std::string>>();
  command->add_option("EVENT", *arguments, "an event as the pilot's interface writes it")
      ->required()
      ->allow_extra_args();
  command->prefix_command(false);
  command->callback([&common, arguments] { inject(common, *arguments); });
}

}  // namespace yars::tools

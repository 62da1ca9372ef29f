#include "databuffer/session/session_changes.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <thread>
#include <utility>

#include "databuffer/messages/validation.hpp"
#include "databuffer/session/receivers.hpp"
#include "databuffer/session/session_state.hpp"
#include "lib/radar/modes.hpp"

namespace yars::databuffer {

namespace {

ClockState rebased(const ClockState& clock) {
  return rebased(clock, monotonic_ns());
}

}  // namespace

ClockState rebased(ClockState clock, std::int64_t base_ns) {
  clock.base_sim_ns = sim_time_at(clock, base_ns);
  clock.base_monotonic_ns = base_ns;
  return clock;
}

ClockState with_running(const ClockState& clock, bool running) {
  ClockState next = rebased(clock);
  next.running = running ? 1 : 0;
  return next;
}

ClockState with_rate(const ClockState& clock, double rate) {
  ClockState next = rebased(clock);
  next.rate = rate;
  return next;
}

ClockState stepped(const ClockState& clock, std::int64_t ticks) {
  ClockState next = with_running(clock, false);
  next.base_sim_ns +=
      std::min(ticks, kStepPortion_ticks) * radar::kTickNanoseconds - next.base_sim_ns % radar::kTickNanoseconds;
  return next;
}

ClockState reset_to(const ClockState& clock, double time_s) {
  ClockState next = clock;
  next.base_monotonic_ns = monotonic_ns();
  next.base_sim_ns = std::llround(time_s / radar::kTickSeconds) * radar::kTickNanoseconds;
  ++next.epoch;
  next.reposition_latitude_deg = std::numeric_limits<double>::quiet_NaN();
  next.followed = 0;
  return next;
}

ClockState repositioned(const ClockState& clock, const Repositioning& to) {
  ClockState next = rebased(clock);
  ++next.epoch;
  next.followed = 0;
  next.reposition_latitude_deg = to.position.latitude_deg;
  next.reposition_longitude_deg = to.position.longitude_deg;
  next.reposition_altitude_m = to.altitude.metres();
  next.reposition_heading_deg = to.heading.degrees();
  next.reposition_speed_mps = to.ground_speed.value_or(geo::Speed()).metres_per_second();
  return next;
}

void begin_at_aircraft(ClockState& clock, const Ownship& ownship, geo::Bearing heading) {
  clock.reposition_latitude_deg = ownship.latitude_deg;
  clock.reposition_longitude_deg = ownship.longitude_deg;
  clock.reposition_altitude_m = ownship.altitude_msl_m;
  clock.reposition_heading_deg = heading.degrees();
  clock.reposition_speed_mps = 0.0;
  clock.followed = 1;
}

ClockState after_first_tick(const ClockState& clock) {
  ClockState next = clock;
  next.base_sim_ns = std::min(next.base_sim_ns + radar::kTickNanoseconds, kLatestClockBase_ns);
  return next;
}

using error::Expected;
using error::fail;

namespace {

// [ns] Time to get the role instructor. A change takes much less; over hosts an editor before this one may wait for its
// answer.
constexpr std::int64_t kClaimTime_ns = 200'000'000;
constexpr std::int64_t kClaimTimeOverHosts_ns = 2'500'000'000;
// [ns] Time within which a change may be requested again, on the world that an edit of another host has made.
constexpr std::int64_t kRetryTime_ns = 1'000'000'000;
constexpr std::int64_t kAnswerTime_ns = kMaxWorldRequestAge_ns + 200'000'000;

tl::unexpected<error::Error> fail_without_model() {
  return fail("world", "a radar-model that runs in the session", "none", "start radar-model, as with scripts/start");
}

// The newest world after the change, with the numbers of a new edit.
Expected<WorldState> next_world(const Session& session, const WorldChange& change) {
  const auto before = newest_world(session.layout());
  if (!before)
    return fail("world", "a world that radar-model has published", "none",
                "wait until radar-model has run a tick, as after `yars sim run`");
  auto next = change(*before);
  if (!next) return next;
  next->edit = before->edit + 1;
  next->last_id = std::max(next->last_id, before->last_id);
  next->tick = 0;
  if (const auto refusal = validate(*next))
    return fail("world", "values within their limits", *refusal, "give a value within these limits");
  return next;
}

// ---- radar-model on another host
// Answer to a request; nullopt: it is still awaited. none: no answer in time, or that host has lost the role.
std::optional<WorldAnswer> answer_to(const Session& session, std::uint64_t number, std::int64_t requested_ns) {
  const std::uint64_t word = session.layout().world_requests.answered.load(std::memory_order_acquire);
  if (word >> 8 == number) return static_cast<WorldAnswer>(word & 0xFFU);
  if (!session.is_mirrored(Role::radar_model) || !session.role_is_held(Role::radar_model)) return WorldAnswer::none;
  if (monotonic_ns() - requested_ns > kAnswerTime_ns) return WorldAnswer::none;
  return std::nullopt;
}

tl::unexpected<error::Error> fail_by(WorldAnswer answer) {
  switch (answer) {
    case WorldAnswer::outdated:
      return fail("world", "a moment without changes by other hosts", "a newer change at each attempt in 1 s",
                  "give the command again");
    case WorldAnswer::refused:
      return fail("world", "a change that radar-model's host accepts", "its refusal",
                  "look at the refusals of `yars status` on that host; in a replay nobody changes the world");
    case WorldAnswer::forbidden:
      return fail("world", "a host that may write the topic world_requests", "one that may not",
                  "change the world on another host, or let this one write it: topicsOut, permissions of the identity");
    default:
      return fail("world", "an answer of radar-model's host", "none in time",
                  "see with `yars world` whether the change has come, then give the command again");
  }
}

}  // namespace

std::optional<WorldState> world_in_effect(const SessionLayout& layout) {
  const std::uint64_t end = layout.world_latched.next();
  if (end == 0) return std::nullopt;
  std::uint64_t cursor = end - 1;
  WorldState world{};
  if (!layout.world_latched.read(cursor, world).delivered || validate(world)) return std::nullopt;
  return world;
}

std::optional<WorldState> newest_world(const SessionLayout& layout) {
  const auto in_effect = world_in_effect(layout);
  const auto wanted = read_valid(layout.world);
  const bool is_waiting = wanted && (!in_effect || wanted->edit != in_effect->edit);
  return is_waiting ? wanted : in_effect;
}

Expected<WorldState> replace_world(Session& session, const Claim& /*instructor*/, const WorldChange& change) {
  const SessionLayout& layout = std::as_const(session).layout();
  if (!layout.world_configured.has_value() && layout.world_latched.next() > 0)
    return fail("world", "a radar-model that runs in the session", "the replay of a recording",
                "name a live session with --session");
  auto next = next_world(std::as_const(session), change);
  if (next) session.layout().world.publish(*next);
  return next;
}

WorldChangeInProgress::WorldChangeInProgress(Session& session, WorldChange change)
    : session_(&session), begun_ns_(monotonic_ns()) {
  change_ = [change = std::move(change)](const WorldState& before) {
    auto next = change(before);
    if (next) next->source_time_ns = monotonic_ns();
    return next;
  };
}

std::optional<Expected<WorldState>> WorldChangeInProgress::poll() {
  if (!instructor_) return begin();
  const auto answer = answer_to(std::as_const(*session_), number_, requested_ns_);
  if (!answer) return std::nullopt;
  if (*answer == WorldAnswer::applied) return requested_;
  // An edit that came first on the other host makes the request outdated: it is made again on top of that edit.
  if (*answer == WorldAnswer::outdated && monotonic_ns() - first_request_ns_ < kRetryTime_ns) return request();
  return Expected<WorldState>(fail_by(*answer));
}

std::optional<Expected<WorldState>> WorldChangeInProgress::begin() {
  if (!session_->role_is_held(Role::radar_model)) return Expected<WorldState>(fail_without_model());
  const bool is_elsewhere = session_->is_mirrored(Role::radar_model);
  auto claim = session_->claim(Role::instructor);
  if (!claim) {
    const std::int64_t patience_ns = is_elsewhere ? kClaimTimeOverHosts_ns : kClaimTime_ns;
    if (monotonic_ns() - begun_ns_ < patience_ns) return std::nullopt;
    return Expected<WorldState>(tl::unexpected(claim.error()));
  }
  instructor_ = std::move(*claim);
  if (!is_elsewhere) return replace_world(*session_, *instructor_, change_);
  first_request_ns_ = monotonic_ns();
  return request();
}

std::optional<Expected<WorldState>> WorldChangeInProgress::request() {
  auto next = next_world(std::as_const(*session_), change_);
  if (!next) return next;
  requested_ = *next;
  requested_ns_ = monotonic_ns();
  auto& layout = session_->layout();
  number_ = (layout.world_requests.asked.load() + 1) & WorldRequests::kLastNumber;
  layout.world_request.publish(requested_);
  layout.world_requests.asked.store(number_, std::memory_order_release);
  return std::nullopt;
}

Expected<WorldState> change_world(Session& session, const WorldChange& change) {
  WorldChangeInProgress progress(session, change);
  while (true) {
    if (auto decided = progress.poll()) return *std::move(decided);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

WorldChange reset_of(const Session& session) {
  return [&session](const WorldState&) -> Expected<WorldState> {
    if (const auto configured = read_valid(session.layout().world_configured)) return *configured;
    return fail("world", "the world of radar-model's configuration", "none", "restart radar-model");
  };
}

}  // namespace yars::databuffer

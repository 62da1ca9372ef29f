#include "databuffer/session/session_world.hpp"

#include <algorithm>
#include <chrono>
#include <string>
#include <thread>
#include <utility>

#include "databuffer/messages/validation.hpp"
#include "databuffer/session/validated.hpp"

namespace yars::databuffer {

using error::Expected;
using error::fail;

namespace {

constexpr int kAttempts = 200;            // to get the role, 1 ms apart; a change takes much less
constexpr int kAttemptsOverHosts = 2500;  // an editor before this one may wait for its answer
// [ns] Time within which a change may be requested again, on the world that an edit of another host has made.
constexpr std::int64_t kRetryTime_ns = 1'000'000'000;
constexpr std::int64_t kAnswerTime_ns = kMaxWorldRequestAge_ns + 200'000'000;

Expected<Claim> claim_instructor(Session& session, int attempts) {
  for (int attempt = 1;; ++attempt) {
    auto claim = session.claim(Role::instructor);
    if (claim || attempt == attempts) return claim;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

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
// none: no answer in time, or that host has lost the role.
WorldAnswer await_answer(const Session& session, std::uint64_t number) {
  const auto& requests = session.layout().world_requests;
  const std::int64_t deadline_ns = monotonic_ns() + kAnswerTime_ns;
  while (session.is_mirrored(Role::radar_model) && session.role_is_held(Role::radar_model)) {
    const std::uint64_t word = requests.answered.load(std::memory_order_acquire);
    if (word >> 8 == number) return static_cast<WorldAnswer>(word & 0xFFU);
    if (monotonic_ns() > deadline_ns) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return WorldAnswer::none;
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

// An edit that came first on the other host makes the request outdated: it is made again on top of that edit.
Expected<WorldState> request_world(Session& session, const WorldChange& change) {
  auto& layout = session.layout();
  const std::int64_t end_ns = monotonic_ns() + kRetryTime_ns;
  WorldAnswer answer = WorldAnswer::outdated;
  while (answer == WorldAnswer::outdated && monotonic_ns() < end_ns) {
    auto next = next_world(std::as_const(session), change);
    if (!next) return next;
    const std::uint64_t number = (layout.world_requests.asked.load() + 1) & WorldRequests::kLastNumber;
    layout.world_request.publish(*next);
    layout.world_requests.asked.store(number, std::memory_order_release);
    answer = await_answer(std::as_const(session), number);
    if (answer == WorldAnswer::applied) return next;
  }
  return fail_by(answer);
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

Expected<WorldState> change_world(Session& session, const WorldChange& change) {
  if (!session.role_is_held(Role::radar_model)) return fail_without_model();
  const bool is_elsewhere = session.is_mirrored(Role::radar_model);
  const auto claim = claim_instructor(session, is_elsewhere ? kAttemptsOverHosts : kAttempts);
  if (!claim) return tl::unexpected(claim.error());
  const WorldChange timed = [&change](const WorldState& before) {
    auto next = change(before);
    if (next) next->source_time_ns = monotonic_ns();
    return next;
  };
  return is_elsewhere ? request_world(session, timed) : replace_world(session, *claim, timed);
}

Expected<WorldState> reset_world(Session& session) {
  return change_world(session, [&session](const WorldState&) -> Expected<WorldState> {
    if (const auto configured = read_valid(std::as_const(session).layout().world_configured)) return *configured;
    return fail("world", "the world of radar-model's configuration", "none", "restart radar-model");
  });
}

}  // namespace yars::databuffer

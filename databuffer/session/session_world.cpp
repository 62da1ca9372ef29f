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

constexpr int kAttempts = 200;  // to get the role, 1 ms apart; a change takes much less

Expected<Claim> claim_instructor(Session& session) {
  for (int attempt = 1;; ++attempt) {
    auto claim = session.claim(Role::instructor);
    if (claim || attempt == kAttempts) return claim;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

tl::unexpected<error::Error> fail_without_model() {
  return fail("world", "a radar-model that runs in the session", "none", "start radar-model, as with scripts/start");
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

Expected<WorldState> change_world(Session& session, const WorldChange& change) {
  if (!session.role_is_held(Role::radar_model)) return fail_without_model();
  if (session.is_mirrored(Role::radar_model))
    return fail("world", "a radar-model on this host", "one on another host", "change the world on that host");
  const auto claim = claim_instructor(session);
  if (!claim) return tl::unexpected(claim.error());
  const SessionLayout& layout = std::as_const(session).layout();
  if (!layout.world_configured.has_value() && layout.world_latched.next() > 0)
    return fail("world", "a radar-model that runs in the session", "the replay of a recording",
                "name a live session with --session");
  const auto before = newest_world(layout);
  if (!before)
    return fail("world", "a world that radar-model has published", "none",
                "wait until radar-model has run a tick, as after `yars sim run`");
  auto next = change(*before);
  if (!next) return next;
  next->edit = before->edit + 1;
  next->last_id = std::max(next->last_id, before->last_id);
  next->tick = 0;
  next->source_time_ns = monotonic_ns();
  if (const auto refusal = validate(*next))
    return fail("world", "values within their limits", *refusal, "give a value within these limits");
  session.layout().world.publish(*next);
  return next;
}

Expected<WorldState> reset_world(Session& session) {
  return change_world(session, [&session](const WorldState&) -> Expected<WorldState> {
    if (const auto configured = read_valid(std::as_const(session).layout().world_configured)) return *configured;
    return fail("world", "the world of radar-model's configuration", "none", "restart radar-model");
  });
}

}  // namespace yars::databuffer

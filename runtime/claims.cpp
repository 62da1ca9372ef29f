#include "runtime/claims.hpp"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "lib/log/log.hpp"
#include "runtime/process.hpp"

namespace yars::runtime {

namespace {

// [ms] A standby takes over within this time after the role is free. Each look is one system call.
constexpr std::chrono::milliseconds kStandbyInterval(10);

// [ns] Time for which a standby leaves the role to a gateway that has died. A supervisor starts the gateway again
// within 1 s; input events that wait for another host then still reach that host.
constexpr std::int64_t kGatewayReturn_ns = 1'200'000'000;

// True while the role is not free for a standby.
class Occupation {
 public:
  bool lasts(const databuffer::Session& session, databuffer::Role role) {
    const bool is_mirrored = session.is_mirrored(role);
    const std::int64_t now_ns = databuffer::monotonic_ns();
    if (is_mirrored && session.role_is_held(databuffer::Role::gateway)) gateway_seen_ns_ = now_ns;
    if (session.role_is_held(role) || session.must_yield(role)) return true;
    return is_mirrored && now_ns - gateway_seen_ns_ < kGatewayReturn_ns;
  }

 private:
  std::int64_t gateway_seen_ns_ = databuffer::monotonic_ns();
};

error::Expected<HeldRole> open_and_claim(const std::string& session_name, databuffer::Role role,
                                         std::string_view program) {
  auto session = databuffer::Session::open(session_name, program);
  if (!session) return tl::unexpected(session.error());
  auto claim = session->claim(role);
  if (!claim) return tl::unexpected(error::usage_error(claim.error()));
  return HeldRole{std::move(*session), std::move(*claim)};
}

}  // namespace

void add_standby_option(CommandLine& app, bool& standby) {
  app.flag("--standby", standby, "waits while another process or another computer of the session holds the role");
}

error::Expected<std::optional<HeldRole>> take_role(const std::string& session_name, databuffer::Role role,
                                                   std::string_view program, bool standby,
                                                   const std::function<void(const databuffer::Session&)>& meanwhile) {
  if (!standby) {
    auto held = open_and_claim(session_name, role, program);
    if (!held) return tl::unexpected(held.error());
    return std::optional<HeldRole>(std::move(*held));
  }
  auto waiting = databuffer::Session::open(session_name, std::string(program) + " standby");
  if (!waiting) return tl::unexpected(waiting.error());
  Occupation occupation;
  bool reported = false;
  while (!stop_requested()) {
    if (!occupation.lasts(std::as_const(*waiting), role)) {
      auto held = open_and_claim(session_name, role, program);
      if (held) return std::optional<HeldRole>(std::move(*held));
      if (!held.error().bad_usage()) return tl::unexpected(held.error());
    }
    if (!std::exchange(reported, true))
      log::info("stands by: another process holds the role " + std::string(databuffer::name_of(role)));
    waiting->heartbeat();
    if (meanwhile) meanwhile(*waiting);
    std::this_thread::sleep_for(kStandbyInterval);
  }
  return std::optional<HeldRole>();
}

tl::unexpected<error::Error> fail_yielded(databuffer::Role role) {
  return error::fail("role " + std::string(databuffer::name_of(role)), "one process of this role in a session",
                     "another host of the session holds it",
                     "end one of the two, or start both with --standby; docs/network.md has the rule");
}

error::Expected<InputLane> InputLane::claim(databuffer::Session& session, std::string_view source) {
  auto claim = session.claim_input_lane(source);
  if (!claim) return tl::unexpected(claim.error());
  return InputLane(session, std::move(*claim), source);
}

void InputLane::send(databuffer::InputEvent event) {
  event.session_time_ns = session_->sim_time_ns();
  event.monotonic_ns = databuffer::monotonic_ns();
  event.number = ++number_;
  if (session_->layout().input.push(static_cast<std::size_t>(claim_.lane()), event)) return;
  log::warning("the input lane of " + source_ + " is full, is state-machine running? '" + databuffer::text_of(event) +
               "' is dropped");
}

bool is_alive(std::span<const databuffer::ProcessInfo> processes, databuffer::Role role, std::int64_t now_ns) {
  constexpr std::int64_t kSilentAfter_ns = 1'000'000'000;  // 1 s
  return std::ranges::any_of(processes, [&](const databuffer::ProcessInfo& process) {
    return process.name == databuffer::name_of(role) && now_ns - process.heartbeat_ns < kSilentAfter_ns;
  });
}

}  // namespace yars::runtime

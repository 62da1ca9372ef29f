#include "runtime/pilot_link.hpp"

#include <algorithm>

#include "lib/log/log.hpp"

namespace yars::runtime {

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

#include "tools/session/hand_over.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <span>
#include <utility>

#include "databuffer/session/receivers.hpp"
#include "databuffer/session/session.hpp"
#include "lib/geo/geodesy.hpp"
#include "lib/log/log.hpp"
#include "runtime/process.hpp"
#include "tools/session/play_recording.hpp"

namespace yars::tools {

namespace {

using databuffer::Role;
using databuffer::Session;
using databuffer::SessionLayout;

constexpr std::int64_t kPatience_ns = 30'000'000'000;  // [ns] 30 s until the awaited roles must have joined
constexpr std::int64_t kSilentLane_ns = 500'000'000;   // [ns] an awaited flight-model that publishes nothing so long
constexpr long kLookInterval_ns = 1'000'000;           // [ns] 1 ms

void report(const HandOverOptions& options, const char* line) {
  if (!options.prints) return;
  std::printf("%s\n", line);
  std::fflush(stdout);
}

// The traffic as it is at the tick: each entity has moved on straight at its velocity since the record was latched. The
// live radar model takes the record as a new one.
databuffer::Traffic traffic_at(databuffer::Traffic traffic, std::int64_t tick) {
  const double flown_s = static_cast<double>(tick - traffic.tick) * radar::kTickSeconds;
  for (databuffer::TrafficEntity& entity :
       std::span(traffic.entities).first(std::min<std::size_t>(traffic.count, databuffer::kMaxTraffic))) {
    const auto course = geo::Bearing::radians(std::atan2(entity.velocity_east_mps, entity.velocity_north_mps));
    const double speed_mps = std::hypot(entity.velocity_north_mps, entity.velocity_east_mps);
    const auto moved = geo::geodesic_direct({entity.latitude_deg, entity.longitude_deg}, course,
                                            geo::Length::metres(speed_mps * flown_s));
    entity.latitude_deg = moved.latitude_deg;
    entity.longitude_deg = moved.longitude_deg;
  }
  traffic.tick = 0;
  return traffic;
}

// Tests which awaited roles have joined the session since this process gave its roles back.
class Joining {
 public:
  Joining(const Session& session, const recording::BranchPoint& point, const std::string& roles)
      : session_(&session), tick_(point.tick), roles_("," + roles + ",") {}

  // The first awaited role that is missing among state-machine and radar-model; empty: none.
  std::string missing_model() const {
    const SessionLayout& layout = session_->layout();
    const auto outputs = databuffer::read_valid(layout.outputs);
    if (awaits("state-machine") && !(session_->role_is_held(Role::state_machine) && outputs && outputs->tick > tick_))
      return "state-machine";
    const auto status = databuffer::read_valid(layout.model_status);
    if (awaits("radar-model") && !(session_->role_is_held(Role::radar_model) && status && status->tick > tick_))
      return "radar-model";
    return {};
  }
  // A source of another program may have no aircraft yet: the set then does not wait for its first record.
  std::string missing_flight() {
    if (!awaits("flight-model")) return {};
    for (std::size_t lane = 0; lane < databuffer::kOwnshipLanes; ++lane) {
      if (!session_->ownship_lane_is_held(lane)) continue;
      const std::int64_t now_ns = databuffer::monotonic_ns();
      if (!lane_seen_ns_) lane_seen_ns_ = now_ns;
      if (session_->layout().ownship[lane].has_value() || now_ns - *lane_seen_ns_ > kSilentLane_ns) return {};
    }
    return "flight-model";
  }

 private:
  bool awaits(const std::string& role) const { return roles_.find("," + role + ",") != std::string::npos; }

  const Session* session_;
  std::int64_t tick_;
  std::string roles_;
  std::optional<std::int64_t> lane_seen_ns_;
};

// Looks until `missing` names no role.
error::Expected<void> await(ReplaySession& session, const HandOverOptions& options, std::int64_t deadline_ns,
                            const std::function<std::string()>& missing) {
  for (std::string role = missing(); !role.empty(); role = missing()) {
    if (runtime::stop_requested())
      return error::fail("hand-over", "the live roles to join session " + options.session, "a request to stop");
    if (databuffer::monotonic_ns() > deadline_ns)
      return error::fail("hand-over", options.roles + " in session " + options.session + " within 30 s", "no " + role,
                         "start it with --session " + options.session + ", or choose roles by --await");
    session.heartbeat();
    const timespec pause{0, kLookInterval_ns};
    nanosleep(&pause, nullptr);
  }
  return {};
}

}  // namespace

error::Expected<void> hand_over(recording::RecordingReader& reader, const recording::BranchPoint& point,
                                const std::function<std::optional<recording::PlayerWorld>()>& open_world,
                                const HandOverOptions& options) {
  auto session = ReplaySession::create(options.session);
  if (!session) return tl::unexpected(session.error());
  // The live roles begin with the tick behind the point.
  if (auto held = session->hold(point.tick + 1, point.epoch, point.status.ownship); !held) return held;
  // The records that are known without the kernel come first: a standing-by radar model loads its terrain meanwhile.
  recording::Played records;
  records.state = point.state;
  records.status = point.status;
  records.outputs = point.outputs;
  if (point.traffic) records.traffic = traffic_at(*point.traffic, point.tick + 1);
  if (point.world) session->want_world(*point.world);
  session->publish_key_frame(records);
  report(options, "claimed");
  recording::Player player(reader, open_world());
  session->publish(player.picture(point));
  session->release_roles();
  const std::int64_t deadline_ns = databuffer::monotonic_ns() + kPatience_ns;
  Joining joining(session->session(), point, options.roles);
  if (auto joined = await(*session, options, deadline_ns, [&] { return joining.missing_model(); }); !joined)
    return joined;
  report(options, "ready");
  if (auto joined = await(*session, options, deadline_ns, [&] { return joining.missing_flight(); }); !joined)
    return joined;
  return session->release_clock();
}

}  // namespace yars::tools

#include "databuffer/app/flight_shell.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "databuffer/bridges/dis.hpp"
#include "databuffer/messages/validation.hpp"
#include "databuffer/runtime/receivers.hpp"
#include "lib/log/log.hpp"

namespace yars::databuffer {

namespace {

// [ns] After a longer gap it was not a restart but somebody who wants a flight from its start.
constexpr std::int64_t kLongestGap_ns = 10'000'000'000;
constexpr std::int64_t kTicksBetweenRecords = 4;  // 50 Hz: more changes no sweep, less shows as steps of the apex

}  // namespace

FlightShell::FlightShell(Session& session, flight::FlightSource source, int lane, bool every_tick)
    : session_(&session), source_(std::move(source)), lane_(static_cast<std::size_t>(lane)), every_tick_(every_tick) {}

void FlightShell::step(const TickLoop::Due& due) {
  // A repositioning that came while nobody flew is this flight's too.
  const bool placed_before = !started_ && !resume(due) && !std::isnan(due.clock.reposition_latitude_deg);
  if (due.new_epoch || placed_before) begin_epoch(due.clock);
  const bool first = !started_ || due.new_epoch;
  const bool publishes = first || every_tick_ || due.tick - last_published_tick_ >= kTicksBetweenRecords;
  if (publishes && !every_tick_) stand_by(due);
  const flight::FlightSample sample = source_.model->step(time_since_last(due));
  started_ = true;
  last_tick_ = due.tick;
  if (!publishes) return;
  publish_flight(session_->layout(), lane_, due, sample);
  last_published_tick_ = due.tick;
}

// A new epoch's time has nothing to do with the one before; ticks that were skipped are flown all the same.
geo::Duration FlightShell::time_since_last(const TickLoop::Due& due) const {
  if (!started_ || due.new_epoch || due.tick <= last_tick_) return {};
  return geo::Duration::seconds(static_cast<double>(due.tick - last_tick_) * radar::kTickSeconds);
}

void FlightShell::begin_epoch(const ClockState& clock) {
  if (std::isnan(clock.reposition_latitude_deg)) {
    source_.model->reset();
    log::info("back at the start, epoch " + std::to_string(clock.epoch));
    return;
  }
  if (const auto reason = validate(clock)) {
    session_->note(NoteKind::refusal, "repositioning: " + *reason);
    log::warning("repositioning is refused: " + *reason);
    return;
  }
  const flight::Placement placement{{clock.reposition_latitude_deg, clock.reposition_longitude_deg},
                                    geo::AltitudeMsl::metres(clock.reposition_altitude_m),
                                    geo::Bearing::degrees(clock.reposition_heading_deg)};
  const bool placed = source_.model->reposition(placement);
  // Nobody asked for it: another source went there.
  if (clock.followed != 0) {
    if (placed && !started_) log::info("begins where the session's aircraft was last placed, not at its own place");
    return;
  }
  if (placed) {
    log::info("repositioned, epoch " + std::to_string(clock.epoch));
    return;
  }
  session_->note(NoteKind::refusal, "repositioning: " + source_.description + " follows its file alone");
  log::warning("repositioning is refused: " + source_.description + " follows its file alone");
}

// So that it takes over without a jump when that source falls silent. One that cannot be placed flies on as it does.
void FlightShell::stand_by(const TickLoop::Due& due) {
  const SessionLayout& layout = session_->layout();
  ModelStatus model{};
  if (!layout.model_status.read(model) || model.ownship_lane == lane_ || model.ownship_lane >= kOwnshipLanes ||
      validate(model))
    return;
  const bool follows = (model.flags & kModelStale) == 0 && model.epoch == due.clock.epoch &&
                       model.sim_time_ns + kStaleAfter > due.sim_time_ns;
  const auto priority = [&layout](std::size_t lane) {
    return layout.ownship_priority[lane].load(std::memory_order_relaxed);
  };
  if (!follows || priority(lane_) > priority(model.ownship_lane)) return;
  const Ownship& there = model.ownship;
  source_.model->reposition({{there.latitude_deg, there.longitude_deg},
                             geo::AltitudeMsl::metres(there.altitude_msl_m),
                             geo::Bearing::degrees(there.heading_deg)});
}

// True if it took up where a predecessor of this epoch was.
bool FlightShell::resume(const TickLoop::Due& due) {
  ModelStatus model{};
  if (every_tick_ || !session_->layout().model_status.read(model) || validate(model)) return false;
  const Ownship& last = model.ownship;
  const flight::FlightSample own = source_.model->step({});
  // The stamp is whatever the source wrote: compared before a difference is taken.
  if (std::string_view(own.ownship.source) != last.source || last.epoch != due.clock.epoch ||
      last.source_time_ns > due.sim_time_ns || last.source_time_ns < due.sim_time_ns - kLongestGap_ns)
    return false;
  const std::int64_t gap_ns = due.sim_time_ns - last.source_time_ns;
  if (!source_.model->resume(last, geo::Duration::seconds(1e-9 * static_cast<double>(gap_ns)))) return false;
  session_->note(NoteKind::restart, "flight-model resumes");
  log::info("resumes where its predecessor was");
  return true;
}

namespace {

// 1 Hz: between records the radar sails each entity on by its velocity.
constexpr std::int64_t kTicksBetweenTraffic = 200;

geo::Duration duration_of(std::int64_t nanoseconds) {
  return geo::Duration::seconds(1e-9 * static_cast<double>(nanoseconds));
}

// The moment of a tick by CLOCK_MONOTONIC [ns]: a tick that is done late is still flown where it belongs.
std::int64_t moment_of(const TickLoop::Due& due) {
  const std::int64_t now_ns = monotonic_ns();
  if (due.clock.running == 0 || !(due.clock.rate > 0.0)) return now_ns;
  const double since_base_ns = static_cast<double>(due.sim_time_ns - due.clock.base_sim_ns) / due.clock.rate;
  constexpr double kLongestLate_ns = 1e8;  // the ticks that a role catches up
  const double late_ns = static_cast<double>(now_ns - due.clock.base_monotonic_ns) - since_base_ns;
  return now_ns - static_cast<std::int64_t>(std::clamp(late_ns, 0.0, kLongestLate_ns));
}

}  // namespace

error::Expected<UdpSocket> open_socket(const bridges::BridgeSource& source) {
  return source.asks ? UdpSocket::ask(source.host, source.port) : UdpSocket::listen(source.host, source.port);
}

BridgeShell::BridgeShell(Session& session, bridges::BridgeSource source, UdpSocket socket, int lane)
    : session_(&session),
      source_(std::move(source)),
      socket_(std::move(socket)),
      lane_(static_cast<std::size_t>(lane)),
      flight_(source_.bridge->reach()) {
  log::info((source_.asks ? "asks " : "listens for ") + source_.name + (source_.asks ? " at " : " on ") +
            text_of(socket_.place()));
  if (source_.bridge->tells_traffic()) claim_traffic();
}

BridgeShell::~BridgeShell() {
  if (traffic_claim_) session_->layout().traffic.clear();
  for (const auto& datagram : source_.bridge->farewell()) socket_.send(datagram);
  if (refusals_.count() > 0) log::info(std::to_string(refusals_.count()) + " packets were refused");
}

void BridgeShell::step(const TickLoop::Due& due) {
  if (due.new_epoch) begin_epoch(due.clock);
  let_go_of_the_silent();
  ask();
  receive();
  if (traffic_claim_) publish_traffic(due);
  const auto sample = flight_.at(duration_of(moment_of(due)));
  tell_presence(sample.has_value());
  if (!sample) return;
  if (due.tick >= next_publish_tick_ || due.new_epoch || due.tick < next_publish_tick_ - kTicksBetweenRecords)
    publish(due, *sample);
}

void BridgeShell::begin_epoch(const ClockState& clock) {
  // Also when nobody asked for it: the radar follows a source that has jumped, this one perhaps.
  if (std::isnan(clock.reposition_latitude_deg) || clock.followed != 0) return;
  const std::string line = "repositioning: " + source_.name + " flies by itself; move it there";
  session_->note(NoteKind::refusal, line);
  log::warning(line);
}

void BridgeShell::ask() {
  for (const auto& datagram : source_.bridge->requests(duration_of(monotonic_ns()))) socket_.send(datagram);
}

void BridgeShell::receive() {
  socket_.receive(kMaxDatagramsATick, [this](memory::Bytes datagram, const bridges::Sender& from,
                                             std::int64_t received_ns) { take(datagram, from, received_ns); });
  tell_losses();
}

void BridgeShell::take(memory::Bytes datagram, const bridges::Sender& from, std::int64_t received_ns) {
  latest_ns_ = std::max(latest_ns_, received_ns);
  const geo::Duration now = duration_of(latest_ns_);
  const bool one_sender = !source_.bridge->hears_many();
  if (one_sender && !gate_.admits(from, now))
    return refuse(source_.name + ": expected packets of one sender, found another, " + text_of(from), now);
  source_.bridge->hears_from(from);
  const auto sample = source_.bridge->receive(datagram, now);
  if (const auto news = source_.bridge->take_news()) log::info(*news);
  if (!sample) return refuse(sample.error().message(), now);
  if (!*sample) return;
  if (gate_.taken(from, now) && one_sender) log::info("hears " + source_.name + " from " + text_of(from));
  if (source_.asks) hold_to_who_answers(from);
  flight_.receive(**sample, now);
  if (flight_.jumps() == std::exchange(jumps_told_, flight_.jumps())) return;
  log::info(source_.name + " put the aircraft elsewhere");
}

void BridgeShell::hold_to_who_answers(const bridges::Sender& from) {
  answered_ns_ = latest_ns_;
  if (!std::exchange(holds_, true)) socket_.hear_only(from);
}

// It may come back by another port.
void BridgeShell::let_go_of_the_silent() {
  constexpr std::int64_t kSilence_ns = 5'000'000'000;
  if (!holds_ || monotonic_ns() - answered_ns_ < kSilence_ns) return;
  socket_.hear_all();
  holds_ = false;
}

void BridgeShell::refuse(const std::string& reason, geo::Duration now) {
  const auto line = refusals_.refused(reason, now);
  if (!line) return;
  session_->note(NoteKind::refusal, *line);
  log::warning("refused: " + *line);
}

// In the flight recorder once for each doubling: a flood is one story.
void BridgeShell::tell_losses() {
  const std::uint64_t dropped = socket_.dropped();
  if (dropped == 0 || dropped < 2 * dropped_told_) return;
  dropped_told_ = dropped;
  const std::string line = source_.name + ": " + std::to_string(dropped) + " packets came too fast and were dropped";
  session_->note(NoteKind::loss, line);
  log::warning(line);
}

void BridgeShell::tell_presence(bool heard) {
  if (heard == std::exchange(heard_, heard)) return;
  if (heard) return log::info("the aircraft is flown by " + source_.name);
  const std::string line = source_.name + " is silent; the aircraft is left to other sources";
  session_->note(NoteKind::loss, line);
  log::warning(line);
}

void BridgeShell::publish(const TickLoop::Due& due, const flight::FlightSample& sample) {
  publish_flight(session_->layout(), lane_, due, sample);
  next_publish_tick_ = due.tick + kTicksBetweenRecords;
  place_ = {sample.ownship.latitude_deg, sample.ownship.longitude_deg};
}

void BridgeShell::claim_traffic() {
  auto claim = session_->claim(Role::traffic);
  if (claim) {
    traffic_claim_ = std::move(*claim);
    return;
  }
  log::warning("the traffic of " + source_.name + " is left out: " + claim.error().message());
}

void BridgeShell::publish_traffic(const TickLoop::Due& due) {
  const bool is_due = due.tick >= next_traffic_tick_ || due.tick < next_traffic_tick_ - kTicksBetweenTraffic;
  if (!is_due && !due.new_epoch) return;
  next_traffic_tick_ = due.tick + kTicksBetweenTraffic;
  Traffic traffic = bridges::surface_traffic(source_.bridge->traffic(duration_of(monotonic_ns())), place_);
  // An empty record ends what was told; before there is anything, there is nothing to say.
  if (traffic.count == 0 && traffic_told_ == 0) return;
  traffic_told_ = traffic.count;
  traffic.source_time_ns = due.sim_time_ns;
  traffic.epoch = due.clock.epoch;
  if (const auto reason = validate(traffic)) return refuse("traffic: " + *reason, duration_of(monotonic_ns()));
  session_->layout().traffic.publish(traffic);
}

}  // namespace yars::databuffer

#include "flightmodel/app/flight_shell.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "databuffer/messages/derived_values.hpp"
#include "databuffer/messages/validation.hpp"
#include "databuffer/session/receivers.hpp"
#include "flightmodel/bridges/dis.hpp"
#include "lib/log/log.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::flightmodel {

namespace {

// [ns] Maximum gap of sim time across which a restarted program resumes the flight. After a longer gap, the flight
// begins again at its start, or at the session's last repositioning.
constexpr std::int64_t kMaxResumeGap_ns = 10'000'000'000;
// [ticks] Interval of ownship records, 20 ms. At 300 m/s the apex of the sweeps then moves in steps of 6 m. A longer
// interval would make these steps visible.
constexpr std::int64_t kTicksBetweenRecords = 4;

// Speed of the epoch's repositioning; nullopt: the model chooses.
std::optional<geo::Speed> requested_speed(const databuffer::ClockState& clock) {
  if (std::isnan(clock.reposition_latitude_deg) || !(clock.reposition_speed_mps > 0.0)) return std::nullopt;
  return geo::Speed::metres_per_second(clock.reposition_speed_mps);
}

}  // namespace

FlightShell::FlightShell(databuffer::Session& session, FlightSource source, int lane, bool every_tick)
    : session_(&session), source_(std::move(source)), lane_(static_cast<std::size_t>(lane)), every_tick_(every_tick) {}

void FlightShell::step(const runtime::TickLoop::Due& due) {
  // A repositioning that was requested before this program started applies to this flight too.
  const bool placed_before = !started_ && !resume(due) && !std::isnan(due.clock.reposition_latitude_deg);
  if (due.new_epoch || placed_before) begin_epoch(due.clock);
  const bool first = !started_ || due.new_epoch;
  const bool publishes = first || every_tick_ || due.tick - last_published_tick_ >= kTicksBetweenRecords;
  if (publishes && !every_tick_) stand_by(due);
  const FlightSample sample = source_.model->step(time_since_last(due));
  started_ = true;
  last_tick_ = due.tick;
  if (!publishes) return;
  publish_flight(session_->layout(), lane_, due, sample);
  last_published_tick_ = due.tick;
}

// Sim time since the last tick; skipped ticks become one long step. 0 for the first tick of the program. 0 also for the
// first tick of an epoch, because times of different epochs are not comparable.
geo::Duration FlightShell::time_since_last(const runtime::TickLoop::Due& due) const {
  if (!started_ || due.new_epoch || due.tick <= last_tick_) return {};
  return geo::Duration::seconds(static_cast<double>(due.tick - last_tick_) * radar::kTickSeconds);
}

void FlightShell::begin_epoch(const databuffer::ClockState& clock) {
  if (std::isnan(clock.reposition_latitude_deg)) {
    source_.model->reset();
    log::info("the flight begins again at its start, epoch " + std::to_string(clock.epoch));
    return;
  }
  if (const auto reason = databuffer::validate(clock)) {
    session_->note(databuffer::NoteKind::refusal, "repositioning: " + *reason);
    log::warning("repositioning is refused: " + *reason);
    return;
  }
  const Placement placement{{clock.reposition_latitude_deg, clock.reposition_longitude_deg},
                            geo::AltitudeMsl::metres(clock.reposition_altitude_m),
                            geo::Bearing::degrees(clock.reposition_heading_deg),
                            requested_speed(clock)};
  const bool placed = source_.model->reposition(placement);
  // `followed`: a jump of the aircraft's source began this epoch. No user requested the repositioning, so a refusal
  // needs no warning.
  if (clock.followed != 0) {
    if (placed && !started_) log::info("begins at the session's last repositioning, not at the start of its flight");
    return;
  }
  if (placed) {
    log::info("repositioned, epoch " + std::to_string(clock.epoch));
    return;
  }
  session_->note(databuffer::NoteKind::refusal,
                 "repositioning: the source only replays its file (" + source_.description + ")");
  log::warning("repositioning is refused: the source only replays its file (" + source_.description + ")");
}

// Hot standby: while the radar uses another lane, this model follows the ownship of that lane. This lane can then take
// over without a position jump. A model that cannot be repositioned continues its own flight.
void FlightShell::stand_by(const runtime::TickLoop::Due& due) {
  const databuffer::SessionLayout& layout = session_->layout();
  const auto model = databuffer::read_valid(layout.model_status);
  if (!model || model->ownship_lane == lane_ || model->ownship_lane >= databuffer::kOwnshipLanes) return;
  const bool is_current = (model->flags & databuffer::kModelStale) == 0 && model->epoch == due.clock.epoch &&
                          model->sim_time_ns + databuffer::kStaleAfter_ns > due.sim_time_ns;
  const auto priority = [&layout](std::size_t lane) {
    return layout.ownship_priority[lane].load(std::memory_order_relaxed);
  };
  if (!is_current || priority(lane_) > priority(model->ownship_lane)) return;
  const databuffer::Ownship& followed = model->ownship;
  source_.model->reposition({{followed.latitude_deg, followed.longitude_deg},
                             geo::AltitudeMsl::metres(followed.altitude_msl_m),
                             geo::Bearing::degrees(followed.heading_deg)});
}

// True if the model continues the flight of an earlier process in this epoch. Never true in lockstep.
bool FlightShell::resume(const runtime::TickLoop::Due& due) {
  if (every_tick_) return false;
  const auto model = databuffer::read_valid(session_->layout().model_status);
  if (!model) return false;
  const databuffer::Ownship& last = model->ownship;
  const FlightSample own = source_.model->step({});
  // source_time_ns is from shared memory and may have any value. The range check keeps the subtraction from
  // overflowing.
  if (std::string_view(own.ownship.source) != last.source || last.epoch != due.clock.epoch ||
      last.source_time_ns > due.sim_time_ns || last.source_time_ns < due.sim_time_ns - kMaxResumeGap_ns)
    return false;
  const auto gap = geo::Duration::seconds(1e-9 * static_cast<double>(due.sim_time_ns - last.source_time_ns));
  if (!source_.model->resume(last, gap)) return false;
  // A flight that the instructor set straight stays so.
  if (const auto speed = requested_speed(due.clock); speed && databuffer::validate(due.clock) == std::nullopt)
    source_.model->reposition({{last.latitude_deg, last.longitude_deg},
                               geo::AltitudeMsl::metres(last.altitude_msl_m),
                               databuffer::ground_track_of(last),
                               speed});
  session_->note(databuffer::NoteKind::restart, "flight-model resumes");
  log::info("continues the flight of its predecessor");
  return true;
}

namespace {

// [ticks] Interval of Traffic records, 1 s. Between records the radar extrapolates each entity by its velocity.
constexpr std::int64_t kTicksBetweenTraffic = 200;

geo::Duration duration_of(std::int64_t nanoseconds) {
  return geo::Duration::seconds(1e-9 * static_cast<double>(nanoseconds));
}

// CLOCK_MONOTONIC time [ns] at which a tick was due, limited to the last 0.1 s. While the clock is frozen, the result
// is the present time.
std::int64_t moment_of(const runtime::TickLoop::Due& due) {
  const std::int64_t now_ns = databuffer::monotonic_ns();
  if (due.clock.running == 0 || !(due.clock.rate > 0.0)) return now_ns;
  const double since_base_ns = static_cast<double>(due.sim_time_ns - due.clock.base_sim_ns) / due.clock.rate;
  constexpr double kMaxLateness_ns = 1e8;  // 0.1 s: kMaxTicksBehind ticks at rate 1
  const double late_ns = static_cast<double>(now_ns - due.clock.base_monotonic_ns) - since_base_ns;
  return now_ns - static_cast<std::int64_t>(std::clamp(late_ns, 0.0, kMaxLateness_ns));
}

}  // namespace

error::Expected<UdpSocket> open_socket(const bridges::BridgeSource& source) {
  return source.requests_data ? UdpSocket::open_to_peer(source.host, source.port)
                              : UdpSocket::listen(source.host, source.port);
}

BridgeShell::BridgeShell(databuffer::Session& session, bridges::BridgeSource source, UdpSocket socket, int lane)
    : session_(&session),
      source_(std::move(source)),
      socket_(std::move(socket)),
      lane_(static_cast<std::size_t>(lane)),
      flight_(source_.bridge->extrapolation_limit()) {
  log::info((source_.requests_data ? "asks " : "listens for ") + source_.name +
            (source_.requests_data ? " at " : " on ") + text_of(socket_.endpoint()));
  if (source_.bridge->has_traffic()) claim_traffic();
}

BridgeShell::~BridgeShell() {
  if (traffic_claim_) session_->layout().traffic.clear();
  for (const auto& datagram : source_.bridge->closing_datagrams()) socket_.send(datagram);
  if (refusals_.count() > 0) log::info(text::counted(refusals_.count(), "refused packet"));
}

void BridgeShell::step(const runtime::TickLoop::Due& due) {
  if (due.new_epoch) begin_epoch(due.clock);
  release_silent_responder();
  send_requests();
  receive();
  if (traffic_claim_) publish_traffic(due);
  const auto sample = flight_.at(duration_of(moment_of(due)));
  report_presence(sample.has_value());
  if (!sample) return;
  if (due.tick >= next_publish_tick_ || due.new_epoch || due.tick < next_publish_tick_ - kTicksBetweenRecords)
    publish(due, *sample);
}

void BridgeShell::begin_epoch(const databuffer::ClockState& clock) {
  // A reset needs no message. Nor does an epoch that began because a source jumped; that source may be this bridge.
  if (std::isnan(clock.reposition_latitude_deg) || clock.followed != 0) return;
  const std::string line = "repositioning: " + source_.name + " controls the aircraft; reposition it there";
  session_->note(databuffer::NoteKind::refusal, line);
  log::warning(line);
}

void BridgeShell::send_requests() {
  for (const auto& datagram : source_.bridge->requests(duration_of(databuffer::monotonic_ns()))) socket_.send(datagram);
}

void BridgeShell::receive() {
  socket_.receive(kMaxDatagramsPerTick, [this](memory::Bytes datagram, const bridges::Sender& from,
                                               std::int64_t received_ns) { take(datagram, from, received_ns); });
  report_drops();
}

void BridgeShell::take(memory::Bytes datagram, const bridges::Sender& from, std::int64_t received_ns) {
  latest_ns_ = std::max(latest_ns_, received_ns);
  const geo::Duration now = duration_of(latest_ns_);
  const bool one_sender = !source_.bridge->allows_many_senders();
  if (one_sender && !gate_.admits(from, now))
    return refuse(source_.name + ": expected packets of one sender, found another, " + text_of(from), now);
  source_.bridge->set_sender(from);
  const auto sample = source_.bridge->receive(datagram, now);
  if (const auto news = source_.bridge->take_log_message()) log::info(*news);
  if (!sample) return refuse(sample.error().message(), now);
  if (!*sample) return;
  if (gate_.taken(from, now) && one_sender) log::info("receives " + source_.name + " from " + text_of(from));
  if (source_.requests_data) lock_to_responder(from);
  flight_.receive(**sample, now);
  if (flight_.jumps() == std::exchange(reported_jumps_, flight_.jumps())) return;
  log::info(source_.name + " has moved the aircraft to another position");
}

void BridgeShell::lock_to_responder(const bridges::Sender& from) {
  last_reply_ns_ = latest_ns_;
  if (!std::exchange(locked_to_responder_, true)) socket_.receive_only_from(from);
}

// After 5 s without a reply, packets from all ports of the host are accepted again. A restarted responder may use
// another port.
void BridgeShell::release_silent_responder() {
  constexpr std::int64_t kSilence_ns = 5'000'000'000;
  if (!locked_to_responder_ || databuffer::monotonic_ns() - last_reply_ns_ < kSilence_ns) return;
  socket_.receive_from_all();
  locked_to_responder_ = false;
}

void BridgeShell::refuse(const std::string& reason, geo::Duration now) {
  const auto line = refusals_.refused(reason, now);
  if (!line) return;
  session_->note(databuffer::NoteKind::refusal, *line);
  log::warning("refused: " + *line);
}

// Reports dropped packets each time their count has doubled, so that a flood causes few messages.
void BridgeShell::report_drops() {
  const std::uint64_t dropped = socket_.dropped();
  if (dropped == 0 || dropped < 2 * reported_drops_) return;
  reported_drops_ = dropped;
  const std::string line = source_.name + ": dropped " + text::counted(dropped, "packet") + " that came too fast";
  session_->note(databuffer::NoteKind::loss, line);
  log::warning(line);
}

void BridgeShell::report_presence(bool receiving) {
  if (receiving == std::exchange(receiving_, receiving)) return;
  if (receiving) return log::info("the aircraft is flown by " + source_.name);
  const std::string line = source_.name + " is silent; other sources may fly the aircraft";
  session_->note(databuffer::NoteKind::loss, line);
  log::warning(line);
}

void BridgeShell::publish(const runtime::TickLoop::Due& due, const FlightSample& sample) {
  publish_flight(session_->layout(), lane_, due, sample);
  next_publish_tick_ = due.tick + kTicksBetweenRecords;
  position_ = {sample.ownship.latitude_deg, sample.ownship.longitude_deg};
}

void BridgeShell::claim_traffic() {
  auto claim = session_->claim(databuffer::Role::traffic);
  if (claim) {
    traffic_claim_ = std::move(*claim);
    return;
  }
  log::warning("the traffic of " + source_.name + " is left out: " + claim.error().message());
}

void BridgeShell::publish_traffic(const runtime::TickLoop::Due& due) {
  const bool is_due = due.tick >= next_traffic_tick_ || due.tick < next_traffic_tick_ - kTicksBetweenTraffic;
  if (!is_due && !due.new_epoch) return;
  next_traffic_tick_ = due.tick + kTicksBetweenTraffic;
  databuffer::Traffic traffic =
      bridges::surface_traffic(source_.bridge->traffic(duration_of(databuffer::monotonic_ns())), position_);
  // One empty record removes the entities of the last record. Further empty records are not published.
  if (traffic.count == 0 && published_entities_ == 0) return;
  traffic.source_time_ns = due.sim_time_ns;
  traffic.epoch = due.clock.epoch;
  if (const auto reason = databuffer::validate(traffic))
    return refuse("traffic: " + *reason, duration_of(databuffer::monotonic_ns()));
  session_->layout().traffic.publish(traffic);
  published_entities_ = traffic.count;
}

}  // namespace yars::flightmodel

#include "databuffer/flight_shell.hpp"

#include <cmath>
#include <string_view>
#include <utility>

#include "databuffer/log.hpp"
#include "databuffer/publish_flight.hpp"
#include "databuffer/records/model_validation.hpp"
#include "databuffer/records/select_ownship.hpp"
#include "databuffer/records/validation.hpp"

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
    log_info("back at the start, epoch " + std::to_string(clock.epoch));
    return;
  }
  if (const auto reason = why_refused(clock)) {
    session_->note(NoteKind::refusal, "repositioning: " + *reason);
    log_warning("repositioning is refused: " + *reason);
    return;
  }
  const flight::Placement placement{{clock.reposition_latitude_deg, clock.reposition_longitude_deg},
                                    geo::AltitudeMsl::metres(clock.reposition_altitude_m),
                                    geo::Bearing::degrees(clock.reposition_heading_deg)};
  const bool placed = source_.model->reposition(placement);
  // Nobody asked for it: another source went there.
  if (clock.followed != 0) {
    if (placed && !started_) log_info("begins where the session's aircraft was last placed, not at its own place");
    return;
  }
  if (placed) {
    log_info("repositioned, epoch " + std::to_string(clock.epoch));
    return;
  }
  session_->note(NoteKind::refusal, "repositioning: " + source_.description + " follows its file alone");
  log_warning("repositioning is refused: " + source_.description + " follows its file alone");
}

// So that it takes over without a jump when that source falls silent. One that cannot be placed flies on as it does.
void FlightShell::stand_by(const TickLoop::Due& due) {
  const SessionLayout& layout = session_->layout();
  ModelStatus model{};
  if (!layout.model_status.read(model) || model.ownship_lane == lane_ || model.ownship_lane >= kOwnshipLanes ||
      why_refused(model))
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
  if (every_tick_ || !session_->layout().model_status.read(model) || why_refused(model)) return false;
  const Ownship& last = model.ownship;
  const flight::FlightSample own = source_.model->step({});
  // The stamp is whatever the source wrote: compared before a difference is taken.
  if (std::string_view(own.ownship.source) != last.source || last.epoch != due.clock.epoch ||
      last.source_time_ns > due.sim_time_ns || last.source_time_ns < due.sim_time_ns - kLongestGap_ns)
    return false;
  const std::int64_t gap_ns = due.sim_time_ns - last.source_time_ns;
  if (!source_.model->resume(last, geo::Duration::seconds(1e-9 * static_cast<double>(gap_ns)))) return false;
  session_->note(NoteKind::restart, "flight-model resumes");
  log_info("resumes where its predecessor was");
  return true;
}

}  // namespace yars::databuffer

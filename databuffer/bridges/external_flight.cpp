#include "databuffer/bridges/external_flight.hpp"

#include <algorithm>
#include <cmath>

#include "databuffer/bridges/dead_reckoning.hpp"
#include "databuffer/flight/motion.hpp"
#include "databuffer/records/plain_text.hpp"
#include "databuffer/records/validation.hpp"

namespace yars::databuffer::bridges {

namespace {

// Rates are measured over at least this: over less, the jitter of a network makes nonsense of them.
constexpr geo::Duration kShortestMeasure = geo::Duration::seconds(0.08);
// And at most this: what an aircraft did longer ago says nothing of now.
constexpr geo::Duration kLongestMeasure = geo::Duration::seconds(1.0);
// [m] that the velocity would have flown while the place stayed: more than two steps of the coarsest source (JSBSim's
// seven digits, 11 m) prove that it stands.
constexpr double kStandingProof = 25.0;
// [deg] of any angle: more is no correction of dead reckoning, and blending it would roll the picture.
constexpr double kLargestTurn = 30.0;
// How far a moment may lie before the last report: a tick that comes late, behind a report just taken.
constexpr geo::Duration kLongestBack = geo::Duration::seconds(0.2);

bool same_place(const Ownship& a, const Ownship& b) {
  return a.latitude_deg == b.latitude_deg && a.longitude_deg == b.longitude_deg && a.altitude_msl_m == b.altitude_msl_m;
}

double speed_of(const Ownship& ownship) {
  return geo::length({ownship.velocity_north_mps, ownship.velocity_east_mps, ownship.velocity_down_mps});
}

void halt(ExternalSample& sample) {
  sample.ownship.velocity_north_mps = sample.ownship.velocity_east_mps = sample.ownship.velocity_down_mps = 0.0;
  sample.rates = AttitudeRates{};
  sample.acceleration_mps2 = geo::Vector3{};
}

double turn_deg(double from_deg, double to_deg) {
  return geo::wrapped_degrees(to_deg - from_deg);
}

flight::FlightSample as_flight(const Ownship& ownship) {
  const auto track = geo::Bearing::radians(std::atan2(ownship.velocity_east_mps, ownship.velocity_north_mps));
  const double along_mps = std::hypot(ownship.velocity_north_mps, ownship.velocity_east_mps);
  const flight::Motion motion{{ownship.latitude_deg, ownship.longitude_deg},
                              geo::AltitudeMsl::metres(ownship.altitude_msl_m),
                              track,
                              geo::Speed::metres_per_second(along_mps),
                              geo::Speed::metres_per_second(-ownship.velocity_down_mps)};
  const flight::Attitude attitude{geo::Bearing::degrees(ownship.heading_deg), geo::Angle::degrees(ownship.pitch_deg),
                                  geo::Angle::degrees(ownship.roll_deg)};
  return flight::sample_of(motion, attitude, text_of(ownship.source));
}

}  // namespace

ExternalFlight::Difference ExternalFlight::difference(const Ownship& before, const Ownship& told) {
  const auto line =
      geo::geodesic_inverse({told.latitude_deg, told.longitude_deg}, {before.latitude_deg, before.longitude_deg});
  return {line.distance.metres() * std::cos(line.azimuth_at_start.radians()),
          line.distance.metres() * std::sin(line.azimuth_at_start.radians()),
          before.altitude_msl_m - told.altitude_msl_m,
          before.velocity_north_mps - told.velocity_north_mps,
          before.velocity_east_mps - told.velocity_east_mps,
          before.velocity_down_mps - told.velocity_down_mps,
          turn_deg(told.heading_deg, before.heading_deg),
          before.pitch_deg - told.pitch_deg,
          turn_deg(told.roll_deg, before.roll_deg)};
}

bool ExternalFlight::is_jump(const Difference& difference) {
  return geo::length({difference.north_m, difference.east_m, difference.up_m}) > kJump.metres();
}

void ExternalFlight::measure_rates(const ExternalSample& sample, geo::Duration received) {
  const auto begin = [&] { earlier_ = Report{sample, received}; };
  if (!earlier_) return begin();
  const geo::Duration since = received - earlier_->received;
  if (since < kShortestMeasure) return;
  measured_rates_.reset();
  measured_acceleration_.reset();
  if (since <= kLongestMeasure) {
    const Ownship& then = earlier_->sample.ownship;
    const Ownship& now = sample.ownship;
    const double per_s = 1.0 / since.seconds();
    const auto limited = [per_s](double change, double most) { return std::clamp(change * per_s, -most, most); };
    measured_rates_ = AttitudeRates{limited(turn_deg(then.heading_deg, now.heading_deg), kFastestTurn),
                                    limited(now.pitch_deg - then.pitch_deg, kFastestTurn),
                                    limited(turn_deg(then.roll_deg, now.roll_deg), kFastestTurn)};
    measured_acceleration_ = geo::Vector3{limited(now.velocity_north_mps - then.velocity_north_mps, kHardestPull),
                                          limited(now.velocity_east_mps - then.velocity_east_mps, kHardestPull),
                                          limited(now.velocity_down_mps - then.velocity_down_mps, kHardestPull)};
  }
  begin();
}

bool ExternalFlight::stands(const ExternalSample& sample, geo::Duration received) {
  if (!unmoved_ || !same_place(unmoved_->sample.ownship, sample.ownship)) unmoved_ = Report{sample, received};
  return speed_of(sample.ownship) * (received - unmoved_->received).seconds() > kStandingProof;
}

void ExternalFlight::receive(const ExternalSample& sample, geo::Duration received) {
  const std::optional<Ownship> before = estimate(received);
  measure_rates(sample, received);
  Report report{sample, received};
  if (!report.sample.rates) report.sample.rates = measured_rates_;
  if (!report.sample.acceleration_mps2) report.sample.acceleration_mps2 = measured_acceleration_;
  if (stands(sample, received)) halt(report.sample);
  left_ = before ? difference(*before, report.sample.ownship) : Difference{};
  if (is_jump(left_)) {
    ++jumps_;
    left_ = {};
    earlier_.reset();
  }
  for (double* angle : {&left_.heading_deg, &left_.pitch_deg, &left_.roll_deg})
    if (std::abs(*angle) > kLargestTurn) *angle = 0.0;
  last_ = report;
}

std::optional<Ownship> ExternalFlight::estimate(geo::Duration moment) const {
  if (!last_ || moment - last_->received > reach_) return std::nullopt;
  const geo::Duration after = std::max(moment - last_->received, -kLongestBack);
  const double share = std::exp(-std::max(after.seconds(), 0.0) / kBlend.seconds());
  Ownship there = dead_reckoned(last_->sample, after);
  const double away_m = std::hypot(left_.north_m, left_.east_m) * share;
  if (away_m > 0.0) {
    const auto azimuth = geo::Bearing::radians(std::atan2(left_.east_m, left_.north_m));
    const auto point =
        geo::geodesic_direct({there.latitude_deg, there.longitude_deg}, azimuth, geo::Length::metres(away_m));
    there.latitude_deg = point.latitude_deg;
    there.longitude_deg = point.longitude_deg;
  }
  there.altitude_msl_m += share * left_.up_m;
  there.velocity_north_mps += share * left_.north_mps;
  there.velocity_east_mps += share * left_.east_mps;
  there.velocity_down_mps += share * left_.down_mps;
  there.heading_deg = geo::Bearing::degrees(there.heading_deg + share * left_.heading_deg).degrees();
  there.pitch_deg = std::clamp(there.pitch_deg + share * left_.pitch_deg, -90.0, 90.0);
  there.roll_deg = geo::wrapped_degrees(there.roll_deg + share * left_.roll_deg);
  return there;
}

std::optional<flight::FlightSample> ExternalFlight::at(geo::Duration moment) const {
  const std::optional<Ownship> there = estimate(moment);
  // Flown on beyond what a record may hold: better nothing.
  if (!there || why_refused(*there)) return std::nullopt;
  return as_flight(*there);
}

}  // namespace yars::databuffer::bridges

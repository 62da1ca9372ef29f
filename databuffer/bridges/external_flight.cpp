#include "databuffer/bridges/external_flight.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "databuffer/flight/motion.hpp"
#include "databuffer/messages/validation.hpp"
#include "lib/geo/frames.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::databuffer::bridges {

// The way from one stamp to another, the shorter one where stamps run in a circle.
geo::Duration StampOrder::since(geo::Duration before, geo::Duration stamp) const {
  const double way_s = (stamp - before).seconds();
  return geo::Duration::seconds(period_ ? std::remainder(way_s, period_->seconds()) : way_s);
}

std::optional<std::string> StampOrder::why_not_news(geo::Duration stamp) {
  const auto take = [&] {
    last_ = stamp;
    restarted_.reset();
    return std::nullopt;
  };
  if (!last_) return take();
  const geo::Duration ahead = since(*last_, stamp);
  if (ahead > geo::Duration()) return take();
  const std::string found = "stamp " + text::text_of_number(stamp.seconds()) + " s ";
  if (ahead == geo::Duration()) return found + "for the second time";
  const std::string after = "after " + text::text_of_number(last_->seconds()) + " s";
  if (ahead >= -kLongestDelay) return found + after;
  if (restarted_) {
    const geo::Duration on = since(*restarted_, stamp);
    if (on > geo::Duration() && on <= kLongestDelay) return take();
  }
  restarted_ = stamp;
  return found + after + ", a first of a sender that began again";
}

namespace {

// Below this cosine of the pitch, 0.6 deg from the vertical, heading and roll turn without bound.
constexpr double kMinCosine = 0.01;

std::optional<error::Error> outside(std::string_view source, std::string_view field, double value, double least,
                                    double most) {
  // Written so that NaN fails.
  if (value >= least && value <= most) return std::nullopt;
  return error::Error{
      std::string(source),
      std::string(field) + " in [" + text::text_of_number(least) + ", " + text::text_of_number(most) + ']',
      text::text_of_number(value),
      {},
      false};
}

// [deg] What is left over when a float of radians says 90 or 180 degrees.
constexpr double kRounding = 1e-4;

// Angles that other programs count from another zero, and what has no field in the record.
std::optional<error::Error> fault_of(std::string_view source, const Reading& reading,
                                     const std::optional<AttitudeRates>& rates,
                                     const std::optional<geo::Vector3>& acceleration) {
  if (auto fault = outside(source, "heading_deg", reading.heading_deg, -360.0, 720.0)) return fault;
  if (auto fault = outside(source, "longitude_deg", reading.longitude_deg, -180.0, 360.0)) return fault;
  if (rates) {
    for (const double rate : {rates->heading_dps, rates->pitch_dps, rates->roll_dps})
      if (auto fault = outside(source, "attitude rate [deg/s]", rate, -kFastestTurn, kFastestTurn)) return fault;
  }
  if (acceleration) {
    for (const double part : {acceleration->x, acceleration->y, acceleration->z})
      if (auto fault = outside(source, "acceleration [m/s^2]", part, -kHardestPull, kHardestPull)) return fault;
  }
  return std::nullopt;
}

}  // namespace

error::Expected<ExternalSample> checked_sample(std::string_view source, const Reading& reading,
                                               const std::optional<AttitudeRates>& rates,
                                               const std::optional<geo::Vector3>& acceleration_mps2) {
  if (auto fault = fault_of(source, reading, rates, acceleration_mps2)) return tl::unexpected(std::move(*fault));
  ExternalSample sample;
  Ownship& ownship = sample.ownship;
  ownship.latitude_deg = reading.latitude_deg;
  ownship.longitude_deg = geo::wrapped_degrees(reading.longitude_deg);
  ownship.altitude_msl_m = reading.altitude_msl_m;
  ownship.heading_deg = geo::Bearing::degrees(reading.heading_deg).degrees();
  const auto rounded = [](double angle_deg, double most_deg) {
    return std::abs(angle_deg) <= most_deg + kRounding ? std::clamp(angle_deg, -most_deg, most_deg) : angle_deg;
  };
  ownship.pitch_deg = rounded(reading.pitch_deg, 90.0);
  ownship.roll_deg = rounded(reading.roll_deg, 180.0);
  ownship.velocity_north_mps = reading.velocity_north_mps;
  ownship.velocity_east_mps = reading.velocity_east_mps;
  ownship.velocity_down_mps = reading.velocity_down_mps;
  ownship.radar_altitude_m = std::numeric_limits<double>::quiet_NaN();
  source.copy(ownship.source, sizeof ownship.source - 1);
  if (const auto refusal = validate(ownship)) return error::fail(std::string(source), "a flight that can be", *refusal);
  sample.rates = rates;
  sample.acceleration_mps2 = acceleration_mps2;
  return sample;
}

std::optional<AttitudeRates> rates_from_body(double roll_rate_dps, double pitch_rate_dps, double yaw_rate_dps,
                                             double pitch_deg, double roll_deg) {
  const double cos_pitch = std::cos(pitch_deg * geo::kRadiansPerDegree);
  if (std::abs(cos_pitch) < kMinCosine) return std::nullopt;
  const double sin_roll = std::sin(roll_deg * geo::kRadiansPerDegree);
  const double cos_roll = std::cos(roll_deg * geo::kRadiansPerDegree);
  AttitudeRates rates;
  rates.heading_dps = (pitch_rate_dps * sin_roll + yaw_rate_dps * cos_roll) / cos_pitch;
  rates.pitch_dps = pitch_rate_dps * cos_roll - yaw_rate_dps * sin_roll;
  rates.roll_dps = roll_rate_dps + rates.heading_dps * std::sin(pitch_deg * geo::kRadiansPerDegree);
  return rates;
}

namespace {

struct Way {
  geo::GeoPoint point;
  geo::Angle meridian_turn;  // by which north, there, is turned against north here
};

Way way_over_ground(const Ownship& from, double north_m, double east_m) {
  const double distance_m = std::hypot(north_m, east_m);
  const geo::GeoPoint point{from.latitude_deg, from.longitude_deg};
  if (distance_m == 0.0) return {point, {}};
  const auto azimuth = geo::Bearing::radians(std::atan2(east_m, north_m));
  const flight::Motion motion{point, geo::AltitudeMsl::metres(from.altitude_msl_m), azimuth, {}, {}};
  const auto there =
      geo::GeodesicRay(point, azimuth).place(flight::surface_distance(motion, geo::Length::metres(distance_m)));
  return {there.point, there.azimuth - azimuth};
}

}  // namespace

Ownship dead_reckoned(const ExternalSample& sample, geo::Duration after) {
  const double t = after.seconds();
  const geo::Vector3 a = sample.acceleration_mps2.value_or(geo::Vector3{});
  const Ownship& from = sample.ownship;
  Ownship there = from;
  const Way way = way_over_ground(from, from.velocity_north_mps * t + 0.5 * a.x * t * t,
                                  from.velocity_east_mps * t + 0.5 * a.y * t * t);
  there.latitude_deg = way.point.latitude_deg;
  there.longitude_deg = way.point.longitude_deg;
  there.altitude_msl_m -= from.velocity_down_mps * t + 0.5 * a.z * t * t;
  const double north_mps = from.velocity_north_mps + a.x * t;
  const double east_mps = from.velocity_east_mps + a.y * t;
  const double cos_turn = std::cos(way.meridian_turn.radians());
  const double sin_turn = std::sin(way.meridian_turn.radians());
  there.velocity_north_mps = north_mps * cos_turn - east_mps * sin_turn;
  there.velocity_east_mps = north_mps * sin_turn + east_mps * cos_turn;
  there.velocity_down_mps += a.z * t;
  const AttitudeRates rates = sample.rates.value_or(AttitudeRates{});
  const double heading_deg = from.heading_deg + rates.heading_dps * t + way.meridian_turn.degrees();
  there.heading_deg = geo::Bearing::degrees(heading_deg).degrees();
  there.pitch_deg = std::clamp(from.pitch_deg + rates.pitch_dps * t, -90.0, 90.0);
  there.roll_deg = geo::wrapped_degrees(from.roll_deg + rates.roll_dps * t);
  return there;
}

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
  return glm::length(geo::Vector3(ownship.velocity_north_mps, ownship.velocity_east_mps, ownship.velocity_down_mps));
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
  return flight::sample_of(motion, attitude, text::text_of(ownship.source));
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
  return glm::length(geo::Vector3(difference.north_m, difference.east_m, difference.up_m)) > kJump.metres();
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
  if (!there || validate(*there)) return std::nullopt;
  return as_flight(*there);
}

}  // namespace yars::databuffer::bridges

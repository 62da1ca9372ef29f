#include "flightmodel/bridges/external_flight.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "databuffer/messages/validation.hpp"
#include "flightmodel/motion.hpp"
#include "lib/geo/frames.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::flightmodel::bridges {

// Time from `before` to `stamp`, negative if `stamp` is older. If stamps wrap, the shorter of the two possible times.
geo::Duration StampOrder::since(geo::Duration before, geo::Duration stamp) const {
  const double difference_s = (stamp - before).seconds();
  return geo::Duration::seconds(period_ ? std::remainder(difference_s, period_->seconds()) : difference_s);
}

std::optional<std::string> StampOrder::order_fault(geo::Duration stamp) {
  const auto accept = [&] {
    last_ = stamp;
    restarted_.reset();
    return std::nullopt;
  };
  if (!last_) return accept();
  const geo::Duration ahead = since(*last_, stamp);
  if (ahead > geo::Duration()) return accept();
  const std::string found = "stamp " + text::text_of_number(stamp.seconds()) + " s ";
  if (ahead == geo::Duration()) return found + "for the second time";
  const std::string after = "after stamp " + text::text_of_number(last_->seconds()) + " s";
  if (ahead >= -kMaxPacketDelay) return found + after;
  if (restarted_) {
    const geo::Duration after_restart = since(*restarted_, stamp);
    if (after_restart > geo::Duration() && after_restart <= kMaxPacketDelay) return accept();
  }
  restarted_ = stamp;
  return found + after + "; the sender may have restarted, so reports from this stamp on are accepted next";
}

namespace {

// Minimum cosine of the pitch, 0.6 deg from vertical. Below it heading and roll rates grow without bound.
constexpr double kMinPitchCosine = 0.01;

std::optional<error::Error> outside(std::string_view source, std::string_view field, double value, double lower,
                                    double upper) {
  // NaN fails this comparison.
  if (value >= lower && value <= upper) return std::nullopt;
  return error::Error{
      std::string(source),
      std::string(field) + " in [" + text::text_of_number(lower) + ", " + text::text_of_number(upper) + ']',
      text::text_of_number(value),
      {}};
}

// [deg] Tolerance for the rounding error of 90 or 180 deg that were sent in radians as a float.
constexpr double kAngleRounding_deg = 1e-4;

// Checks heading and longitude, which are wrapped later, and rates and acceleration, which Ownship does not have.
std::optional<error::Error> fault_of(std::string_view source, const Reading& reading,
                                     const std::optional<AttitudeRates>& rates,
                                     const std::optional<geo::Vector3>& acceleration) {
  if (auto fault = outside(source, "heading_deg", reading.heading_deg, -360.0, 720.0)) return fault;
  if (auto fault = outside(source, "longitude_deg", reading.longitude_deg, -180.0, 360.0)) return fault;
  if (rates) {
    for (const double rate : {rates->heading_dps, rates->pitch_dps, rates->roll_dps})
      if (auto fault = outside(source, "attitude rate [deg/s]", rate, -kMaxAttitudeRate_dps, kMaxAttitudeRate_dps))
        return fault;
  }
  if (acceleration) {
    for (const double part : {acceleration->x, acceleration->y, acceleration->z})
      if (auto fault = outside(source, "acceleration [m/s^2]", part, -kMaxAcceleration_mps2, kMaxAcceleration_mps2))
        return fault;
  }
  return std::nullopt;
}

}  // namespace

error::Expected<ExternalSample> checked_sample(std::string_view source, const Reading& reading,
                                               const std::optional<AttitudeRates>& rates,
                                               const std::optional<geo::Vector3>& acceleration_mps2) {
  if (auto fault = fault_of(source, reading, rates, acceleration_mps2)) return tl::unexpected(std::move(*fault));
  ExternalSample sample;
  databuffer::Ownship& ownship = sample.ownship;
  ownship.latitude_deg = reading.latitude_deg;
  ownship.longitude_deg = geo::wrapped_degrees(reading.longitude_deg);
  ownship.altitude_msl_m = reading.altitude_msl_m;
  ownship.heading_deg = geo::Bearing::degrees(reading.heading_deg).degrees();
  const auto rounded = [](double angle_deg, double max_deg) {
    return std::abs(angle_deg) <= max_deg + kAngleRounding_deg ? std::clamp(angle_deg, -max_deg, max_deg) : angle_deg;
  };
  ownship.pitch_deg = rounded(reading.pitch_deg, 90.0);
  ownship.roll_deg = rounded(reading.roll_deg, 180.0);
  ownship.velocity_north_mps = reading.velocity_north_mps;
  ownship.velocity_east_mps = reading.velocity_east_mps;
  ownship.velocity_down_mps = reading.velocity_down_mps;
  ownship.radar_altitude_m = std::numeric_limits<double>::quiet_NaN();
  source.copy(ownship.source, sizeof ownship.source - 1);
  if (const auto refusal = databuffer::validate(ownship))
    return error::fail(std::string(source), "position, attitude and velocity within their limits", *refusal);
  sample.rates = rates;
  sample.acceleration_mps2 = acceleration_mps2;
  return sample;
}

std::optional<AttitudeRates> rates_from_body(double roll_rate_dps, double pitch_rate_dps, double yaw_rate_dps,
                                             double pitch_deg, double roll_deg) {
  const double cos_pitch = std::cos(pitch_deg * geo::kRadiansPerDegree);
  if (std::abs(cos_pitch) < kMinPitchCosine) return std::nullopt;
  const double sin_roll = std::sin(roll_deg * geo::kRadiansPerDegree);
  const double cos_roll = std::cos(roll_deg * geo::kRadiansPerDegree);
  AttitudeRates rates;
  rates.heading_dps = (pitch_rate_dps * sin_roll + yaw_rate_dps * cos_roll) / cos_pitch;
  rates.pitch_dps = pitch_rate_dps * cos_roll - yaw_rate_dps * sin_roll;
  rates.roll_dps = roll_rate_dps + rates.heading_dps * std::sin(pitch_deg * geo::kRadiansPerDegree);
  return rates;
}

namespace {

struct Displacement {
  geo::GeoPoint point;
  geo::Angle meridian_turn;  // convergence of meridians: azimuth of the geodesic at its end minus azimuth at its start
};

Displacement displacement_over_ground(const databuffer::Ownship& from, double north_m, double east_m) {
  const double distance_m = std::hypot(north_m, east_m);
  const geo::GeoPoint point{from.latitude_deg, from.longitude_deg};
  if (distance_m == 0.0) return {point, {}};
  const auto azimuth = geo::Bearing::radians(std::atan2(east_m, north_m));
  const flightmodel::Motion motion{point, geo::AltitudeMsl::metres(from.altitude_msl_m), azimuth, {}, {}};
  const auto state = geo::GeodesicRay(point, azimuth)
                         .position_and_azimuth(flightmodel::surface_distance(motion, geo::Length::metres(distance_m)));
  return {state.point, state.azimuth - azimuth};
}

// Displacement [m] since the report and velocity [m/s]: north, east, down.
struct Flown {
  geo::Vector3 displacement, velocity;
};

// Motion in t [s] with the initial velocity v and acceleration a, which both turn about the vector w [rad/s].
// Source: IEEE 1278.1-1995 annex B and 1278.1-2012 annex E, matrices R1 and R2 of algorithms 7 and 8.
// In a slow turn, rounding spoils the differences in R1 and R2. So both are built from the quotients s1, c2, s3 and c4.
Flown flown(const geo::Vector3& v, const geo::Vector3& a, const geo::Vector3& w, double t) {
  const double x = glm::length(w) * t;
  if (x == 0.0) return {v * t + 0.5 * t * t * a, v + t * a};
  const double half = std::sin(0.5 * x) / x;
  const double s1 = std::sin(x) / x;
  const double c2 = 2.0 * half * half;   // (1 - cos x) / x^2
  const bool slow = std::abs(x) < 0.02;  // then series; omitted terms are under 2e-10 of the first
  const double s3 = slow ? 1.0 / 6.0 - x * x / 120.0 : (1.0 - s1) / (x * x);   // (x - sin x) / x^3
  const double c4 = slow ? 1.0 / 24.0 - x * x / 720.0 : (0.5 - c2) / (x * x);  // (x^2 / 2 - 1 + cos x) / x^4
  // The sum of a vector along w, a multiple of u, and a vector perpendicular to w and u.
  const auto turned = [&](const geo::Vector3& u, double along, double multiple, double across) {
    return along * t * t * glm::dot(w, u) * w + multiple * u + across * t * glm::cross(w, u);
  };
  const geo::Vector3 later = v + t * a;
  return {t * turned(v, s3, s1, c2) + t * t * turned(a, s3 - c4, s1 - c2, c2 - s3), turned(later, c2, std::cos(x), s1)};
}

}  // namespace

databuffer::Ownship dead_reckoned(const ExternalSample& sample, geo::Duration after) {
  const double t = after.seconds();
  const geo::Vector3 a = sample.acceleration_mps2.value_or(geo::Vector3{});
  const databuffer::Ownship& from = sample.ownship;
  databuffer::Ownship state = from;
  const geo::Vector3 velocity{from.velocity_north_mps, from.velocity_east_mps, from.velocity_down_mps};
  const Flown path = flown(velocity, a, sample.turn_radps, t);
  const Displacement displacement = displacement_over_ground(from, path.displacement.x, path.displacement.y);
  state.latitude_deg = displacement.point.latitude_deg;
  state.longitude_deg = displacement.point.longitude_deg;
  state.altitude_msl_m -= path.displacement.z;
  const double north_mps = path.velocity.x;
  const double east_mps = path.velocity.y;
  const double cos_turn = std::cos(displacement.meridian_turn.radians());
  const double sin_turn = std::sin(displacement.meridian_turn.radians());
  state.velocity_north_mps = north_mps * cos_turn - east_mps * sin_turn;
  state.velocity_east_mps = north_mps * sin_turn + east_mps * cos_turn;
  state.velocity_down_mps = path.velocity.z;
  const AttitudeRates rates = sample.rates.value_or(AttitudeRates{});
  const double heading_deg = from.heading_deg + rates.heading_dps * t + displacement.meridian_turn.degrees();
  state.heading_deg = geo::Bearing::degrees(heading_deg).degrees();
  state.pitch_deg = std::clamp(from.pitch_deg + rates.pitch_dps * t, -90.0, 90.0);
  state.roll_deg = geo::wrapped_degrees(from.roll_deg + rates.roll_dps * t);
  return state;
}

namespace {

// Minimum interval for measuring rates; network jitter corrupts shorter measurements.
constexpr geo::Duration kMinRateInterval = geo::Duration::seconds(0.08);
// Maximum interval for measuring rates; older reports do not describe the present motion.
constexpr geo::Duration kMaxRateInterval = geo::Duration::seconds(1.0);
// [m] The aircraft counts as stationary if its reported speed, times the time for which its position is unchanged,
// exceeds this distance. The distance exceeds two position steps of the coarsest source (JSBSim, seven digits: 11 m).
constexpr double kStationaryProof_m = 25.0;
// [deg] Maximum difference of an angle that is blended. Blending a larger one would show a turn that the
// aircraft did not make.
constexpr double kMaxBlendedAngle_deg = 30.0;
// Maximum time by which a requested time may precede the last report. A tick that is processed late can request a time
// before a report that has already arrived.
constexpr geo::Duration kMaxBackward = geo::Duration::seconds(0.2);

bool same_position(const databuffer::Ownship& a, const databuffer::Ownship& b) {
  return a.latitude_deg == b.latitude_deg && a.longitude_deg == b.longitude_deg && a.altitude_msl_m == b.altitude_msl_m;
}

double speed_of(const databuffer::Ownship& ownship) {
  return glm::length(geo::Vector3(ownship.velocity_north_mps, ownship.velocity_east_mps, ownship.velocity_down_mps));
}

void halt(ExternalSample& sample) {
  sample.ownship.velocity_north_mps = sample.ownship.velocity_east_mps = sample.ownship.velocity_down_mps = 0.0;
  sample.rates = AttitudeRates{};
  sample.acceleration_mps2 = geo::Vector3{};
  sample.turn_radps = {};
}

double turn_deg(double from_deg, double to_deg) {
  return geo::wrapped_degrees(to_deg - from_deg);
}

flightmodel::FlightSample as_flight(const databuffer::Ownship& ownship) {
  const auto track = geo::Bearing::radians(std::atan2(ownship.velocity_east_mps, ownship.velocity_north_mps));
  const double along_mps = std::hypot(ownship.velocity_north_mps, ownship.velocity_east_mps);
  const flightmodel::Motion motion{{ownship.latitude_deg, ownship.longitude_deg},
                                   geo::AltitudeMsl::metres(ownship.altitude_msl_m),
                                   track,
                                   geo::Speed::metres_per_second(along_mps),
                                   geo::Speed::metres_per_second(-ownship.velocity_down_mps)};
  const flightmodel::Attitude attitude{geo::Bearing::degrees(ownship.heading_deg),
                                       geo::Angle::degrees(ownship.pitch_deg), geo::Angle::degrees(ownship.roll_deg)};
  return flightmodel::sample_of(motion, attitude, text::text_of(ownship.source));
}

}  // namespace

ExternalFlight::Difference ExternalFlight::difference(const databuffer::Ownship& before,
                                                      const databuffer::Ownship& reported) {
  const auto line = geo::geodesic_inverse({reported.latitude_deg, reported.longitude_deg},
                                          {before.latitude_deg, before.longitude_deg});
  return {line.distance.metres() * std::cos(line.azimuth_at_start.radians()),
          line.distance.metres() * std::sin(line.azimuth_at_start.radians()),
          before.altitude_msl_m - reported.altitude_msl_m,
          before.velocity_north_mps - reported.velocity_north_mps,
          before.velocity_east_mps - reported.velocity_east_mps,
          before.velocity_down_mps - reported.velocity_down_mps,
          turn_deg(reported.heading_deg, before.heading_deg),
          before.pitch_deg - reported.pitch_deg,
          turn_deg(reported.roll_deg, before.roll_deg)};
}

bool ExternalFlight::is_jump(const Difference& difference) {
  return glm::length(geo::Vector3(difference.north_m, difference.east_m, difference.up_m)) > kJumpDistance.metres();
}

void ExternalFlight::measure_rates(const ExternalSample& sample, geo::Duration received) {
  const auto begin = [&] { earlier_ = Report{sample, received}; };
  if (!earlier_) return begin();
  const geo::Duration since = received - earlier_->received;
  if (since < kMinRateInterval) return;
  measured_rates_.reset();
  measured_acceleration_.reset();
  if (since <= kMaxRateInterval) {
    const databuffer::Ownship& then = earlier_->sample.ownship;
    const databuffer::Ownship& now = sample.ownship;
    const double per_s = 1.0 / since.seconds();
    const auto limited = [per_s](double change, double limit) { return std::clamp(change * per_s, -limit, limit); };
    measured_rates_ = AttitudeRates{limited(turn_deg(then.heading_deg, now.heading_deg), kMaxAttitudeRate_dps),
                                    limited(now.pitch_deg - then.pitch_deg, kMaxAttitudeRate_dps),
                                    limited(turn_deg(then.roll_deg, now.roll_deg), kMaxAttitudeRate_dps)};
    measured_acceleration_ =
        geo::Vector3{limited(now.velocity_north_mps - then.velocity_north_mps, kMaxAcceleration_mps2),
                     limited(now.velocity_east_mps - then.velocity_east_mps, kMaxAcceleration_mps2),
                     limited(now.velocity_down_mps - then.velocity_down_mps, kMaxAcceleration_mps2)};
  }
  begin();
}

bool ExternalFlight::is_stationary(const ExternalSample& sample, geo::Duration received) {
  if (!unmoved_since_ || !same_position(unmoved_since_->sample.ownship, sample.ownship))
    unmoved_since_ = Report{sample, received};
  return speed_of(sample.ownship) * (received - unmoved_since_->received).seconds() > kStationaryProof_m;
}

void ExternalFlight::receive(const ExternalSample& sample, geo::Duration received) {
  const std::optional<databuffer::Ownship> before = estimate(received);
  measure_rates(sample, received);
  Report report{sample, received};
  if (!report.sample.rates) report.sample.rates = measured_rates_;
  if (!report.sample.acceleration_mps2) report.sample.acceleration_mps2 = measured_acceleration_;
  if (is_stationary(sample, received)) halt(report.sample);
  residual_ = before ? difference(*before, report.sample.ownship) : Difference{};
  if (is_jump(residual_)) {
    ++jumps_;
    residual_ = {};
    earlier_.reset();
  }
  for (double* angle : {&residual_.heading_deg, &residual_.pitch_deg, &residual_.roll_deg})
    if (std::abs(*angle) > kMaxBlendedAngle_deg) *angle = 0.0;
  last_ = report;
}

std::optional<databuffer::Ownship> ExternalFlight::estimate(geo::Duration moment) const {
  if (!last_ || moment - last_->received > extrapolation_limit_) return std::nullopt;
  const geo::Duration after = std::max(moment - last_->received, -kMaxBackward);
  const double decay = std::exp(-std::max(after.seconds(), 0.0) / kBlendTime.seconds());
  databuffer::Ownship state = dead_reckoned(last_->sample, after);
  const double away_m = std::hypot(residual_.north_m, residual_.east_m) * decay;
  if (away_m > 0.0) {
    const auto azimuth = geo::Bearing::radians(std::atan2(residual_.east_m, residual_.north_m));
    const auto point =
        geo::geodesic_direct({state.latitude_deg, state.longitude_deg}, azimuth, geo::Length::metres(away_m));
    state.latitude_deg = point.latitude_deg;
    state.longitude_deg = point.longitude_deg;
  }
  state.altitude_msl_m += decay * residual_.up_m;
  state.velocity_north_mps += decay * residual_.north_mps;
  state.velocity_east_mps += decay * residual_.east_mps;
  state.velocity_down_mps += decay * residual_.down_mps;
  state.heading_deg = geo::Bearing::degrees(state.heading_deg + decay * residual_.heading_deg).degrees();
  state.pitch_deg = std::clamp(state.pitch_deg + decay * residual_.pitch_deg, -90.0, 90.0);
  state.roll_deg = geo::wrapped_degrees(state.roll_deg + decay * residual_.roll_deg);
  return state;
}

std::optional<flightmodel::FlightSample> ExternalFlight::at(geo::Duration moment) const {
  const std::optional<databuffer::Ownship> state = estimate(moment);
  // An extrapolation outside the range of the record gives no output.
  if (!state || databuffer::validate(*state)) return std::nullopt;
  return as_flight(*state);
}

}  // namespace yars::flightmodel::bridges

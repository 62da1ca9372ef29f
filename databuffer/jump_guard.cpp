#include "databuffer/jump_guard.hpp"

#include <algorithm>
#include <cmath>

#include "lib/geo/geodesic.hpp"

namespace yars::databuffer {

namespace {

double speed_mps(const Ownship& ownship) {
  return std::hypot(ownship.velocity_north_mps, ownship.velocity_east_mps, ownship.velocity_down_mps);
}

}  // namespace

bool JumpGuard::is_jump(const Ownship& next, std::int64_t received_ns) const {
  constexpr double kSpeedMargin = 2.0;  // a source that runs at another rate, or was heard late
  const double time_s = 1e-9 * static_cast<double>(std::max<std::int64_t>(received_ns - last_received_ns_, 0));
  const double reach_m = kPlaceTolerance_m + kSpeedMargin * std::max(speed_mps(*last_), speed_mps(next)) * time_s;
  if (std::abs(next.altitude_msl_m - last_->altitude_msl_m) > reach_m) return true;
  // Cheap first: nearly every tick ends here. No degree is longer than 111.7 km.
  constexpr double kLongestDegree_m = 111'700.0;
  const double east_deg = std::remainder(next.longitude_deg - last_->longitude_deg, 360.0);
  const double north_deg = next.latitude_deg - last_->latitude_deg;
  if (kLongestDegree_m * std::hypot(north_deg, east_deg) <= reach_m) return false;
  return geo::geodesic_inverse({last_->latitude_deg, last_->longitude_deg}, {next.latitude_deg, next.longitude_deg})
             .distance.metres() > reach_m;
}

void JumpGuard::take(const Ownship& next, std::int64_t received_ns) {
  last_ = next;
  last_received_ns_ = received_ns;
  held_since_ns_.reset();
  proven_ = false;
}

bool JumpGuard::believes(const Ownship& next, std::int64_t received_ns, std::int64_t now_ns, std::uint32_t epoch) {
  const bool jump = last_ && is_jump(next, received_ns);
  const bool first_of_epoch = last_ && next.epoch == epoch && last_->epoch != epoch;
  const bool told = first_of_epoch || (held_since_ns_ && held_epoch_ != epoch);
  if (!jump || told) {
    if (held_since_ns_ && !told) ++passed_;
    take(next, received_ns);
    return true;
  }
  // A clock that went back begins the wait anew.
  if (!held_since_ns_ || now_ns < *held_since_ns_) held_since_ns_ = now_ns;
  held_epoch_ = epoch;
  proven_ = now_ns - *held_since_ns_ >= kJumpProof;
  if (now_ns - *held_since_ns_ < kLongestHold) return false;
  take(next, received_ns);
  return true;
}

}  // namespace yars::databuffer

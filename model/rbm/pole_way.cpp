#include "model/rbm/pole_way.hpp"

#include <algorithm>
#include <cmath>

namespace yars::model::rbm {

namespace {
constexpr double kPolarMetresPerDegree = 111'694.0;  // WGS84, of a meridian at the pole
constexpr double kMostTurn_rad = 0.5 * geo::kRadiansPerDegree;
constexpr double kShareOfWay = 0.25;  // of the way to the pole, so that what a piece begins with holds to its end
}  // namespace

PoleWay::PoleWay(geo::GeoPoint apex, geo::Bearing azimuth, double bend_m, double shortest_m)
    : bend_m_(bend_m), shortest_m_(shortest_m) {
  const double to_pole_m = (90.0 - std::abs(apex.latitude_deg)) * kPolarMetresPerDegree;
  const double towards = apex.latitude_deg >= 0.0 ? 1.0 : -1.0;
  nearest_m_ = to_pole_m * std::cos(azimuth.radians()) * towards;
  offset_m_ = std::abs(to_pole_m * std::sin(azimuth.radians()));
}

// A circle about the pole bends by L^2 / 8 r, and the longitude along a line by as much at the most.
double PoleWay::straight_at(double to_pole_m) const {
  const double by_bend_m = std::sqrt(8.0 * bend_m_ * to_pole_m);
  const double by_turn_m = kMostTurn_rad * to_pole_m * to_pole_m / std::max(offset_m_, 1.0);
  return std::max(shortest_m_, std::min({by_bend_m, by_turn_m, kShareOfWay * to_pole_m}));
}

double PoleWay::straight_m(double along_m) const {
  return straight_at(std::hypot(along_m - nearest_m_, offset_m_));
}

double PoleWay::least_straight_m(double from_m, double to_m) const {
  return straight_m(std::clamp(nearest_m_, from_m, to_m));
}

}  // namespace yars::model::rbm

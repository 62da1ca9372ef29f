#include "lib/geo/geodesic.hpp"

#include <GeographicLib/Constants.hpp>
#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/GeodesicLine.hpp>
#include <cmath>
#include <new>
#include <type_traits>

namespace yars::geo {

namespace {
const GeographicLib::Geodesic& wgs84() {
  return GeographicLib::Geodesic::WGS84();
}
}  // namespace

GeodesicInverse geodesic_inverse(GeoPoint from, GeoPoint to) {
  double distance_m = 0.0;
  double azimuth_start_deg = 0.0;
  double azimuth_end_deg = 0.0;
  wgs84().Inverse(from.latitude_deg, from.longitude_deg, to.latitude_deg, to.longitude_deg, distance_m,
                  azimuth_start_deg, azimuth_end_deg);
  return {Length::metres(distance_m), Bearing::degrees(azimuth_start_deg), Bearing::degrees(azimuth_end_deg)};
}

GeoPoint geodesic_direct(GeoPoint from, Bearing azimuth, Length distance) {
  GeoPoint to;
  wgs84().Direct(from.latitude_deg, from.longitude_deg, azimuth.degrees(), distance.metres(), to.latitude_deg,
                 to.longitude_deg);
  return to;
}

struct GeodesicRay::Line {
  GeographicLib::GeodesicLine line;
};

GeodesicRay::GeodesicRay(GeoPoint start, Bearing azimuth) {
  static_assert(sizeof(Line) <= sizeof(storage_) && alignof(Line) <= alignof(std::max_align_t));
  // Copied byte by byte and never destroyed: that is sound only for plain numbers.
  static_assert(std::is_trivially_copyable_v<Line> && std::is_trivially_destructible_v<Line>);
  ::new (storage_.data())
      Line{wgs84().Line(start.latitude_deg, start.longitude_deg, azimuth.degrees(),
                        GeographicLib::Geodesic::LATITUDE | GeographicLib::Geodesic::LONGITUDE |
                            GeographicLib::Geodesic::AZIMUTH | GeographicLib::Geodesic::DISTANCE_IN)};
}

const GeodesicRay::Line& GeodesicRay::line() const {
  return *std::launder(reinterpret_cast<const Line*>(storage_.data()));
}

GeoPoint GeodesicRay::position(Length distance) const {
  GeoPoint point;
  line().line.Position(distance.metres(), point.latitude_deg, point.longitude_deg);
  return point;
}

GeodesicRay::Place GeodesicRay::place(Length distance) const {
  GeoPoint point;
  double azimuth_deg = 0.0;
  line().line.Position(distance.metres(), point.latitude_deg, point.longitude_deg, azimuth_deg);
  return {point, Bearing::degrees(azimuth_deg)};
}

Length radius_of_curvature(double latitude_deg, Bearing azimuth) {
  const double a_m = GeographicLib::Constants::WGS84_a();
  const double f = GeographicLib::Constants::WGS84_f();
  const double e2 = f * (2.0 - f);
  const double sin_lat = std::sin(latitude_deg * kRadiansPerDegree);
  const double w2 = 1.0 - e2 * sin_lat * sin_lat;
  const double meridian_m = a_m * (1.0 - e2) / (w2 * std::sqrt(w2));
  const double prime_vertical_m = a_m / std::sqrt(w2);
  const double cos_az = std::cos(azimuth.radians());
  const double sin_az = std::sin(azimuth.radians());
  return Length::metres(1.0 / (cos_az * cos_az / meridian_m + sin_az * sin_az / prime_vertical_m));
}

}  // namespace yars::geo

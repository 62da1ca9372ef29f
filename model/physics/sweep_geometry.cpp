#include "model/physics/sweep_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/geo/geodesy.hpp"
#include "model/physics/receiver.hpp"

namespace yars::model::physics {

namespace {
// [beamwidths] Point targets farther from the beam's centre are left out. At this angle the two-way gain is -96 dB.
constexpr double kMaxBeamwidthsOff = 2.0;
}  // namespace

AzimuthInterval point_interval(const std::optional<AzimuthInterval>& sharpened_cell, double beamwidth_rad) {
  const double max_offset_rad = kMaxBeamwidthsOff * beamwidth_rad;
  return sharpened_cell.value_or(AzimuthInterval{-max_offset_rad, max_offset_rad});
}

double point_azimuth_gain(const std::optional<AzimuthInterval>& sharpened_cell, double beamwidth_rad, double offset_rad,
                          double width_rad) {
  const AzimuthInterval interval = point_interval(sharpened_cell, beamwidth_rad);
  // A point on a cell's left edge belongs to that cell.
  const bool inside = offset_rad >= interval.left_rad && offset_rad < interval.right_rad;
  if (!sharpened_cell) return inside ? azimuth_gain(beamwidth_rad, offset_rad) : 0.0;
  const double cell_rad = interval.right_rad - interval.left_rad;
  const double within_rad = std::min(interval.right_rad, offset_rad + 0.5 * width_rad) -
                            std::max(interval.left_rad, offset_rad - 0.5 * width_rad);
  const double part = width_rad > 0.0 ? std::clamp(within_rad / width_rad, 0.0, 1.0) : inside ? 1.0 : 0.0;
  return part * azimuth_cell_rad(beamwidth_rad) / cell_rad;
}

Displacement displacement(const SweepGeometry& from, const SweepGeometry& to) {
  constexpr double kMetresPerDegree = geo::kMeanEarthRadius_m * geo::kRadiansPerDegree;
  return {kMetresPerDegree * (to.apex.latitude_deg - from.apex.latitude_deg),
          kMetresPerDegree * geo::wrapped_degrees(to.apex.longitude_deg - from.apex.longitude_deg) *
              std::cos(to.apex.latitude_deg * geo::kRadiansPerDegree),
          to.altitude.metres() - from.altitude.metres()};
}

namespace {
// Lower limit of the earth radius factor k. On a much smaller sphere the selected range would span a large angle.
constexpr double kMinFactor = 0.1;
}  // namespace

double EffectiveEarth::drop_m(double distance_m) const {
  if (std::isinf(radius_m_)) return 0.0;
  // R (1 - cos a) as 2 R sin^2(a / 2), which has no cancellation for a small angle a.
  const double half_sine = std::sin(0.5 * distance_m / radius_m_);
  return 2.0 * radius_m_ * half_sine * half_sine;
}

Sight EffectiveEarth::sight(double altitude_m, double distance_m, double height_m) const {
  const bool flat = std::isinf(radius_m_);
  const double angle_rad = flat ? 0.0 : distance_m / radius_m_;
  const double sine = std::sin(angle_rad);
  const double cosine = std::cos(angle_rad);
  const double chord_m = flat ? distance_m : radius_m_ * sine;
  const double drop = drop_m(distance_m);
  // Position of the point in the vertical plane of the ray, relative to the aircraft.
  const double out_m = chord_m + height_m * sine;
  const double up_m = height_m * cosine - drop - altitude_m;
  Sight sight{};
  const double square_m2 = out_m * out_m + up_m * up_m;
  const double bent_up_m = up_m + lift_in_elevation_m(square_m2, distance_m, height_m);
  sight.tangent = bent_up_m / out_m;
  sight.elevation_rad = std::atan2(bent_up_m, out_m);
  sight.slant_range_m = std::sqrt(square_m2);
  // Direction from the point to the aircraft, relative to the horizontal at the point.
  sight.sin_grazing =
      (altitude_m * cosine - drop - height_m + grazing_lift_m(distance_m, height_m)) / sight.slant_range_m;
  sight.cos_grazing = (chord_m + altitude_m * sine) / sight.slant_range_m;
  return sight;
}

double EffectiveEarth::tangent(double altitude_m, double distance_m, double height_m) const {
  const bool flat = std::isinf(radius_m_);
  const double angle_rad = flat ? 0.0 : distance_m / radius_m_;
  const double sine = std::sin(angle_rad);
  const double chord_m = flat ? distance_m : radius_m_ * sine;
  const double out_m = chord_m + height_m * sine;
  const double up_m = height_m * std::cos(angle_rad) - drop_m(distance_m) - altitude_m;
  return (up_m + lift_in_elevation_m(out_m * out_m + up_m * up_m, distance_m, height_m)) / out_m;
}

EffectiveEarth EffectiveEarth::above(double level_m) const {
  EffectiveEarth earth = *this;
  earth.level_m_ = level_m_ + level_m;
  return earth;
}

// `square_m2`: squared slant range.
double EffectiveEarth::lift_in_elevation_m(double square_m2, double distance_m, double height_m) const {
  if (traced_ == nullptr) return lift_.of_elevation.at_m(square_m2, height_m + level_m_);
  return square_m2 * quotients(distance_m, height_m).of_elevation;
}

double EffectiveEarth::elevation_lift_m(double altitude_m, double distance_m, double height_m) const {
  const double angle_rad = distance_m * curvature();
  const double out_m =
      (angle_rad > 0.0 ? radius_m_ * std::sin(angle_rad) : distance_m) + height_m * std::sin(angle_rad);
  const double up_m = height_m * std::cos(angle_rad) - drop_m(distance_m) - altitude_m;
  return lift_in_elevation_m(out_m * out_m + up_m * up_m, distance_m, height_m);
}

double EffectiveEarth::grazing_lift_m(double distance_m, double height_m) const {
  const double square_m2 = distance_m * distance_m;
  if (traced_ == nullptr) return lift_.of_grazing_m(square_m2, height_m + level_m_);
  return square_m2 * quotients(distance_m, height_m).of_grazing;
}

// A ray's height depends on the square of the distance over the earth's radius.
TracedLifts::Quotients EffectiveEarth::quotients(double distance_m, double height_m) const {
  return traced_->at(distance_m * distance_m * geo::kMeanEarthRadius_m / radius_m_, height_m + level_m_);
}

double EffectiveEarth::sag_m(double altitude_m, double distance_m, double height_m) const {
  return 0.5 * distance_m * distance_m * curvature() -
         0.5 * (elevation_lift_m(altitude_m, distance_m, height_m) + grazing_lift_m(distance_m, height_m));
}

double EffectiveEarth::slant_range_m(double altitude_m, double distance_m, double height_m) const {
  // Law of cosines in the triangle aircraft, centre of the earth, point.
  const double half = std::isinf(radius_m_) ? 0.5 * distance_m : radius_m_ * std::sin(0.5 * distance_m / radius_m_);
  const double stretch = (1.0 + altitude_m / radius_m_) * (1.0 + height_m / radius_m_);
  return std::sqrt((altitude_m - height_m) * (altitude_m - height_m) + 4.0 * stretch * half * half);
}

double EffectiveEarth::distance_at_slant_range(double altitude_m, double height_m, double slant_range_m) const {
  const double above_m = altitude_m - height_m;
  const double square = slant_range_m * slant_range_m - above_m * above_m;
  if (!(square > 0.0)) return std::numeric_limits<double>::quiet_NaN();
  if (std::isinf(radius_m_)) return std::sqrt(square);
  // Law of cosines in the triangle aircraft, centre of the earth, point, solved for the half angle.
  const double half_sine = std::sqrt(square / (4.0 * (radius_m_ + altitude_m) * (radius_m_ + height_m)));
  return half_sine > 1.0 ? std::numeric_limits<double>::quiet_NaN() : 2.0 * radius_m_ * std::asin(half_sine);
}

void GeometryParameters::use_air(double refractivity, double refractivity_per_km) {
  if (std::isnan(earth_radius_factor) && earth != radar::EarthModel::flat)
    refraction = Refraction::of({refractivity, refractivity_per_km / 1000.0});
}

EffectiveEarth effective_earth(const GeometryParameters& parameters, geo::GeoPoint apex, geo::AltitudeMsl altitude,
                               geo::Bearing azimuth) {
  if (parameters.earth == radar::EarthModel::flat) return EffectiveEarth(std::numeric_limits<double>::infinity());
  const double radius_m = parameters.earth == radar::EarthModel::sphere
                              ? geo::kMeanEarthRadius_m
                              : geo::radius_of_curvature(apex.latitude_deg, azimuth).metres();
  if (parameters.refraction == nullptr)
    return EffectiveEarth(std::max(parameters.earth_radius_factor, kMinFactor) * radius_m);
  const LiftSeries lift = parameters.refraction->series(altitude.metres(), radius_m);
  return {radius_m, lift, parameters.exact ? parameters.refraction->traced(altitude.metres()) : nullptr};
}

double knife_edge_loss_db(double v) {
  if (v <= -0.78) return 0.0;
  const double x = v - 0.1;
  return 6.9 + 20.0 * std::log10(std::sqrt(x * x + 1.0) + x);
}

double diffraction_parameter(double above_m, double edge_m, double end_m, double wavelength_m) {
  return above_m * std::sqrt(2.0 * end_m / (wavelength_m * edge_m * (end_m - edge_m)));
}

double arc_per_plane(double plane_square_m2, double radius_of_curvature_m) {
  const double u = plane_square_m2 / (radius_of_curvature_m * radius_of_curvature_m);
  return 1.0 + u * (1.0 / 6.0 + u * (3.0 / 40.0 + u * (15.0 / 336.0 + u * (105.0 / 3456.0))));
}

void sample_distances(geo::Length range, std::span<double> distance_m) {
  const double spacing_m = range.metres() / static_cast<double>(distance_m.size());
  for (std::size_t i = 0; i < distance_m.size(); ++i) distance_m[i] = (static_cast<double>(i) + 0.5) * spacing_m;
}

}  // namespace yars::model::physics

#include "model/terrain/landscape_broad.hpp"

#include <algorithm>
#include <cmath>

#include "lib/geo/frames.hpp"
#include "model/terrain/noise.hpp"

namespace yars::model::terrain {

namespace {

constexpr double kEarthRadiusKm = 6371.0;  // [km] sphere: shape only, no navigation
constexpr double kShelfMPerKm = 14.0;      // [m/km] the sea deepens so much with the way out
constexpr double kOpenSeaKm = -130.0;      // [km] inland: so far out no coast, island or range reaches
// [m] No sea is deeper: a bottom that falls off has gullies, whose spurs would rise above the water at a box's edge.
constexpr double kSeaBottomM = -150.0;

double bell(double offset, double half_width) {
  const double t = offset / half_width;
  return std::exp(-t * t);
}

geo::Vector3 at_wavelength(geo::Vector3 point_km, double wavelength_km) {
  return {point_km.x / wavelength_km, point_km.y / wavelength_km, point_km.z / wavelength_km};
}

// A chain of mountains along a line of equal way inland.
struct Range {
  double axis_km;  // way inland of its middle; negative: at sea, its tops are islands
  double half_width_km;
  double crest_m;
  std::uint32_t layer;  // of the noise
};
constexpr Range kRanges[] = {{20, 12, 1250, 70}, {96, 27, 3000, 90}, {210, 40, 2300, 110}, {-30, 9, 680, 130}};

}  // namespace

double BroadRelief::noise(geo::Vector3 point_km, double wavelength_km, std::uint32_t layer, int octaves) const {
  return fractal_noise(at_wavelength(point_km, wavelength_km), seed_ + layer, octaves, 0.5);
}

double BroadRelief::ridges(geo::Vector3 point_km, double wavelength_km, std::uint32_t layer, int octaves) const {
  return ridged_noise(at_wavelength(point_km, wavelength_km), seed_ + layer, octaves);
}

// The coast that ends a box keeps 11 to 81 km from its edge, in bays and capes of its own;
// at the edge the sea has its full depth.
BroadRelief::Shore BroadRelief::beside_edge(double coast_km, geo::GeoPoint place, geo::Vector3 bent) const {
  constexpr double kReachKm = 125.0;  // [km] farther inside the edge is not felt
  const double inside_km = island_ ? island_->inside_km(place) : kReachKm;
  if (inside_km >= kReachKm) return {coast_km, 1.0};
  const double margin_km = 11.0 + 70.0 * std::clamp(0.42 + 1.15 * noise(bent, 115, 170, 6), 0.0, 1.0);
  const double shore_km = inside_km - margin_km;
  return {std::min(coast_km, shore_km), smooth_step(0.0, 22.0, shore_km)};
}

double BroadRelief::height_m(geo::GeoPoint place) const {
  if (island_ && island_->inside_km(place) <= 0.0) return kSeaBottomM;
  const double latitude = place.latitude_deg * geo::kRadiansPerDegree;
  const double longitude = place.longitude_deg * geo::kRadiansPerDegree;
  const geo::Vector3 at{kEarthRadiusKm * std::cos(latitude) * std::cos(longitude),
                        kEarthRadiusKm * std::cos(latitude) * std::sin(longitude), kEarthRadiusKm * std::sin(latitude)};
  // Bend space a little: what is straight in noise becomes winding.
  const geo::Vector3 bent{at.x + 9.0 * noise(at, 55, 10, 3), at.y + 9.0 * noise(at, 55, 20, 3),
                          at.z + 9.0 * noise(at, 55, 30, 3)};
  // Way inland from the coast's general line, negative at sea.
  const double inland_km = 260.0 * (noise(bent, 1100, 40) + 0.45 * noise(bent, 430, 41) + 0.16 * noise(bent, 170, 42));
  if (inland_km < kOpenSeaKm) return kSeaBottomM;
  // The coast itself wanders about that line, here in beaches, there in capes; inlets reach in.
  const double rugged = smooth_step(-0.3, 0.4, noise(at, 130, 43));
  const double inlets = smooth_step(0.42, 0.8, ridges(bent, 85, 44, 3));
  const Shore shore = beside_edge(
      inland_km + (9.0 + 26.0 * rugged) * noise(bent, 62, 50, 6) - 22.0 * inlets * bell(inland_km, 28.0), place, bent);
  const double coast_km = shore.coast_km;
  // Shelf, coastal plain and the slow rise behind it.
  double height_m = coast_km < 0 ? kShelfMPerKm * coast_km
                                 : 95.0 * (1.0 - std::exp(-coast_km / 14.0)) + 1.6 * std::min(coast_km, 90.0);
  if (shore.fade <= 0.0) return std::max(height_m, kSeaBottomM);
  // Ranges follow the general line at their own distance and with their own gaps.
  const double wander_km = 26.0 * noise(at, 120, 60, 3);
  for (const Range& range : kRanges) {
    const double envelope = bell(inland_km - range.axis_km - wander_km, range.half_width_km);
    if (envelope < 1e-3) continue;
    const double presence = 0.45 + 0.75 * smooth_step(-0.45, 0.35, noise(at, 95, range.layer, 2));
    height_m += range.crest_m * envelope * presence * shore.fade * (0.28 + 1.05 * ridges(bent, 34, range.layer + 5, 4));
  }
  // Low hills here and there.
  const double hilly = smooth_step(2.0, 25.0, coast_km) * smooth_step(-0.1, 0.5, noise(at, 60, 160, 2)) * shore.fade;
  if (hilly > 0.0) height_m += 190.0 * hilly * ridges(bent, 17, 150, 4);
  return std::max(height_m, kSeaBottomM);
}

}  // namespace yars::model::terrain

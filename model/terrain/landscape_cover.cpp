#include "model/terrain/landscape_cover.hpp"

#include <algorithm>
#include <cmath>

#include "model/terrain/noise.hpp"
#include "model/terrain/street_grid.hpp"

namespace yars::model::terrain {

namespace {

constexpr double kWoodsBelowSnowM = 900.0;  // [m] between the last trees and the snow lies rock and meadow
constexpr double kSteepRock = 0.55;         // [m/m] soil does not hold
constexpr double kBuildable = 0.15;         // [m/m] houses stand on gentler ground

double noise_at(const CoverSite& site, double wavelength_m, int octaves, std::uint32_t seed) {
  const double scale = 6371000.0 / wavelength_m;
  return fractal_noise({site.upward.x * scale, site.upward.y * scale, site.upward.z * scale}, seed, octaves, 0.6);
}

}  // namespace

double snow_line_m(double latitude_deg) {
  const double parallel = std::max(0.0, std::cos(latitude_deg * geo::kRadiansPerDegree));
  return 4100.0 * parallel * std::sqrt(parallel) - 500.0 * smooth_step(64.0, 78.0, std::abs(latitude_deg));
}

Material natural_cover(const CoverSite& site, std::uint32_t seed) {
  if (site.height_m <= 0.0 || site.valley < 0.0) return Material::water;
  const double snow_m = snow_line_m(site.place.latitude_deg);
  const double ground = noise_at(site, 6500.0, 5, seed);
  if (site.height_m > snow_m + 250.0 * ground && site.steepness < 1.1) return Material::snow;
  if (site.height_m < 12.0 && site.valley > 0.5) {
    if (site.steepness > 0.09) return Material::rock;
    if (site.height_m < 2.2) return ground < 0.3 ? Material::sand : Material::marsh;
  }
  if (site.height_m < 9.0 && site.steepness < 0.012 && ground > 0.25) return Material::marsh;
  if (site.steepness > kSteepRock) return Material::rock;
  const double above_m = site.height_m - (snow_m - kWoodsBelowSnowM);
  if (above_m > 200.0 * ground)
    return above_m > 450.0 * (1.0 + ground) - 400.0 * site.steepness ? Material::rock : Material::soil;
  // Fields on the plain and the valley floors, woods on hills and slopes.
  const double hilly = smooth_step(0.03, 0.16, site.steepness) + 0.5 * smooth_step(150.0, 700.0, site.height_m);
  const double wooded = ground + 0.45 * hilly - 0.15 + (site.valley < 0.4 ? -0.12 : 0.0);
  return wooded > 0.12 ? Material::trees : Material::soil;
}

Material town_cover(const CoverSite& site, double radii, Material natural, std::uint32_t seed) {
  if (natural == Material::water || site.steepness > kBuildable) return natural;
  // The edge is ragged: arms along the roads, fields between.
  const double edge = radii * (1.0 + 0.55 * noise_at(site, 1700.0, 3, seed + 7U));
  if (edge > 1.0) return natural;
  const StreetPatch patch = street_patch(site.place);
  double way_deg = geo::wrapped_degrees(site.place.longitude_deg - patch.origin.longitude_deg);
  const double east_m = way_deg * east_m_per_degree(patch.origin.latitude_deg);
  const double north_m = (site.place.latitude_deg - patch.origin.latitude_deg) * kTileMetres;
  const double turn = patch.bearing_deg * geo::kRadiansPerDegree;
  const double along_m = east_m * std::sin(turn) + north_m * std::cos(turn);
  const double across_m = east_m * std::cos(turn) - north_m * std::sin(turn);
  // Avenues cut the town into quarters, quarters into blocks.
  constexpr double kAvenueM = 880.0, kAvenueWidthM = 44.0, kBlockM = 220.0;
  const auto in_avenue = [](double way_m) { return way_m - kAvenueM * std::floor(way_m / kAvenueM) < kAvenueWidthM; };
  if (in_avenue(along_m) || in_avenue(across_m)) return Material::asphalt;
  const auto number = [](double way_m, double step_m) { return static_cast<std::int32_t>(std::floor(way_m / step_m)); };
  const double quarter = share_of(lattice_hash(number(along_m, kAvenueM), number(across_m, kAvenueM), 11, seed));
  const double block = share_of(lattice_hash(number(along_m, kBlockM), number(across_m, kBlockM), 12, seed));
  if (edge > 0.35 && quarter < 0.13)
    return block < 0.12 ? Material::metal : (block < 0.7 ? Material::part_metal : Material::asphalt);
  if (quarter > 0.95 || block > 0.94) return Material::trees;
  if (edge < 0.3 || (edge < 0.45 && block < 0.5)) return Material::stone;
  if (edge > 0.8 && block < 0.3) return natural;
  return Material::composition;
}

Material airfield_cover(const Airfield& airfield, geo::GeoPoint place, Material natural) {
  const OnAirfield at = on_airfield(airfield, place);
  const double along_m = std::abs(at.along_m);
  const double half_m = 0.5 * airfield.length_m;
  if (along_m > half_m + kPadBeyondM || std::abs(at.across_m) > kPadHalfWidthM) return natural;
  if (along_m <= half_m && std::abs(at.across_m) <= kRunwayHalfWidthM) return Material::asphalt;
  // A taxiway beside the runway, links at its ends, the apron with hangars behind it.
  const bool taxiway = along_m <= half_m && std::abs(at.across_m - 250.0) <= 45.0;
  const bool link = std::abs(along_m - half_m + 60.0) <= 60.0 && at.across_m > 0.0 && at.across_m < 250.0;
  if (taxiway || link) return Material::asphalt;
  if (along_m <= 350.0 && at.across_m > 250.0 && at.across_m < 420.0) return Material::asphalt;
  if (along_m <= 300.0 && at.across_m >= 420.0) return Material::metal;
  return Material::soil;
}

}  // namespace yars::model::terrain

#include "model/terrain/landscape_rows.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "model/terrain/landscape_cover.hpp"
#include "model/terrain/noise.hpp"

namespace yars::model::terrain {

namespace {

constexpr double kDeepSeaM = -100.0;  // [m] ground below does not reach the surface by any gully's spur
constexpr GullyOctave kGullies[] = {{2000, 0.17}, {980, 0.12}, {500, 0.08}, {240, 0.06}, {115, 0.05}};
constexpr double kRoughM = 2.5;  // [m] of stones and ledges on steep ground
constexpr double kRoughWavelengthM = 75.0;
constexpr double kTownReach = 2.2;  // radii: a town's ragged edge ends within
constexpr double kHighestM = 9000.0;

// Sea is exactly 0 m and land at least 1 m: zero means water to the radar.
std::int16_t post_of(double height_m, bool water) {
  if (height_m <= 0.0) return 0;
  return static_cast<std::int16_t>(std::clamp(std::round(height_m), water ? 0.0 : 1.0, kHighestM));
}

double way_deg(double from_deg, double to_deg) {
  const double way = to_deg - from_deg;
  return way > 180.0 ? way - 360.0 : (way < -180.0 ? way + 360.0 : way);
}

}  // namespace

struct LandscapeRows::Row {
  double latitude_deg;
  double cosine, sine;  // of the latitude
  std::vector<double> heights_m;
  std::vector<float> steepness;
  std::vector<float> valley;
  std::vector<const Town*> towns;  // that reach this row
};

LandscapeRows::LandscapeRows(LandscapeTiles& tiles, std::uint32_t seed, CellPlace place, int rows, int columns)
    : seed_(seed), rows_(rows), columns_(columns), place_(place), bands_(kTileNodes + 1) {
  std::vector<std::shared_ptr<const ReliefTile>> reliefs;
  lattice_ = std::make_unique<LandscapeLattice>(
      place, columns, [&](CellPlace at) -> const ReliefTile& { return *reliefs.emplace_back(tiles.relief(at)); });
  for (int column = 0; column < columns; ++column) {
    longitudes_deg_.push_back(lattice_->longitude_deg(column));
    cosines_.push_back(std::cos(longitudes_deg_.back() * geo::kRadiansPerDegree));
    sines_.push_back(std::sin(longitudes_deg_.back() * geo::kRadiansPerDegree));
  }
  for (int north = -1; north <= 1; ++north)
    for (int east = -1; east <= 1; ++east) {
      const CellPlace at = neighbour_of(place, north, east);
      if (at.south_deg < -90 || at.south_deg > 89) continue;
      const TileFeatures& tile = *features_.emplace_back(tiles.features(at));
      for (const RiverPiece& piece : tile.rivers) {
        const double from_m = (piece.from.latitude_deg - place.south_deg) * kTileMetres;
        const double low = (from_m + std::min(0.0, piece.north_m) - piece.reach_m()) / kNodeMetres - 1.0;
        const double high = (from_m + std::max(0.0, piece.north_m) + piece.reach_m()) / kNodeMetres + 1.0;
        for (int band = std::max(0, static_cast<int>(low)); band <= std::min<double>(kTileNodes, high); ++band)
          bands_[static_cast<std::size_t>(band)].push_back(&piece);
      }
      for (const Town& town : tile.places.towns) towns_.push_back(&town);
      for (const Airfield& airfield : tile.places.airfields) airfields_.push_back(&airfield);
    }
}

void LandscapeRows::lay_ground(Row& row, const LandscapeLattice::Row& lattice) const {
  GullyRow gullies({seed_ + 3072U, kGullies}, std::clamp(row.latitude_deg, -90.0, 90.0));
  constexpr double kRoughScale = 6371000.0 / kRoughWavelengthM;
  for (std::size_t column = 0; column < row.heights_m.size(); ++column) {
    const LandscapeLattice::Ground ground = lattice.at(static_cast<int>(column));
    row.heights_m[column] = ground.height_m;
    // Deep under the sea nothing shows: spare the gullies.
    if (ground.height_m < kDeepSeaM) continue;
    const GullyRow::Relief relief = gullies.at(longitudes_deg_[column], ground.slope);
    row.heights_m[column] += relief.height_m;
    const double steepness = std::sqrt(relief.slope.east * relief.slope.east + relief.slope.north * relief.slope.north);
    row.steepness[column] = static_cast<float>(steepness);
    if (steepness < 0.12 || row.heights_m[column] < 0.0) continue;
    const double across = row.cosine * kRoughScale;
    const geo::Vector3 at{across * cosines_[column], across * sines_[column], row.sine * kRoughScale};
    row.heights_m[column] += kRoughM * smooth_step(0.12, 0.6, steepness) * gradient_noise(at, seed_ + 3090U);
  }
}

void LandscapeRows::lay_rivers(Row& row) const {
  const double from_south = (row.latitude_deg - place_.south_deg) * kTileNodes;
  const auto band = static_cast<std::size_t>(std::clamp(from_south, 0.0, static_cast<double>(kTileNodes)));
  RiverRow rivers(row.latitude_deg, longitudes_deg_);
  for (const RiverPiece* piece : bands_[band]) rivers.add(*piece);
  rivers.shape(row.heights_m, row.valley);
}

// The level ground is the airfield's height to the bit; beyond it the land rises or falls to what it was.
void LandscapeRows::level_airfields(Row& row) const {
  constexpr double kAcrossM = kPadHalfWidthM + kPadBlendM;
  for (const Airfield* airfield : airfields_) {
    const double half_m = 0.5 * airfield->length_m + kPadBeyondM;
    const double north_m = std::abs(row.latitude_deg - airfield->centre.latitude_deg) * kTileMetres;
    if (north_m > half_m + kPadBlendM + kAcrossM) continue;
    for (std::size_t column = 0; column < row.heights_m.size(); ++column) {
      const OnAirfield at = on_airfield(*airfield, {row.latitude_deg, longitudes_deg_[column]});
      const double beyond_m =
          std::max({0.0, std::abs(at.along_m) - half_m, std::abs(at.across_m) - kPadHalfWidthM}) / kPadBlendM;
      if (beyond_m >= 1.0 || row.valley[column] < 0.0F) continue;
      const double part = smooth_step(0.0, 1.0, beyond_m);
      row.heights_m[column] = airfield->elevation_m + (row.heights_m[column] - airfield->elevation_m) * part;
      row.steepness[column] *= static_cast<float>(part);
    }
  }
}

Material LandscapeRows::cover(const Row& row, std::size_t column) const {
  CoverSite site{{row.latitude_deg, longitudes_deg_[column]},
                 {row.cosine * cosines_[column], row.cosine * sines_[column], row.sine},
                 row.heights_m[column],
                 row.steepness[column] * std::max(0.0, static_cast<double>(row.valley[column])),
                 row.valley[column]};
  Material material = natural_cover(site, seed_ + 3100U);
  double radii = kTownReach;
  for (const Town* town : row.towns) {
    const double north_m = (row.latitude_deg - town->centre.latitude_deg) * kTileMetres;
    const double east_m =
        way_deg(town->centre.longitude_deg, site.place.longitude_deg) * east_m_per_degree(town->centre.latitude_deg);
    radii = std::min(radii, std::sqrt(north_m * north_m + east_m * east_m) / town->radius_m);
  }
  if (radii < kTownReach) material = town_cover(site, radii, material, seed_ + 3110U);
  if (material == Material::water) return material;
  for (const Airfield* airfield : airfields_)
    if (std::abs(row.latitude_deg - airfield->centre.latitude_deg) * kTileMetres < kLargestTownM)
      material = airfield_cover(*airfield, site.place, material);
  return material;
}

void LandscapeRows::make(int number, std::span<std::int16_t> posts_m, std::span<std::uint8_t> codes) const {
  const LandscapeLattice::Row lattice(*lattice_, number, rows_ - 1);
  const auto columns = static_cast<std::size_t>(columns_);
  const double latitude = lattice.latitude_deg() * geo::kRadiansPerDegree;
  Row row{lattice.latitude_deg(),
          std::cos(latitude),
          std::sin(latitude),
          std::vector<double>(columns),
          std::vector<float>(columns),
          std::vector<float>(columns, 2.0F),
          {}};
  for (const Town* town : towns_)
    if (std::abs(town->centre.latitude_deg - row.latitude_deg) * kTileMetres < kTownReach * town->radius_m)
      row.towns.push_back(town);
  lay_ground(row, lattice);
  lay_rivers(row);
  level_airfields(row);
  for (std::size_t column = 0; column < columns; ++column) {
    posts_m[column] = post_of(row.heights_m[column], row.valley[column] < 0.0F);
    codes[column] = static_cast<std::uint8_t>(cover(row, column));
  }
}

}  // namespace yars::model::terrain

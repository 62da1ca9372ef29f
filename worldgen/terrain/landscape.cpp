#include "worldgen/terrain/landscape.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <thread>
#include <vector>

#include "lib/error/error.hpp"
#include "lib/geo/frames.hpp"
#include "lib/random/counter_rng.hpp"
#include "model/physics/reflectivity.hpp"

namespace yars::worldgen {

namespace {

constexpr double kWoodsBelowSnow_m = 900.0;      // vertical extent of rock and meadow between trees and snow
constexpr double kMaxAirfieldExtent_m = 7000.0;  // an airfield changes no ground farther from its centre
constexpr double kSteepRock = 0.55;              // [m/m] steeper ground without snow is bare rock
constexpr double kBuildable = 0.15;              // [m/m] steepest ground with buildings

double noise_at(const CoverSite& site, double wavelength_m, int octaves, std::uint32_t seed) {
  const double scale = 6371000.0 / wavelength_m;
  return random::fractal_noise({site.upward.x * scale, site.upward.y * scale, site.upward.z * scale}, seed, octaves,
                               0.6);
}

}  // namespace

double snow_line_m(double latitude_deg) {
  const double parallel = std::max(0.0, std::cos(latitude_deg * geo::kRadiansPerDegree));
  return 4100.0 * parallel * std::sqrt(parallel) - 500.0 * random::smooth_step(64.0, 78.0, std::abs(latitude_deg));
}

Material natural_cover(const CoverSite& site, std::uint32_t seed) {
  if (site.height_m <= 0.0 || site.valley < 0.0) return Material::water;
  const double snow_m = snow_line_m(site.position.latitude_deg);
  const double ground = noise_at(site, 6500.0, 5, seed);
  if (site.height_m > snow_m + 250.0 * ground && site.steepness < 1.1) return Material::snow;
  // Near the sea: rock on steep shores, sand or marsh on low ground.
  if (site.height_m < 12.0 && site.valley > 0.5) {
    if (site.steepness > 0.09) return Material::rock;
    if (site.height_m < 2.2) return ground < 0.3 ? Material::sand : Material::marsh;
  }
  if (site.height_m < 9.0 && site.steepness < 0.012 && ground > 0.25) return Material::marsh;
  if (site.steepness > kSteepRock) return Material::rock;
  // Above the tree line: meadow (soil), then rock.
  const double above_m = site.height_m - (snow_m - kWoodsBelowSnow_m);
  if (above_m > 200.0 * ground)
    return above_m > 450.0 * (1.0 + ground) - 400.0 * site.steepness ? Material::rock : Material::soil;
  // Fields on plains and valley floors, woods on hills and slopes.
  const double hilly =
      random::smooth_step(0.03, 0.16, site.steepness) + 0.5 * random::smooth_step(150.0, 700.0, site.height_m);
  const double wooded = ground + 0.45 * hilly - 0.15 + (site.valley < 0.4 ? -0.12 : 0.0);
  return wooded > 0.12 ? Material::trees : Material::soil;
}

Material town_cover(const CoverSite& site, double radii, Material natural, std::uint32_t seed) {
  if (natural == Material::water || site.steepness > kBuildable) return natural;
  // `edge`: distance from the centre / distance of the town's edge, which noise makes irregular.
  const double edge = radii * (1.0 + 0.55 * noise_at(site, 1700.0, 3, seed + 7U));
  if (edge > 1.0) return natural;
  const model::physics::StreetPatch patch = model::physics::street_patch(site.position);
  double east_deg = geo::wrapped_degrees(site.position.longitude_deg - patch.origin.longitude_deg);
  const double east_m = east_deg * east_m_per_degree(patch.origin.latitude_deg);
  const double north_m = (site.position.latitude_deg - patch.origin.latitude_deg) * kTileMetres;
  const double turn = patch.bearing_deg * geo::kRadiansPerDegree;
  const double along_m = east_m * std::sin(turn) + north_m * std::cos(turn);
  const double across_m = east_m * std::cos(turn) - north_m * std::sin(turn);
  // Avenues divide the town into square quarters of side 880 m. A quarter consists of square blocks of side 220 m.
  constexpr double kAvenue_m = 880.0, kAvenueWidth_m = 44.0, kBlock_m = 220.0;
  const auto in_avenue = [](double distance_m) {
    return distance_m - kAvenue_m * std::floor(distance_m / kAvenue_m) < kAvenueWidth_m;
  };
  if (in_avenue(along_m) || in_avenue(across_m)) return Material::asphalt;
  const auto number = [](double distance_m, double step_m) {
    return static_cast<std::int32_t>(std::floor(distance_m / step_m));
  };
  const double quarter =
      random::unit_fraction(random::lattice_hash(number(along_m, kAvenue_m), number(across_m, kAvenue_m), 11, seed));
  const double block =
      random::unit_fraction(random::lattice_hash(number(along_m, kBlock_m), number(across_m, kBlock_m), 12, seed));
  if (edge > 0.35 && quarter < 0.13)
    return block < 0.12 ? Material::metal : (block < 0.7 ? Material::part_metal : Material::asphalt);
  if (quarter > 0.95 || block > 0.94) return Material::trees;
  if (edge < 0.3 || (edge < 0.45 && block < 0.5)) return Material::stone;
  if (edge > 0.8 && block < 0.3) return natural;
  return Material::composition;
}

Material airfield_cover(const Airfield& airfield, geo::GeoPoint position, Material natural, bool paved) {
  const RunwayPosition at = runway_position(airfield, position);
  const double along_m = std::abs(at.along_m);
  const double half_m = 0.5 * airfield.length_m;
  if (along_m > half_m + kPadBeyond_m || std::abs(at.across_m) > kPadHalfWidth_m) return natural;
  if (!paved) return Material::soil;
  if (along_m <= half_m && std::abs(at.across_m) <= kRunwayHalfWidth_m) return Material::asphalt;
  // Taxiway beside the runway, links at its ends, then the apron, then hangars.
  const bool taxiway = along_m <= half_m && std::abs(at.across_m - 250.0) <= 45.0;
  const bool link = std::abs(along_m - half_m + 60.0) <= 60.0 && at.across_m > 0.0 && at.across_m < 250.0;
  if (taxiway || link) return Material::asphalt;
  if (along_m <= 350.0 && at.across_m > 250.0 && at.across_m < 420.0) return Material::asphalt;
  if (along_m <= 300.0 && at.across_m >= 420.0) return Material::metal;
  return Material::soil;
}

namespace {

constexpr double kAlwaysSea_m = -100.0;  // [m MSL] lower ground gets no gullies: they could not raise it above the sea
constexpr GullyOctave kGullies[] = {{2000, 0.17}, {980, 0.12}, {500, 0.08}, {240, 0.06}, {115, 0.05}};
constexpr double kRough_m = 2.5;             // amplitude of stones and ledges on steep ground
constexpr double kRoughWavelength_m = 75.0;  // wavelength of stones and ledges
constexpr double kTownExtent = 2.2;          // maximum distance of a town's edge from its centre / town's radius
constexpr double kHighest_m = 9000.0;

// Sea is exactly 0 m and land at least 1 m, because the radar model takes 0 m for water.
std::int16_t post_of(double height_m, bool water) {
  if (height_m <= 0.0) return 0;
  return static_cast<std::int16_t>(std::clamp(std::round(height_m), water ? 0.0 : 1.0, kHighest_m));
}

double longitude_difference_deg(double from_deg, double to_deg) {
  const double east_deg = to_deg - from_deg;
  return east_deg > 180.0 ? east_deg - 360.0 : (east_deg < -180.0 ? east_deg + 360.0 : east_deg);
}

}  // namespace

struct LandscapeRows::Row {
  double latitude_deg;
  double cosine, sine;  // cosine and sine of the latitude
  std::vector<double> heights_m;
  std::vector<float> steepness;    // [m/m]
  std::vector<float> valley;       // as CoverSite::valley
  std::vector<const Town*> towns;  // towns that may cover posts of this row
};

LandscapeRows::LandscapeRows(LandscapeTiles& tiles, std::uint32_t seed, CellCorner corner, int rows, int columns)
    : seed_(seed), rows_(rows), columns_(columns), corner_(corner), bands_(kTileNodes + 1) {
  std::vector<std::shared_ptr<const ReliefTile>> reliefs;
  lattice_ = std::make_unique<LandscapeLattice>(
      corner, columns, [&](CellCorner at) -> const ReliefTile& { return *reliefs.emplace_back(tiles.relief(at)); });
  for (int column = 0; column < columns; ++column) {
    longitudes_deg_.push_back(lattice_->longitude_deg(column));
    cosines_.push_back(std::cos(longitudes_deg_.back() * geo::kRadiansPerDegree));
    sines_.push_back(std::sin(longitudes_deg_.back() * geo::kRadiansPerDegree));
  }
  for (int north = -1; north <= 1; ++north)
    for (int east = -1; east <= 1; ++east) {
      const CellCorner at = neighbour_of(corner, north, east);
      if (at.south_deg < -90 || at.south_deg > 89) continue;
      const TileFeatures& tile = *features_.emplace_back(tiles.features(at));
      for (const RiverPiece& piece : tile.rivers) {
        const double from_m = (piece.from.latitude_deg - corner.south_deg) * kTileMetres;
        const double low = (from_m + std::min(0.0, piece.north_m) - piece.extent_m()) / kNodeMetres - 1.0;
        const double high = (from_m + std::max(0.0, piece.north_m) + piece.extent_m()) / kNodeMetres + 1.0;
        for (int band = std::max(0, static_cast<int>(low)); band <= std::min<double>(kTileNodes, high); ++band)
          bands_[static_cast<std::size_t>(band)].push_back(&piece);
      }
      for (const Town& town : tile.settlements.towns) towns_.push_back(&town);
      for (const Airfield& airfield : tile.settlements.airfields) airfields_.push_back(&airfield);
    }
}

void LandscapeRows::add_ground(Row& row, const LandscapeLattice::Row& lattice) const {
  GullyRow gullies({seed_ + 3072U, kGullies}, std::clamp(row.latitude_deg, -90.0, 90.0));
  constexpr double kRoughScale = 6371000.0 / kRoughWavelength_m;
  for (std::size_t column = 0; column < row.heights_m.size(); ++column) {
    const LandscapeLattice::Ground ground = lattice.at(static_cast<int>(column));
    row.heights_m[column] = ground.height_m;
    // Gullies in the deep sea are never visible.
    if (ground.height_m < kAlwaysSea_m) continue;
    const GullyRow::Relief relief = gullies.at(longitudes_deg_[column], ground.slope);
    row.heights_m[column] += relief.height_m;
    const double steepness = std::sqrt(relief.slope.east * relief.slope.east + relief.slope.north * relief.slope.north);
    row.steepness[column] = static_cast<float>(steepness);
    if (steepness < 0.12 || row.heights_m[column] < 0.0) continue;
    const double across = row.cosine * kRoughScale;
    const geo::Vector3 at{across * cosines_[column], across * sines_[column], row.sine * kRoughScale};
    row.heights_m[column] +=
        kRough_m * random::smooth_step(0.12, 0.6, steepness) * random::gradient_noise(at, seed_ + 3090U);
  }
}

void LandscapeRows::carve_rivers(Row& row) const {
  const double from_south = (row.latitude_deg - corner_.south_deg) * kTileNodes;
  const auto band = static_cast<std::size_t>(std::clamp(from_south, 0.0, static_cast<double>(kTileNodes)));
  RiverRow rivers(row.latitude_deg, longitudes_deg_);
  for (const RiverPiece* piece : bands_[band]) rivers.add(*piece);
  rivers.shape(row.heights_m, row.valley);
}

// Sets the level ground of an airfield to the airfield's height. Over the next kPadBlend_m outwards, the height changes
// smoothly to the height of the land. River water does not change.
void LandscapeRows::level_airfields(Row& row) const {
  constexpr double kAcross_m = kPadHalfWidth_m + kPadBlend_m;
  for (const Airfield* airfield : airfields_) {
    const double half_m = 0.5 * airfield->length_m + kPadBeyond_m;
    const double north_m = std::abs(row.latitude_deg - airfield->centre.latitude_deg) * kTileMetres;
    if (north_m > half_m + kPadBlend_m + kAcross_m) continue;
    for (std::size_t column = 0; column < row.heights_m.size(); ++column) {
      const RunwayPosition at = runway_position(*airfield, {row.latitude_deg, longitudes_deg_[column]});
      const double blend =
          std::max({0.0, std::abs(at.along_m) - half_m, std::abs(at.across_m) - kPadHalfWidth_m}) / kPadBlend_m;
      if (blend >= 1.0 || row.valley[column] < 0.0F) continue;
      const double part = random::smooth_step(0.0, 1.0, blend);
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
  double radii = kTownExtent;
  for (const Town* town : row.towns) {
    const double north_m = (row.latitude_deg - town->centre.latitude_deg) * kTileMetres;
    const double east_m = longitude_difference_deg(town->centre.longitude_deg, site.position.longitude_deg) *
                          east_m_per_degree(town->centre.latitude_deg);
    radii = std::min(radii, std::sqrt(north_m * north_m + east_m * east_m) / town->radius_m);
  }
  if (radii < kTownExtent) material = town_cover(site, radii, material, seed_ + 3110U);
  if (material == Material::water) return material;
  for (const Airfield* airfield : airfields_)
    if (std::abs(row.latitude_deg - airfield->centre.latitude_deg) * kTileMetres < kMaxAirfieldExtent_m)
      material = airfield_cover(*airfield, site.position, material, airfields_are_paved_);
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
    if (std::abs(town->centre.latitude_deg - row.latitude_deg) * kTileMetres < kTownExtent * town->radius_m)
      row.towns.push_back(town);
  add_ground(row, lattice);
  carve_rivers(row);
  level_airfields(row);
  for (std::size_t column = 0; column < columns; ++column) {
    posts_m[column] = post_of(row.heights_m[column], row.valley[column] < 0.0F);
    codes[column] = static_cast<std::uint8_t>(cover(row, column));
  }
}

Landscape::Landscape(std::uint64_t seed, std::optional<LandscapeBox> island, bool paved_airfields)
    : seed_(static_cast<std::uint32_t>(seed ^ (seed >> 32U)) * 4096U),
      paved_airfields_(paved_airfields),
      tiles_(std::make_unique<LandscapeTiles>(seed_, island)) {}

MadeCell Landscape::make(CellCorner corner, int rows, int columns, int threads, const parallel::GoesOn& goes_on) const {
  YARS_REQUIRE(threads, >=, 1);
  LandscapeRows maker(*tiles_, seed_, corner, rows, columns);
  if (!paved_airfields_) maker.leave_airfields_unpaved();
  const auto width = static_cast<std::size_t>(columns);
  std::vector<std::int16_t> posts(static_cast<std::size_t>(rows) * width);
  std::vector<std::uint8_t> codes(posts.size());
  // Each thread computes every `threads`-th row. All rows take about the same time.
  std::atomic<bool> stop = false;
  const auto work = [&](int first) {
    for (int row = first; row < rows && !stop; row += threads) {
      if (first == 0 && goes_on && !goes_on()) stop = true;
      const std::size_t start = static_cast<std::size_t>(row) * width;
      maker.make(row, std::span(posts).subspan(start, width), std::span(codes).subspan(start, width));
    }
  };
  std::vector<std::thread> others;
  for (int first = 1; first < threads; ++first) others.emplace_back(work, first);
  work(0);
  for (std::thread& other : others) other.join();
  if (stop) throw parallel::Stopped{};
  return {model::terrain::Cell(corner, rows, columns, posts), model::terrain::Culture(corner, rows, columns, codes)};
}

bool Landscape::may_have_land(CellCorner corner) const {
  const auto land = tiles_->relief(corner);
  // The ring around the tile contains the nodes of its north and east edges. Where all nodes lie below kAlwaysSea_m,
  // spline and gullies cannot raise the ground above the sea.
  for (int row = -1; row <= kTileNodes; ++row)
    for (int column = -1; column <= kTileNodes; ++column)
      if (land->height_m(row, column) > kAlwaysSea_m) return true;
  return false;
}

}  // namespace yars::worldgen

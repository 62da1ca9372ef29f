#include "worldgen/terrain/relief.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lib/geo/frames.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/random/counter_rng.hpp"

namespace yars::worldgen {

namespace {

constexpr double kMetresPerDegree = 111195.0;  // on a sphere of 6371 km

constexpr double kLevel = 1e-3;   // [m/m] flatter ground has no defined downhill direction, so it has no gullies
constexpr double kGentle = 0.02;  // [m/m] below this slope gullies become shallow, so that plains stay flat
constexpr double kSteep = 0.45;   // [m/m] above this slope the depth of gullies saturates

struct CosineSine {
  double cosine;
  double sine;
};

// cos and sin of an angle in full turns, |turns| <= 1.5; error below 1e-5. The function does not call the maths
// library, so results are equal on all platforms.
CosineSine cosine_sine(double turns) {
  const double half = std::numbers::pi * (turns - static_cast<int>(turns + (turns < 0 ? -0.5 : 0.5)));  // [-pi/2, pi/2]
  const double square = half * half;
  const double sine =
      half *
      (1 - square * (1.0 / 6) * (1 - square * (1.0 / 20) * (1 - square * (1.0 / 42) * (1 - square * (1.0 / 72)))));
  const double cosine =
      1 -
      square * 0.5 *
          (1 - square * (1.0 / 12) * (1 - square * (1.0 / 30) * (1 - square * (1.0 / 56) * (1 - square * (1.0 / 90)))));
  return {cosine * cosine - sine * sine, 2 * sine * cosine};
}

}  // namespace

GullyRow::GullyRow(const Gullies& gullies, double latitude_deg) {
  const double parallel = std::cos(latitude_deg * geo::kRadiansPerDegree);
  octaves_.reserve(gullies.octaves.size());
  for (const GullyOctave& shape : gullies.octaves) {
    Octave octave{shape, gullies.seed + 1 + static_cast<std::uint32_t>(octaves_.size()), {}};
    const double row_deg = shape.wavelength_m / kMetresPerDegree;
    const double position = (latitude_deg + 90.0) / row_deg;
    const auto middle = static_cast<std::int32_t>(std::floor(position));
    for (int step = 0; step < 3; ++step) {
      Band& band = octave.bands[step];
      band.index = middle - 1 + step;
      band.north = position - band.index;
      const double middle_deg = std::clamp((band.index + 0.5) * row_deg - 90.0, -90.0, 90.0);
      band.columns = std::max(1.0, std::floor(360.0 * std::cos(middle_deg * geo::kRadiansPerDegree) / row_deg));
      band.width = 360.0 / band.columns / row_deg * parallel;
    }
    octaves_.push_back(octave);
  }
}

void GullyRow::gather(Band& band, double middle, std::uint32_t seed) {
  band.middle = middle;
  for (int step = 0; step < 3; ++step) {
    const double column = middle - 1.0 + step;
    const double wrapped =
        column < 0 ? column + band.columns : (column >= band.columns ? column - band.columns : column);
    const std::uint32_t hash = random::lattice_hash(static_cast<std::int32_t>(wrapped), band.index, 0, seed);
    band.points[step] = {column + static_cast<double>(hash & 0xFFFFU) / 65536.0,
                         band.north - static_cast<double>(hash >> 16U) / 65536.0};
  }
}

// Sum of the wave packets around a position, with its magnitude normalized to at most 1. The waves advance along the
// unit vector `across`, at right angles to the downhill direction. `turn` [0, 1): longitude of the position from
// the antimeridian, in full turns.
GullyRow::Wave GullyRow::packets(Octave& octave, double turn, Slope across) {
  Wave sum;
  double total = 0.0;
  for (Band& band : octave.bands) {
    const double position = turn * band.columns;
    const double middle = static_cast<std::int32_t>(position);
    if (middle != band.middle) gather(band, middle, octave.seed);
    for (const Band::Point& point : band.points) {
      const double east = (position - point.column) * band.width;
      const double falloff = 1.0 - (east * east + point.north * point.north);
      if (falloff <= 0.0) continue;
      const double weight = falloff * falloff;
      const CosineSine wave = cosine_sine(east * across.east + point.north * across.north);
      sum.cosine += weight * wave.cosine;
      sum.sine += weight * wave.sine;
      total += weight;
    }
  }
  const double strength = std::sqrt(sum.cosine * sum.cosine + sum.sine * sum.sine);
  // Where packets cancel, the pattern fades out continuously.
  const double scale = 1.0 / std::max(strength, 0.3 * total + 1e-9);
  return {sum.cosine * scale, sum.sine * scale};
}

GullyRow::Relief GullyRow::at(double longitude_deg, Slope base) {
  Relief relief{0.0, base};
  Slope& slope = relief.slope;
  const double turn = (longitude_deg + 180.0) / 360.0;
  for (Octave& octave : octaves_) {
    const double steepness = std::sqrt(slope.east * slope.east + slope.north * slope.north);
    if (steepness < kLevel) break;
    const Slope across{-slope.north / steepness, slope.east / steepness};
    const Wave wave = packets(octave, turn, across);
    const double cut = steepness * steepness / (steepness + kGentle) / (1.0 + steepness / kSteep);
    const double depth_m = octave.shape.depth * octave.shape.wavelength_m * cut;
    // The offset makes gullies deeper than spurs are high.
    relief.height_m += depth_m * (wave.cosine - 0.25);
    const double cross_slope = -depth_m * wave.sine * 2.0 * std::numbers::pi / octave.shape.wavelength_m;
    slope.east += cross_slope * across.east;
    slope.north += cross_slope * across.north;
  }
  return relief;
}

namespace {

constexpr double kKmPerDegree = kTileMetres / 1000.0;
constexpr double kCornerKm = 45.0;  // radius of a corner; with a smaller radius the island looks like a box
constexpr double kNoEdgeKm = 1e6;   // distance to an edge that does not exist

}  // namespace

double LandscapeBox::inside_km(geo::GeoPoint position) const {
  double north_km = kNoEdgeKm;  // distance to the nearer of the south and the north edge
  if (south_deg > -90) north_km = (position.latitude_deg - south_deg) * kKmPerDegree;
  const int north_deg = south_deg + cells_north;
  if (north_deg < 90) north_km = std::min(north_km, (north_deg - position.latitude_deg) * kKmPerDegree);
  double east_km = kNoEdgeKm;
  if (cells_east < 360) {
    double east_deg = position.longitude_deg - west_deg;
    if (east_deg < 0) east_deg += 360.0;
    const double km_per_degree = kKmPerDegree * std::max(0.0, std::cos(position.latitude_deg * geo::kRadiansPerDegree));
    east_km = std::min(east_deg, cells_east - east_deg) * km_per_degree;
  }
  const double radius_km = std::min(kCornerKm, 0.5 * kKmPerDegree * cells_north);
  if (north_km <= 0.0 || east_km <= 0.0 || north_km >= radius_km || east_km >= radius_km)
    return std::min(north_km, east_km);
  const double north = radius_km - north_km;
  const double east = radius_km - east_km;
  return radius_km - std::sqrt(north * north + east * east);
}

namespace {

constexpr double kEarthRadiusKm = 6371.0;  // sphere
constexpr double kShelfMPerKm = 14.0;      // slope of the sea floor
constexpr double kOpenSeaKm = -130.0;      // distance inland; farther out at sea there is no coast, island or range
// [m MSL] Minimum height of the sea floor. A deeper floor would make a slope at the edge of an island's box. Slopes get
// gullies, whose spurs would rise above the water.
constexpr double kSeaBottom_m = -150.0;

// Gaussian bell: 1 at offset 0, 1/e at half_width.
double bell(double offset, double half_width) {
  const double t = offset / half_width;
  return std::exp(-t * t);
}

geo::Vector3 at_wavelength(geo::Vector3 point_km, double wavelength_km) {
  return {point_km.x / wavelength_km, point_km.y / wavelength_km, point_km.z / wavelength_km};
}

// A mountain range along a line of equal distance inland.
struct Range {
  double axis_km;  // distance of the axis inland; negative: the axis is at sea, and the summits are islands
  double half_width_km;
  double height_scale_m;
  std::uint32_t layer;  // number of the noise field
};
constexpr Range kRanges[] = {{20, 12, 1250, 70}, {96, 27, 3000, 90}, {210, 40, 2300, 110}, {-30, 9, 680, 130}};

}  // namespace

double BroadRelief::noise(geo::Vector3 point_km, double wavelength_km, std::uint32_t layer, int octaves) const {
  return random::fractal_noise(at_wavelength(point_km, wavelength_km), seed_ + layer, octaves, 0.5);
}

double BroadRelief::ridges(geo::Vector3 point_km, double wavelength_km, std::uint32_t layer, int octaves) const {
  return random::ridged_noise(at_wavelength(point_km, wavelength_km), seed_ + layer, octaves);
}

// Coast of an island: the general coast (`coast_km`), but no farther out than a line with bays and capes, 11 to 81 km
// inside the edge of the box. `warped`: position on the sphere after domain warping [km].
BroadRelief::Shore BroadRelief::shore_near_edge(double coast_km, geo::GeoPoint position, geo::Vector3 warped) const {
  constexpr double kEdgeEffectKm = 125.0;  // farther inside, the edge has no effect
  const double inside_km = island_ ? island_->inside_km(position) : kEdgeEffectKm;
  if (inside_km >= kEdgeEffectKm) return {coast_km, 1.0};
  const double margin_km = 11.0 + 70.0 * std::clamp(0.42 + 1.15 * noise(warped, 115, 170, 6), 0.0, 1.0);
  const double shore_km = inside_km - margin_km;
  return {std::min(coast_km, shore_km), random::smooth_step(0.0, 22.0, shore_km)};
}

double BroadRelief::height_m(geo::GeoPoint position) const {
  if (island_ && island_->inside_km(position) <= 0.0) return kSeaBottom_m;
  const double latitude = position.latitude_deg * geo::kRadiansPerDegree;
  const double longitude = position.longitude_deg * geo::kRadiansPerDegree;
  const geo::Vector3 at{kEarthRadiusKm * std::cos(latitude) * std::cos(longitude),
                        kEarthRadiusKm * std::cos(latitude) * std::sin(longitude), kEarthRadiusKm * std::sin(latitude)};
  // Domain warping (noise added to the position) turns straight features of the noise into winding features.
  const geo::Vector3 warped{at.x + 9.0 * noise(at, 55, 10, 3), at.y + 9.0 * noise(at, 55, 20, 3),
                            at.z + 9.0 * noise(at, 55, 30, 3)};
  // Distance inland from the general line of the coast, negative at sea.
  const double inland_km =
      260.0 * (noise(warped, 1100, 40) + 0.45 * noise(warped, 430, 41) + 0.16 * noise(warped, 170, 42));
  if (inland_km < kOpenSeaKm) return kSeaBottom_m;
  // The coast deviates little from the general line along beaches, and more along rugged coasts. Inlets extend inland.
  const double rugged = random::smooth_step(-0.3, 0.4, noise(at, 130, 43));
  const double inlets = random::smooth_step(0.42, 0.8, ridges(warped, 85, 44, 3));
  const Shore shore = shore_near_edge(
      inland_km + (9.0 + 26.0 * rugged) * noise(warped, 62, 50, 6) - 22.0 * inlets * bell(inland_km, 28.0), position,
      warped);
  const double coast_km = shore.coast_km;
  // Shelf, coastal plain, and the gentle rise farther inland.
  double height_m = coast_km < 0 ? kShelfMPerKm * coast_km
                                 : 95.0 * (1.0 - std::exp(-coast_km / 14.0)) + 1.6 * std::min(coast_km, 90.0);
  if (shore.fade <= 0.0) return std::max(height_m, kSeaBottom_m);
  // Each mountain range follows the general line of the coast at the distance axis_km. Noise (`presence`) lowers parts
  // of the range.
  const double shift_km = 26.0 * noise(at, 120, 60, 3);
  for (const Range& range : kRanges) {
    const double envelope = bell(inland_km - range.axis_km - shift_km, range.half_width_km);
    if (envelope < 1e-3) continue;
    const double presence = 0.45 + 0.75 * random::smooth_step(-0.45, 0.35, noise(at, 95, range.layer, 2));
    height_m += range.height_scale_m * envelope * presence * shore.fade *
                (0.28 + 1.05 * ridges(warped, 34, range.layer + 5, 4));
  }
  const double hilly =
      random::smooth_step(2.0, 25.0, coast_km) * random::smooth_step(-0.1, 0.5, noise(at, 60, 160, 2)) * shore.fade;
  if (hilly > 0.0) height_m += 190.0 * hilly * ridges(warped, 17, 150, 4);
  return std::max(height_m, kSeaBottom_m);
}

geo::GeoPoint lattice_node(int row, int column) {
  constexpr int kNodesAround = model::terrain::kCellColumns * kTileNodes;
  const int wrapped = (column % kNodesAround + kNodesAround) % kNodesAround;
  return {static_cast<double>(row) / kTileNodes - 90.0, static_cast<double>(wrapped) / kTileNodes - 180.0};
}

double east_m_per_degree(double latitude_deg) {
  return kTileMetres * std::max(0.01, std::cos(latitude_deg * geo::kRadiansPerDegree));
}

CellCorner neighbour_of(CellCorner corner, int north, int east) {
  return {corner.south_deg + north,
          (corner.west_deg + east + 180 + model::terrain::kCellColumns) % model::terrain::kCellColumns - 180};
}

ReliefTile::ReliefTile(CellCorner corner, const BroadRelief& broad, const Gullies& valleys)
    : corner_(corner), heights_m_(static_cast<std::size_t>(kSide) * kSide) {
  for (int row = -1; row <= kTileNodes; ++row)
    for (int column = -1; column <= kTileNodes; ++column)
      heights_m_[slot(row, column)] = static_cast<float>(broad.height_m(node(row, column)));
  const std::vector<float> broad_m = heights_m_;
  constexpr double kHalfSteps = kTileNodes / 2.0;
  for (int row = 0; row < kTileNodes; ++row) {
    const double latitude_deg = node(row, 0).latitude_deg;
    GullyRow valley_row(valleys, std::clamp(latitude_deg, -90.0, 90.0));
    for (int column = 0; column < kTileNodes; ++column) {
      const std::size_t here = slot(row, column);
      const Slope slope{(broad_m[here + 1] - broad_m[here - 1]) * kHalfSteps / east_m_per_degree(latitude_deg),
                        (broad_m[here + kSide] - broad_m[here - kSide]) * kHalfSteps / kTileMetres};
      heights_m_[here] += static_cast<float>(valley_row.at(node(row, column).longitude_deg, slope).height_m);
    }
  }
}

geo::GeoPoint ReliefTile::node(int row, int column) const {
  return lattice_node((corner_.south_deg + 90) * kTileNodes + row, (corner_.west_deg + 180) * kTileNodes + column);
}

double ReliefTile::steepness(int row, int column) const {
  const double east = (height_m(row, column + 1) - height_m(row, column - 1)) * (kTileNodes / 2.0) /
                      east_m_per_degree(node(row, column).latitude_deg);
  const double north = (height_m(row + 1, column) - height_m(row - 1, column)) / (2.0 * kNodeMetres);
  return std::sqrt(east * east + north * north);
}

namespace {

// Weights of a uniform cubic B-spline over four lattice nodes, and the derivatives of the weights with respect to `t`.
// `t`, [0, 1]: position between the second and the third node.
struct Spline {
  std::array<double, 4> value;
  std::array<double, 4> derivative;
};
Spline spline_at(double t) {
  const double s = 1.0 - t;
  return {
      {s * s * s / 6.0, (3 * t * t * t - 6 * t * t + 4) / 6.0, (3 * s * s * s - 6 * s * s + 4) / 6.0, t * t * t / 6.0},
      {-s * s / 2.0, (3 * t * t - 4 * t) / 2.0, (4 * s - 3 * s * s) / 2.0, t * t / 2.0}};
}

}  // namespace

LandscapeLattice::LandscapeLattice(CellCorner corner, int columns,
                                   const std::function<const ReliefTile&(CellCorner)>& tile_at)
    : corner_(corner), heights_m_(static_cast<std::size_t>(kNodes) * kNodes) {
  for (int north = -1; north <= 1; ++north)
    for (int east = -1; east <= 1; ++east) {
      const ReliefTile& tile = tile_at(neighbour_of(corner, north, east));
      // The part of this tile within the cell and its margin.
      for (int row = std::max(0, kMargin + north * kTileNodes);
           row < std::min(kNodes, kMargin + (north + 1) * kTileNodes); ++row)
        for (int column = std::max(0, kMargin + east * kTileNodes);
             column < std::min(kNodes, kMargin + (east + 1) * kTileNodes); ++column)
          heights_m_[static_cast<std::size_t>(row) * kNodes + static_cast<std::size_t>(column)] =
              tile.height_m(row - kMargin - north * kTileNodes, column - kMargin - east * kTileNodes);
    }
  columns_.reserve(static_cast<std::size_t>(columns));
  constexpr int kNodesAround = model::terrain::kCellColumns * kTileNodes;
  for (int column = 0; column < columns; ++column) {
    const int steps = column * kTileNodes;
    const double fraction = static_cast<double>(steps % (columns - 1)) / (columns - 1);
    const int node = steps / (columns - 1);
    const int earth_column = ((corner.west_deg + 180) * kTileNodes + node) % kNodesAround;
    const Spline spline = spline_at(fraction);
    columns_.push_back(
        {node + kMargin - 1, (earth_column + fraction) / kTileNodes - 180.0, spline.value, spline.derivative});
  }
}

LandscapeLattice::Row::Row(const LandscapeLattice& lattice, int post, int intervals)
    : lattice_(&lattice), value_m_(kNodes), derivative_m_(kNodes) {
  const int steps = post * kTileNodes;
  const double fraction = static_cast<double>(steps % intervals) / intervals;
  const int node = steps / intervals;
  latitude_deg_ = ((lattice.corner_.south_deg + 90) * kTileNodes + node + fraction) / kTileNodes - 90.0;
  east_per_node_m_ = east_m_per_degree(latitude_deg_) / kTileNodes;
  const Spline spline = spline_at(fraction);
  for (std::size_t tap = 0; tap < 4; ++tap) {
    // On the cell's north edge the fourth node is in the last row of the lattice and has weight 0.
    const int row = std::min(node + kMargin - 1 + static_cast<int>(tap), kNodes - 1);
    const double* nodes = &lattice.heights_m_[static_cast<std::size_t>(row) * kNodes];
    for (std::size_t column = 0; column < kNodes; ++column) {
      value_m_[column] += spline.value[tap] * nodes[column];
      derivative_m_[column] += spline.derivative[tap] * nodes[column];
    }
  }
}

LandscapeLattice::Ground LandscapeLattice::Row::at(int column) const {
  const Column& taps = lattice_->columns_[static_cast<std::size_t>(column)];
  Ground ground;
  double east = 0.0;
  double north = 0.0;
  for (std::size_t tap = 0; tap < 4; ++tap) {
    const auto node = static_cast<std::size_t>(std::min(taps.first + static_cast<int>(tap), kNodes - 1));
    ground.height_m += taps.value[tap] * value_m_[node];
    east += taps.derivative[tap] * value_m_[node];
    north += taps.value[tap] * derivative_m_[node];
  }
  ground.slope = {east / east_per_node_m_, north / kNodeMetres};
  return ground;
}

}  // namespace yars::worldgen

#include "model/rbm/line_of_sight.hpp"

#include <algorithm>
#include <cmath>

#include "lib/geo/geodesy.hpp"
#include "model/physics/sweep_geometry.hpp"

namespace yars::model::rbm {

namespace {
constexpr std::size_t kMaxPieces = 3072;  // maximum number of extra pieces; enough for rays within 320 NM of a pole
constexpr double kMaxBend_m = 1.0;        // maximum deviation of a piece from the ray
constexpr double kMinPiece_m = 3.0;       // shortest piece, except before a sample; 1/10 of one-arc-second spacing
constexpr double kMinGap_m = 1.0;         // minimum distance from a piece's end to the next sample

// Longest interval between samples, or from the aircraft to the first sample. Samples are evenly spaced in ground or
// slant range. So one of the first two intervals is the longest.
double max_spacing_m(std::span<const float> distance_m) {
  const auto first = std::upper_bound(distance_m.begin(), distance_m.end(), 0.0F);
  if (first == distance_m.end()) return 0.0;
  const auto next = first + 1;
  return static_cast<double>(next == distance_m.end() ? *first : std::max(*first, *next - *first));
}
}  // namespace

RayCrests::RayCrests(std::size_t samples)
    : pieces_(samples + kMaxPieces),
      distance_m_(samples + kMaxPieces + physics::kPairSlack),
      elevation_m_(distance_m_),
      water_(distance_m_),
      peak_m_(distance_m_),
      crest_(distance_m_),
      ends_(samples) {}

bool RayCrests::find(const terrain::TerrainView& terrain, const Ray& ray, const physics::PositionArrays& positions,
                     const terrain::RaySight& sight, std::span<float> tangent) {
  const physics::PolarPassage passage(ray.apex, ray.azimuth, kMaxBend_m, kMinPiece_m);
  if (passage.min_straight_m(0.0, ray.range.metres()) >= max_spacing_m(sight.distance_m))
    return terrain.crests(positions.run(), sight, tangent);
  split(passage, sight.distance_m);
  const std::size_t count = pieces_.count;
  physics::sample_positions(ray.apex, ray.azimuth, ray.range, ray.knots, distance_m_.data(), pieces_);
  const terrain::RaySight pieces{
      sight.altitude_m, sight.curvature, sight.lift, std::span(distance_m_).first(count), {}};
  if (!terrain.crests(pieces_.run(), pieces, std::span(crest_).first(count))) return false;
  sample_short_pieces(terrain, sight);
  const float* from = crest_.data();
  for (std::size_t i = 0; i < tangent.size(); ++i) {
    const float* const end = crest_.data() + ends_[i] + 1;
    tangent[i] = *std::max_element(from, end);
    from = end;
  }
  return true;
}

void RayCrests::split(const physics::PolarPassage& passage, std::span<const float> distance_m) {
  std::size_t count = 0;
  first_short_ = last_short_ = 0;
  double at_m = 0.0;
  for (std::size_t i = 0; i < distance_m.size(); ++i) {
    const auto end_m = static_cast<double>(distance_m[i]);
    const std::size_t capacity = pieces_.north_deg.size() - physics::kPairSlack - (distance_m.size() - i);
    for (double piece_m = passage.max_straight_m(at_m); at_m + piece_m < end_m - kMinGap_m && count < capacity;
         piece_m = passage.max_straight_m(at_m)) {
      at_m += piece_m;
      distance_m_[count++] = static_cast<float>(at_m);
      if (piece_m > kMinPiece_m) continue;
      if (last_short_ == 0) first_short_ = count - 1;
      last_short_ = count;
    }
    at_m = end_m;
    ends_[i] = count;
    distance_m_[count++] = distance_m[i];
  }
  pieces_.count = count;
  std::fill_n(&distance_m_[count], physics::kPairSlack, static_cast<float>(at_m));
}

// Includes the ground at the ends of short pieces in the crests. A piece that ends at a sample is skipped, because the
// crest of a sample excludes the ground at the sample itself.
void RayCrests::sample_short_pieces(const terrain::TerrainView& terrain, const terrain::RaySight& sight) {
  if (last_short_ == 0) return;
  const terrain::SightSeries series = terrain::sight_series(sight);
  const std::size_t count = last_short_ - first_short_;
  const terrain::PositionRun all = pieces_.run();
  const auto of_short = [&](std::span<const float> values) { return values.subspan(first_short_, count); };
  const auto found = [&](memory::CacheAlignedVector<float>& values) {
    return std::span(values).subspan(first_short_, count);
  };
  terrain.surfaces({all.corner, of_short(all.cells_north), of_short(all.cells_east), of_short(all.north_deg),
                    of_short(all.east_deg)},
                   radar::Interpolation::bilinear, {found(elevation_m_), found(water_), found(peak_m_), {}});
  auto end = std::lower_bound(ends_.begin(), ends_.end(), first_short_);
  for (std::size_t i = first_short_; i < last_short_; ++i) {
    if (end != ends_.end() && *end == i) {
      ++end;
      continue;
    }
    if (std::isnan(peak_m_[i])) continue;
    const terrain::SightSeries::Line line = series.at(sight.curvature, static_cast<double>(distance_m_[i]));
    crest_[i] = std::max(crest_[i], static_cast<float>(line.tangent(static_cast<double>(peak_m_[i]))));
  }
}

namespace {
constexpr std::size_t kSamples = 512;

// True if ground at a distance surely lies below the line of sight with a tangent, without the sines of
// EffectiveEarth::tangent(). The line is approximated by altitude + tangent d + d^2 / (2 R). The margin bounds what
// that and the inclination of the ground's vertical leave out, for angles up to 1 rad at the earth's centre. Refraction
// lifts the ground.
bool lies_below(const physics::EffectiveEarth& earth, double altitude_m, double tangent, double distance_m,
                double height_m) {
  const double angle_rad = distance_m * earth.curvature();
  const double margin_m =
      (std::abs(tangent) + angle_rad) * angle_rad * (std::abs(height_m) + distance_m * angle_rad / 6.0);
  const double below_m = altitude_m - height_m + 0.5 * distance_m * angle_rad;
  const double lift_m = earth.lift().of_elevation.at_m(distance_m * distance_m + below_m * below_m, height_m);
  return height_m + 1.1 * lift_m < altitude_m + distance_m * (tangent + 0.5 * angle_rad) - margin_m;
}
}  // namespace

SightLine::SightLine()
    : positions_(kSamples),
      ray_crests_(kSamples),
      distance_m_(kSamples + physics::kPairSlack),
      elevation_m_(distance_m_),
      water_(distance_m_),
      peak_m_(distance_m_),
      crest_(distance_m_) {}

bool SightLine::clear(const physics::GeometryParameters& parameters, const physics::SweepGeometry& geometry,
                      const terrain::TerrainView& terrain, const geo::GeodesicInverse& path, double altitude_m) {
  // Ground and point have the same lift, so the series serves `reference`, too.
  physics::GeometryParameters fast = parameters;
  fast.exact = false;
  const physics::EffectiveEarth earth =
      physics::effective_earth(fast, geometry.apex, geometry.altitude, path.azimuth_at_start);
  const double distance_m = path.distance.metres();
  // The last sample is directly below the point and hides nothing.
  for (std::size_t i = 0; i < kSamples; ++i)
    distance_m_[i] = static_cast<float>(distance_m * static_cast<double>(i + 1) / static_cast<double>(kSamples));
  std::fill_n(distance_m_.data() + kSamples, physics::kPairSlack, static_cast<float>(distance_m));
  physics::sample_positions(geometry.apex, path.azimuth_at_start, path.distance, parameters.geodesic_knots,
                            distance_m_.data(), positions_);
  const auto all = [](memory::CacheAlignedVector<float>& values) { return std::span(values).first(kSamples); };
  terrain.surfaces(positions_.run(), radar::Interpolation::bilinear,
                   {all(elevation_m_), all(water_), all(peak_m_), {}});
  const terrain::RaySight ray{geometry.altitude.metres(), earth.curvature(), earth.lift().of_elevation,
                              all(distance_m_)};
  const terrain::SightSeries series = terrain::sight_series(ray);
  const double tangent = series.at(earth.curvature(), distance_m).tangent(altitude_m);
  for (std::size_t i = 0; i + 1 < kSamples; ++i) {
    const double height_m = std::isnan(peak_m_[i]) ? 0.0 : static_cast<double>(peak_m_[i]);
    const auto along_m = static_cast<double>(distance_m_[i]);
    if (lies_below(earth, geometry.altitude.metres(), tangent, along_m, height_m)) continue;
    if (series.at(earth.curvature(), along_m).tangent(height_m) >= tangent) return false;
  }
  if (!ray_crests_.find(terrain, {geometry.apex, path.azimuth_at_start, path.distance, parameters.geodesic_knots},
                        positions_, ray, all(crest_)))
    return true;
  return static_cast<double>(*std::max_element(crest_.data(), crest_.data() + kSamples)) < tangent;
}

namespace {
constexpr double kAircraftSquare_m = 100.0;
constexpr double kAltitudeStep_m = 5.0;
constexpr double kMoverSquare_m = 10.0;
constexpr double kAlwaysClear_m = 10.0;  // nearer points are in sight

// Middle of the square of latitude and longitude that contains a position. A row of squares ends at the antimeridian
// with a part of a square.
geo::GeoPoint middle_of_square(geo::GeoPoint position, double side_m) {
  const auto middle = [](double value, double step) { return step * (std::floor(value / step) + 0.5); };
  const double step_deg = side_m / geo::kMetresPerDegree;
  const double latitude_deg = std::clamp(middle(position.latitude_deg, step_deg), -90.0, 90.0);
  const double parallel = std::max(std::cos(latitude_deg * geo::kRadiansPerDegree), 1e-6);
  return {latitude_deg,
          geo::wrapped_degrees(middle(geo::wrapped_degrees(position.longitude_deg), step_deg / parallel))};
}
}  // namespace

SightOrigin::SightOrigin(const physics::SweepGeometry& geometry, const terrain::TerrainView& terrain, bool exact)
    : altitude_m_(geometry.altitude.metres()), exact_(exact), terrain_(&terrain), generation_(terrain.generation()) {
  const geo::GeoPoint position = exact ? geometry.apex : middle_of_square(geometry.apex, kAircraftSquare_m);
  latitude_deg_ = position.latitude_deg;
  longitude_deg_ = position.longitude_deg;
  if (!exact) altitude_m_ = kAltitudeStep_m * std::ceil(altitude_m_ / kAltitudeStep_m);
}

physics::SweepGeometry SightOrigin::moved(const physics::SweepGeometry& geometry,
                                          const terrain::TerrainView& terrain) const {
  physics::SweepGeometry there = geometry;
  there.apex = {latitude_deg_, longitude_deg_};
  double altitude_m = altitude_m_;
  if (!exact_) {
    // The ground in the middle of the square may be higher than that below the aircraft.
    const double ground_m = terrain.elevation_m(there.apex);
    if (altitude_m < ground_m + kAltitudeStep_m) altitude_m = ground_m + kAltitudeStep_m;
  }
  there.altitude = geo::AltitudeMsl::metres(altitude_m);
  return there;
}

MoverSights::MoverSights(const physics::RadarParameters& parameters, std::size_t movers)
    : exact_(parameters.algorithm == radar::Algorithm::reference), parameters_(parameters.geometry), found_(movers) {}

void MoverSights::enter(const physics::SweepGeometry& geometry, const terrain::TerrainView& terrain) {
  const SightOrigin origin(geometry, terrain, exact_);
  if (origin_number_ > 0 && origin == origin_) return;
  origin_ = origin;
  ++origin_number_;
  from_ = origin.moved(geometry, terrain);
}

bool MoverSights::clear(std::size_t number, geo::GeoPoint position, double above_ground_m,
                        const terrain::TerrainView& terrain) {
  const geo::GeoPoint middle = exact_ ? position : middle_of_square(position, kMoverSquare_m);
  Found& found = found_[number];
  if (found.origin == origin_number_ && found.middle == middle && found.above_ground_m == above_ground_m)
    return found.clear;
  const geo::GeodesicInverse path = geo::geodesic_inverse(from_.apex, middle);
  const double ground_m = terrain.elevation_m(middle);
  const double altitude_m = (std::isnan(ground_m) ? 0.0 : ground_m) + above_ground_m;
  found = {origin_number_, middle, above_ground_m,
           path.distance.metres() < kAlwaysClear_m || sight_line_.clear(parameters_, from_, terrain, path, altitude_m)};
  return found.clear;
}

}  // namespace yars::model::rbm

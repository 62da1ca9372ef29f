#include "model/rbm/line_of_sight.hpp"

#include <algorithm>
#include <cmath>

#include "model/physics/sweep_geometry.hpp"

namespace yars::model::rbm {

namespace {
constexpr std::size_t kMaxPieces = 3072;  // more than any ray within 320 NM of a pole needs
constexpr double kBend_m = 1.0;           // a thirtieth of the spacing of 1" posts
constexpr double kShortest_m = 3.0;       // a tenth of it
constexpr double kOwnGround_m = 1.0;      // no piece ends so near before a place

// [m] of the longest way between two places that are even over ground or in slant range: one of the first that is any.
double longest_way(std::span<const float> distance_m) {
  const auto first = std::upper_bound(distance_m.begin(), distance_m.end(), 0.0F);
  if (first == distance_m.end()) return 0.0;
  const auto next = first + 1;
  return static_cast<double>(next == distance_m.end() ? *first : std::max(*first, *next - *first));
}
}  // namespace

RayCrests::RayCrests(std::size_t places)
    : pieces_(places + kMaxPieces),
      distance_m_(places + kMaxPieces + physics::kPairSlack),
      elevation_m_(distance_m_),
      water_(distance_m_),
      peak_m_(distance_m_),
      crest_(distance_m_),
      ends_(places) {}

bool RayCrests::find(const terrain::TerrainView& terrain, const Ray& ray, const physics::PlaceArrays& places,
                     const terrain::RaySight& sight, std::span<float> tangent) {
  const physics::PolarPassage way(ray.apex, ray.azimuth, kBend_m, kShortest_m);
  if (way.min_straight_m(0.0, ray.range.metres()) >= longest_way(sight.distance_m))
    return terrain.crests(places.run(), sight, tangent);
  split(way, sight.distance_m);
  const std::size_t count = pieces_.count;
  physics::sample_places(ray.apex, ray.azimuth, ray.range, ray.knots, distance_m_.data(), pieces_);
  const terrain::RaySight pieces{sight.altitude_m, sight.curvature, std::span(distance_m_).first(count)};
  if (!terrain.crests(pieces_.run(), pieces, std::span(crest_).first(count))) return false;
  look_up_short_pieces(terrain, sight);
  const float* from = crest_.data();
  for (std::size_t i = 0; i < tangent.size(); ++i) {
    const float* const behind = crest_.data() + ends_[i] + 1;
    tangent[i] = *std::max_element(from, behind);
    from = behind;
  }
  return true;
}

void RayCrests::split(const physics::PolarPassage& way, std::span<const float> distance_m) {
  std::size_t count = 0;
  first_short_ = last_short_ = 0;
  double at_m = 0.0;
  for (std::size_t i = 0; i < distance_m.size(); ++i) {
    const auto end_m = static_cast<double>(distance_m[i]);
    const std::size_t room = pieces_.north_deg.size() - physics::kPairSlack - (distance_m.size() - i);
    for (double piece_m = way.max_straight_m(at_m); at_m + piece_m < end_m - kOwnGround_m && count < room;
         piece_m = way.max_straight_m(at_m)) {
      at_m += piece_m;
      distance_m_[count++] = static_cast<float>(at_m);
      if (piece_m > kShortest_m) continue;
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

// A place's own ground is no crest.
void RayCrests::look_up_short_pieces(const terrain::TerrainView& terrain, const terrain::RaySight& sight) {
  if (last_short_ == 0) return;
  const physics::EffectiveEarth earth(1.0 / sight.curvature);
  const std::size_t count = last_short_ - first_short_;
  const terrain::PlaceRun all = pieces_.run();
  const auto of_short = [&](std::span<const float> values) { return values.subspan(first_short_, count); };
  const auto found = [&](memory::LineVector<float>& values) { return std::span(values).subspan(first_short_, count); };
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
    const double distance_m = static_cast<double>(distance_m_[i]);
    const physics::Sight seen = earth.sight(sight.altitude_m, distance_m, static_cast<double>(peak_m_[i]));
    crest_[i] = std::max(crest_[i], static_cast<float>(seen.tangent));
  }
}

namespace {
constexpr std::size_t kSamples = 512;
}

SightLine::SightLine()
    : places_(kSamples),
      ray_crests_(kSamples),
      distance_m_(kSamples + physics::kPairSlack),
      elevation_m_(distance_m_),
      water_(distance_m_),
      peak_m_(distance_m_),
      crest_(distance_m_) {}

bool SightLine::clear(const radar::Fidelity& fidelity, const physics::SweepGeometry& look,
                      const terrain::TerrainView& terrain, const geo::GeodesicInverse& way, double altitude_m) {
  const physics::EffectiveEarth earth = physics::effective_earth(fidelity, look.apex, way.azimuth_at_start);
  const double distance_m = way.distance.metres();
  // The last sample lies under the point itself and hides it no more than its own ground does.
  for (std::size_t i = 0; i < kSamples; ++i)
    distance_m_[i] = static_cast<float>(distance_m * static_cast<double>(i + 1) / static_cast<double>(kSamples));
  std::fill_n(distance_m_.data() + kSamples, physics::kPairSlack, static_cast<float>(distance_m));
  physics::sample_places(look.apex, way.azimuth_at_start, way.distance, fidelity.geodesic_knots, distance_m_.data(),
                         places_);
  const auto samples = [](memory::LineVector<float>& values) { return std::span(values).first(kSamples); };
  terrain.surfaces(places_.run(), radar::Interpolation::bilinear,
                   {samples(elevation_m_), samples(water_), samples(peak_m_), {}});
  double highest = static_cast<double>(terrain::kNoTangent);
  for (std::size_t i = 0; i + 1 < kSamples; ++i) {
    const double height_m = std::isnan(peak_m_[i]) ? 0.0 : static_cast<double>(peak_m_[i]);
    highest =
        std::max(highest, earth.sight(look.altitude.metres(), static_cast<double>(distance_m_[i]), height_m).tangent);
  }
  if (ray_crests_.find(terrain, {look.apex, way.azimuth_at_start, way.distance, fidelity.geodesic_knots}, places_,
                       {look.altitude.metres(), earth.curvature(), samples(distance_m_)}, samples(crest_)))
    highest = std::max(highest, static_cast<double>(*std::max_element(crest_.data(), crest_.data() + kSamples)));
  return highest < earth.sight(look.altitude.metres(), distance_m, altitude_m).tangent;
}

}  // namespace yars::model::rbm

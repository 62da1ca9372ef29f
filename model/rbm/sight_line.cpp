#include "model/rbm/sight_line.hpp"

#include <algorithm>
#include <cmath>

#include "model/rbm/earth.hpp"

namespace yars::model::rbm {

namespace {
constexpr std::size_t kSamples = 512;
}

SightLine::SightLine()
    : places_(kSamples),
      ray_crests_(kSamples),
      distance_m_(kSamples + kPairSlack),
      elevation_m_(distance_m_),
      water_(distance_m_),
      peak_m_(distance_m_),
      crest_(distance_m_) {}

bool SightLine::clear(const radar::Fidelity& fidelity, const Look& look, const terrain::TerrainView& terrain,
                      const geo::GeodesicInverse& way, double altitude_m) {
  const EffectiveEarth earth = effective_earth(fidelity, look.apex, way.azimuth_at_start);
  const double distance_m = way.distance.metres();
  // The last sample lies under the point itself and hides it no more than its own ground does.
  for (std::size_t i = 0; i < kSamples; ++i)
    distance_m_[i] = static_cast<float>(distance_m * static_cast<double>(i + 1) / static_cast<double>(kSamples));
  std::fill_n(distance_m_.data() + kSamples, kPairSlack, static_cast<float>(distance_m));
  sample_places(look.apex, way.azimuth_at_start, way.distance, fidelity.geodesic_knots, distance_m_.data(), places_);
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

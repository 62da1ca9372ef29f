#include "model/reflectivity/scene_surface.hpp"

#include <algorithm>
#include <cmath>

#include "lib/geo/quantity.hpp"
#include "model/reflectivity/land.hpp"

namespace yars::model::reflectivity {

namespace {
constexpr double kFaded = 4.0;  // widths of the cardinal effect off it: 2^-64 of it is left
constexpr double kMostOff_deg = 89.0;
constexpr int kSteps = 256;  // of the table: a sixty-fourth of the effect's width, 1e-4 of it between them
}  // namespace

SceneSurface::SceneSurface(const radar::RadarConfiguration& configuration)
    : street_width_deg_(configuration.world.land.street_width_deg),
      faded_deg_(std::min(kFaded * street_width_deg_, kMostOff_deg)),
      faded_tangent_(std::tan(faded_deg_ * geo::kRadiansPerDegree)) {
  const LandReturn land = make_land_return(configuration);
  for (std::size_t code = 0; code < land.gamma.size(); ++code) {
    const std::size_t known = code == 0 ? static_cast<std::size_t>(configuration.high_resolution.plain_material) : code;
    gamma_.push_back(land.gamma[known]);
    cardinal_.push_back(land.cardinal[known]);
  }
}

double SceneSurface::wall_gamma(std::size_t code, double across, double towards) const {
  if (std::abs(across) > faded_tangent_ * towards) return gamma(code);
  const double off_deg = std::atan2(across, towards) / geo::kRadiansPerDegree;
  return gamma(code) * cardinal_gain(cardinal_[code % cardinal_.size()], off_deg, street_width_deg_);
}

double SceneSurface::steps_a_sine() const {
  return kSteps / std::sin(faded_deg_ * geo::kRadiansPerDegree);
}

std::vector<float> SceneSurface::cardinal_shares() const {
  std::vector<float> shares;
  for (int step = 0; step < kSteps; ++step) {
    const double off_deg = std::asin(std::min(step / steps_a_sine(), 1.0)) / geo::kRadiansPerDegree;
    shares.push_back(static_cast<float>(cardinal_gain(1.0, off_deg, street_width_deg_) - 1.0));
  }
  shares.push_back(0.0F);
  shares.push_back(0.0F);
  return shares;
}

}  // namespace yars::model::reflectivity

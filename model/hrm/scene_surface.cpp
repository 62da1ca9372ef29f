#include "model/hrm/scene_surface.hpp"

#include <algorithm>
#include <cmath>

#include "lib/geo/quantity.hpp"
#include "model/reflectivity/land.hpp"

namespace yars::model::hrm {

namespace {
constexpr double kFaded = 4.0;  // widths of the cardinal effect off it: 2^-64 of it is left
constexpr double kMostOff_deg = 89.0;
}  // namespace

SceneSurface::SceneSurface(const radar::RadarConfiguration& configuration)
    : street_width_deg_(configuration.world.land.street_width_deg),
      faded_tangent_(std::tan(std::min(kFaded * street_width_deg_, kMostOff_deg) * geo::kRadiansPerDegree)) {
  const reflectivity::LandReturn land = reflectivity::make_land_return(configuration);
  for (std::size_t code = 0; code < land.gamma.size(); ++code) {
    const std::size_t known = code == 0 ? static_cast<std::size_t>(configuration.high_resolution.plain_material) : code;
    gamma_.push_back(land.gamma[known]);
    cardinal_.push_back(land.cardinal[known]);
  }
}

double SceneSurface::wall_gamma(std::size_t code, double across, double towards) const {
  if (std::abs(across) > faded_tangent_ * towards) return gamma(code);
  const double off_deg = std::atan2(across, towards) / geo::kRadiansPerDegree;
  return gamma(code) * reflectivity::cardinal_gain(cardinal_[code % cardinal_.size()], off_deg, street_width_deg_);
}

}  // namespace yars::model::hrm

#include "model/rbm/report_1996.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "model/physics/ray.hpp"

namespace yars::model::rbm {

namespace {
constexpr std::array<float, 3> kSmearWeights{0.25F, 0.5F, 0.25F};
constexpr float kNoHorizon = -1.0e30F;  // lower than the tangent of any terrain
constexpr int kGainSteps = 4;
constexpr double kReferenceFraction = 0.5;  // [selected ranges] distance at which level ground gives full scale
// [m MSL] Lower limit of the altitude in reference_intensity(). Without it the reference would go to 0 at low altitude,
// and even dark slopes would be white.
constexpr double kMinAltitude_m = 100.0;

// Intensity of level ground at sea level at half the selected range. It is equal for every bar and azimuth.
float reference_intensity(const physics::SweepGeometry& geometry) {
  const double altitude_m = std::max(geometry.altitude.metres(), kMinAltitude_m);
  return static_cast<float>(altitude_m / std::hypot(altitude_m, kReferenceFraction * geometry.range.metres()));
}

float smoothed(float before, float centre, float after) {
  return kSmearWeights[0] * before + kSmearWeights[1] * centre + kSmearWeights[2] * after;
}
}  // namespace

Report1996::Report1996(const physics::RadarParameters& parameters)
    : half_beam_rad_(0.5 * parameters.elevation_beamwidth_deg * geo::kRadiansPerDegree),
      knots_(parameters.geometry.geodesic_knots),
      interpolation_(parameters.interpolation),
      count_(sample_count(parameters)),
      distance_m_(count_ + terrain::kRunSlack),
      positions_(count_),
      elevation_m_(distance_m_.size()),
      water_(distance_m_.size()),
      intensity_(count_),
      lit_(count_) {}

std::size_t Report1996::measure(const physics::SweepGeometry& geometry, const physics::Environment& environment,
                                std::span<float> power) {
  const std::size_t count = count_;
  const double spacing_m = geometry.range.metres() / static_cast<double>(count);
  for (std::size_t i = 0; i < count; ++i)
    distance_m_[i] = static_cast<float>((static_cast<double>(i) + 0.5) * spacing_m);
  sampler_.sample(geometry.apex, geometry.azimuth, geometry.range, knots_, distance_m_.data(), positions_);
  const std::size_t pending = environment.terrain.surfaces(
      positions_.run(), interpolation_, {{elevation_m_.data(), count}, {water_.data(), count}, {}, {}});

  // The report's Y_min and Y_max: tangents of the beam's lower edge at the lowest bar and upper edge at the highest.
  const auto lower =
      static_cast<float>(std::tan((geometry.elevation - geometry.bars_below).radians() - half_beam_rad_));
  const auto upper =
      static_cast<float>(std::tan((geometry.elevation + geometry.bars_above).radians() + half_beam_rad_));
  const auto altitude_m = static_cast<float>(geometry.altitude.metres());
  const float reference = reference_intensity(geometry);
  float horizon = kNoHorizon;
  for (std::size_t i = 0; i < count; ++i) {
    intensity_[i] = 0.0F;
    const float distance_m = distance_m_[i];
    const float up_m = elevation_m_[i] - altitude_m;
    const float tangent = up_m / distance_m;
    const bool lit = tangent >= lower && tangent <= upper && tangent > horizon;  // false over a void (NaN)
    lit_[i] = lit ? 1 : 0;
    if (!lit) continue;
    horizon = tangent;
    const float rise = slope(i, static_cast<float>(spacing_m));
    const float normal = std::sqrt(1.0F + rise * rise);
    const float cosine = (rise * distance_m - up_m) / (normal * std::sqrt(distance_m * distance_m + up_m * up_m));
    intensity_[i] = std::max(0.0F, cosine) / reference;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t before = i > 0 ? i - 1 : i;
    const std::size_t after = i + 1 < count ? i + 1 : i;
    power[i] = smoothed(intensity_[before], intensity_[i], intensity_[after]);
  }
  return pending;
}

void Report1996::lit(std::span<std::uint8_t> mask) const {
  std::copy(lit_.begin(), lit_.end(), mask.begin());
}

float Report1996::slope(std::size_t index, float spacing_m) const {
  // Central difference; beside a void and at the ends of the sweep, the one-sided difference.
  const bool near_known = index > 0 && !std::isnan(elevation_m_[index - 1]);
  const bool far_known = index + 1 < count_ && !std::isnan(elevation_m_[index + 1]);
  const std::size_t near = near_known ? index - 1 : index;
  const std::size_t far = far_known ? index + 1 : index;
  if (near == far) return 0.0F;
  return (elevation_m_[far] - elevation_m_[near]) / (static_cast<float>(far - near) * spacing_m);
}

void Report1996::form_video(const physics::PowerWindow& window, geo::Length /*range*/, int gain,
                            const physics::NoiseKey& /*key*/, std::span<std::uint8_t> video) {
  const float scale = 255.0F * static_cast<float>(gain + 1) / static_cast<float>(kGainSteps);
  for (std::size_t i = 0; i < video.size(); ++i) {
    const float power = std::min(smoothed(window.before[i], window.centre[i], window.after[i]), 1.0F);
    const float level = scale * power + 0.5F;  // + 0.5, because the conversion to an integer rounds down
    video[i] = static_cast<std::uint8_t>(level);
  }
}

}  // namespace yars::model::rbm

// Shape of the texture (clutter.hpp) of land by material, grazing angle and area of the resolution cell.
// Inputs: configuration; altitude, selected range, pulse and width of the beam of a sweep.
// Outputs: for each sample, where its levels begin in the table TextureSteps.
// Accuracy: shapes are rounded to a quarter of an octave, altitudes to an eighth. The ground is level and at mean sea
// level.
// Threads: one thread at a time may use a SampleTextures.
// Source: docs/spec/physics.md#texture.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lib/geo/quantity.hpp"
#include "lib/memory/line_vector.hpp"
#include "model/physics/clutter.hpp"
#include "model/physics/radar_parameters.hpp"

namespace yars::model::physics {

// Sim time of the sea's texture: it stands still for steps of two seconds, so that rays that are kept for later sweeps
// equal new ones (rbm::Beam). A smaller step makes Beam measure more rays.
inline geo::Duration sea_texture_time(geo::Duration sim_time) {
  constexpr double kStep_s = 2.0;
  return geo::Duration::seconds(kStep_s * std::floor(sim_time.seconds() / kStep_s));
}

// What the texture of a sweep's samples depends on.
struct TextureSweep {
  double pulse_length_m = 0.0;    // extent of a pulse in range
  double spacing_m = 0.0;         // of the samples
  double altitude_m = 0.0;        // above mean sea level
  double azimuth_cell_rad = 0.0;  // width of the clutter cell: azimuth_cell_rad(); 0: none, as in patch maps
  // Without a beam only materials with a configured texture have one.
  bool has_beam() const { return azimuth_cell_rad > 0.0; }
  bool operator==(const TextureSweep&) const = default;
};

// Levels of texture by steps of the shape: kTextureLevels entries for each step.
struct TextureSteps {
  static constexpr double kMinShape = 0.1;  // of step 0
  static constexpr int kPerOctave = 4;
  static constexpr int kShapes = 41;     // up to the shape 102
  static constexpr int kNone = kShapes;  // step without texture: all levels are 1
  static constexpr std::size_t kEntries = (kShapes + 1) * kTextureLevels;

  // First entry of the step nearest to a shape. A shape of 0 or above the table has no texture.
  static std::int32_t entry(double shape);
  // Number of steps from that of kMinShape, not rounded.
  static double steps(double shape);
  static const std::array<float, kEntries>& levels();
};

// Kinds of land that differ in their texture.
enum class LandKind : std::uint8_t { rural, even };

// Land of a material without a configured texture. Even: trees, sand, marsh, asphalt, snow, which have few single
// strong scatterers.
LandKind land_kind(std::size_t material);

// Weibull slope a of the power of land clutter: the power is an exponential variate to the power a. 1: speckle alone.
double weibull_slope(LandKind kind, double grazing_deg, double cell_m2);

// 1 / shape of the gamma texture that, with the speckle of one look, has the variance / mean^2 of a Weibull slope:
// v = Gamma(1 + 2 a) / Gamma(1 + a)^2 - 1 = (1 + 1/shape) 2 - 1. 0 for a slope of 1.
double inverse_shape_of_slope(double slope);

// Shape of the K distribution of the sea, for one look: lg shape = 2/3 lg p + 5/8 lg A + d - k, p the grazing angle
// [deg] held within 0.1 and 10, A the area of the resolution cell [m^2], k = 1.39 (vertical) or 2.09 (horizontal).
// d = -cos(2 t) / 3, t between ray and wind: sea_turn().
// Source: Ward, Tough and Watts, "Sea Clutter", 2006, p. 237, as quoted by an open program (docs/spec/physics.md#sea).
double sea_shape(radar::Polarization polarization, double grazing_deg, double cell_m2);  // with d = 0
// 10^d of the cosine of the angle between ray and wind.
double sea_turn(double cosine);

// Texture cells whose mean one sample is, so that the texture of a cell is that many times as strong as the sample's.
// `width`: width of the beam over the edge of a texture cell. Source: fit to sweeps (tests/truth/texture_test.cpp).
double cells_in_sample(const RadarParameters& parameters, double width);

class SampleTextures {
 public:
  explicit SampleTextures(const RadarParameters& parameters);

  // Sets the samples of a sweep. Does little if they are those of the last sweep.
  void use(const TextureSweep& sweep);
  // Sets the number of samples of the following sweeps.
  void resize(std::size_t samples);

  bool has_beam() const { return sweep_.has_beam(); }
  const GroundGrid& grid() const { return grid_; }
  // First entries in TextureSteps, by sample.
  const float* sea() const { return sea_.data(); }  // steps of the sea with d = 0
  const std::int32_t* land(LandKind kind) const { return land_[static_cast<std::size_t>(kind)].data(); }

 private:
  struct Place {
    double grazing_deg, range_m;
  };
  Place place(std::size_t sample) const;
  void update();

  const bool pulse_smear_;
  const radar::Polarization polarization_;
  const int sub_beams_;
  const double effective_radius_m_;
  std::size_t samples_;
  TextureSweep sweep_{};  // with the altitude of its class
  double cell_m_ = 0.0;
  GroundGrid grid_;
  std::array<memory::CacheAlignedVector<std::int32_t>, 2> land_;
  memory::CacheAlignedVector<float> sea_;
};

}  // namespace yars::model::physics

// Rows of clutter statistics: speckle of sweeps and maps, texture.
#include <cmath>
#include <string>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "model/hrm/map_image.hpp"
#include "model/kernel/offline_scan.hpp"
#include "model/kernel/sweep_chain.hpp"
#include "model/physics/clutter_simd.hpp"
#include "model/physics/ground_return.hpp"
#include "model/physics/texture.hpp"
#include "model/rbm/beam.hpp"
#include "tests/model/physics/decibels.hpp"
#include "tests/model/terrain/shapes.hpp"
#include "tests/truth/ledger.hpp"

namespace yars::truth {
namespace {

namespace physics = model::physics;

struct Moments {
  double count = 0.0, sum = 0.0, squares = 0.0;
  void add(double value) {
    count += 1.0;
    sum += value;
    squares += value * value;
  }
  double mean() const { return sum / count; }
  double deviation() const { return std::sqrt(squares / count - mean() * mean()); }
};

constexpr double kDynamicRange_db = 60.0;  // black to white, so that no picture clips
constexpr double kMean_db = -14.0;         // mean power, below white

void add_video(const std::vector<std::uint8_t>& video, Moments& db) {
  for (const std::uint8_t level : video) db.add(kDynamicRange_db * (level / 255.0 - 1.0) - kMean_db);
}

// Decibels of the video of sweeps over uniform ground, relative to the mean power.
Moments sweeps(int looks) {
  constexpr std::size_t kSamples = 480;
  radar::RadarConfiguration configuration;
  configuration.fidelity.samples = kSamples;
  configuration.receiver.noise_floor_db = -200.0;
  configuration.receiver.dynamic_range_db = kDynamicRange_db;
  configuration.pulse_us = {0.01};  // a sample is a resolution cell
  const auto algorithm = model::rbm::make_algorithm(configuration);
  const std::vector<float> power(2 * kSamples, static_cast<float>(physics::ratio(kMean_db)));
  const std::span<const float> sweep = std::span(power).first(kSamples);
  std::vector<std::uint8_t> video(kSamples);
  Moments db;
  for (std::uint32_t number = 0; number < 1000; ++number) {
    algorithm->form_video({sweep, sweep, sweep, 0.0, 0.0, looks}, geo::Length::nautical_miles(20.0), physics::kFullGain,
                          {1, 1, number}, video);
    add_video(video, db);
  }
  return db;
}

// The same of patch maps.
Moments maps(int looks) {
  radar::HighResolutionConfiguration configuration;
  configuration.dynamic_range_db = kDynamicRange_db;
  configuration.brightest_gamma_db = -kMean_db;
  model::hrm::MapImage image(radar::kMapCells);
  image.power.assign(image.power.size(), 1.0F);
  std::vector<std::uint8_t> picture(image.power.size());
  Moments db;
  for (std::uint32_t map = 0; map < 3; ++map) {
    model::hrm::form_video(configuration, image, {.looks = looks, .map = map}, 0, image.size, picture);
    add_video(picture, db);
  }
  return db;
}

// Variance / mean^2 of the video of maps with point targets of a share of each pixel's power.
double map_variation(int looks, double share) {
  radar::HighResolutionConfiguration configuration;
  configuration.dynamic_range_db = kDynamicRange_db;
  configuration.brightest_gamma_db = -kMean_db;
  model::hrm::MapImage image(radar::kMapCells);
  image.power.assign(image.power.size(), 1.0F);
  for (std::uint32_t pixel = 0; pixel < image.power.size(); ++pixel)
    image.steady.push_back({pixel, static_cast<float>(share)});
  std::vector<std::uint8_t> picture(image.power.size());
  model::hrm::form_video(configuration, image, {.looks = looks}, 0, image.size, picture);
  Moments power;
  for (const std::uint8_t level : picture) power.add(physics::ratio(kDynamicRange_db * (level / 255.0 - 1.0)));
  return power.deviation() * power.deviation() / (power.mean() * power.mean());
}

TEST(Truth, ATargetOnAMapFluctuatesByItsShareOfThePower) {
  constexpr double kShare = 0.8;
  expect_row({"Targets", "variance/mean² of a map's pixel with a steady target of 80 % of its power, 2 looks",
              0.5 * (1.0 - kShare * kShare), 0.01, "", "a constant in Gaussian noise: Rice 1945", "8 bits"},
             map_variation(2, kShare));
}

std::string looks_of(int looks) {
  return std::to_string(looks) + (looks == 1 ? " look" : " looks");
}

struct LooksPoint {
  int looks;
  double db;
};

TEST(Truth, SpeckleOfSweepsHasTheSpreadOfTheGammaDistribution) {
  for (const LooksPoint& point : {LooksPoint{1, 5.570}, {2, 3.488}, {4, 2.314}, {8, 1.585}, {16, 1.103}})
    expect_row({"Speckle", "standard deviation of a sweep in dB, " + looks_of(point.looks), point.db, 0.02, "dB",
                "gamma distribution: 10/ln 10 √ψ′(L), Goodman 1975", "480,000 samples in 8 bits"},
               sweeps(point.looks).deviation());
}

TEST(Truth, SpeckleOfSweepsLowersTheMeanOfTheLogarithm) {
  for (const LooksPoint& point : {LooksPoint{1, -2.507}, {4, -0.565}})
    expect_row({"Speckle", "mean of a sweep in dB, " + looks_of(point.looks), point.db, 0.03, "dB",
                "gamma distribution: 10/ln 10 (ψ(L) − ln L), Oliver and Quegan 1998", "480,000 samples in 8 bits"},
               sweeps(point.looks).mean());
}

TEST(Truth, SpeckleOfMapsHasTheSpreadOfTheGammaDistribution) {
  for (const LooksPoint& point : {LooksPoint{1, 5.570}, {2, 3.488}, {3, 2.729}})
    expect_row({"Speckle", "standard deviation of a patch map in dB, " + looks_of(point.looks), point.db, 0.02, "dB",
                "gamma distribution: 10/ln 10 √ψ′(L), Oliver and Quegan 1998", "700,000 pixels in 8 bits"},
               maps(point.looks).deviation());
}

TEST(Truth, SpeckleOfMapsLowersTheMeanOfTheLogarithm) {
  for (const LooksPoint& point : {LooksPoint{2, -1.174}, {3, -0.764}})
    expect_row({"Speckle", "mean of a patch map in dB, " + looks_of(point.looks), point.db, 0.03, "dB",
                "gamma distribution: 10/ln 10 (ψ(L) − ln L), Oliver and Quegan 1998", "700,000 pixels in 8 bits"},
               maps(point.looks).mean());
}

// Correlation of the power of samples `apart` samples from each other, one look.
double correlation(double range_nm, std::size_t apart) {
  constexpr std::size_t kSamples = 480;
  radar::RadarConfiguration configuration;
  configuration.receiver.noise_floor_db = -200.0;
  configuration.receiver.dynamic_range_db = 120.0;
  const auto algorithm = model::rbm::make_algorithm(configuration);
  const std::vector<float> power(kSamples, 1e-4F);
  std::vector<std::uint8_t> video(kSamples);
  double pairs = 0.0, products = 0.0;
  Moments single;
  const auto intensity = [&](std::size_t i) { return std::pow(10.0, 12.0 * (video[i] / 255.0 - 1.0) + 4.0); };
  for (std::uint32_t number = 0; number < 1000; ++number) {
    algorithm->form_video({power, power, power}, geo::Length::nautical_miles(range_nm), physics::kFullGain,
                          {1, 1, number}, video);
    for (std::size_t i = 0; i + apart < kSamples; ++i) {
      single.add(intensity(i));
      products += intensity(i) * intensity(i + apart);
      pairs += 1.0;
    }
  }
  return (products / pairs - single.mean() * single.mean()) / (single.deviation() * single.deviation());
}

TEST(Truth, NeighbouringSamplesCorrelateAsTheyShareAPulse) {
  struct Point {
    double range_nm;
    std::size_t apart;
    double samples_of_pulse;
  };
  const double metres_of_pulse = 149.896229, metres_of_mile = 1852.0;
  const auto samples = [&](double range_nm, double pulse_us) {
    return pulse_us * metres_of_pulse / (range_nm * metres_of_mile / 480.0);
  };
  for (const Point& point : {Point{4.7, 1, samples(4.7, 0.26)},
                             {40.0, 1, samples(40.0, 2.0)},
                             {160.0, 1, samples(160.0, 6.0)},
                             {40.0, 2, samples(40.0, 2.0)}}) {
    const double left = std::max(0.0, 1.0 - static_cast<double>(point.apart) / point.samples_of_pulse);
    expect_row({"Speckle",
                "correlation of samples " + std::to_string(point.apart) + " apart, " +
                    std::to_string(static_cast<int>(point.range_nm)) + " NM",
                left * left, 0.02, "", "rectangular pulse in a matched receiver: (1 − Δ/L)², Goodman 1975",
                "480,000 pairs; a rectangular cell is a model of the receiver"},
               correlation(point.range_nm, point.apart));
  }
}

// Number of looks of a scan: mean^2 / variance of the power of its speckle in the sweeps about an azimuth.
double looks_of_scan(double off_track_deg) {
  radar::RadarConfiguration configuration;
  configuration.receiver.noise_floor_db = -200.0;
  configuration.receiver.dynamic_range_db = 120.0;
  configuration.receiver.automatic_gain = false;
  configuration.pulse_us = {0.01};
  configuration.world.land.texture = 0.0;
  const model::terrain::AnalyticTerrain land(model::terrain::flat(1.0));
  model::kernel::ScanRequest request;
  request.pose.position = {37.0, -115.0};
  request.pose.altitude = geo::AltitudeMsl::feet(15000.0);
  request.pose.ground_speed = geo::Speed::knots(480.0);
  request.range = geo::Length::nautical_miles(20.0);
  request.width = geo::Angle::degrees(120.0);
  Moments power;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    configuration.seed = seed;
    model::kernel::OfflineScan scan(configuration, request, 1);
    scan.run({land, nullptr});
    for (std::size_t i = 0; i < scan.sweeps().size(); ++i) {
      const double azimuth_deg = model::kernel::geometry_of(scan.headers()[i]).azimuth.degrees();
      const double off_deg = std::abs(geo::wrapped_degrees(azimuth_deg));
      if (std::abs(off_deg - off_track_deg) > 1.0) continue;
      for (std::size_t k = 100; k < 480; ++k)
        power.add(std::pow(10.0, 12.0 * (scan.sweeps()[i].video[k] / 255.0 - 1.0)) /
                  static_cast<double>(scan.power()[i * 480 + k]));
    }
  }
  return power.mean() * power.mean() / (power.deviation() * power.deviation());
}

TEST(Truth, LooksGoWithTheDopplerSpreadOfTheBeam) {
  const double beam_rad = 2.5 * geo::kRadiansPerDegree, speed_mps = 480.0 * 1852.0 / 3600.0;
  const double wavelength_m = 299792458.0 / 9.6e9, dwell_s = 2.5 / 110.0;
  for (const double off_deg : {2.0, 30.0, 50.0}) {
    const double looks =
        std::max(1.0, 2.0 * speed_mps * beam_rad * std::sin(off_deg * geo::kRadiansPerDegree) * dwell_s / wavelength_m);
    expect_row({"Speckle", "looks " + std::to_string(static_cast<int>(off_deg)) + "° off the track, 480 kt", looks,
                0.07 * looks, "", "2 V θ sin φ T/λ, at least 1: Doppler spread times dwell, Skolnik 2001, chapter 7",
                "a whole number of looks; 8 bits"},
               looks_of_scan(off_deg));
  }
}

TEST(Truth, SpeckleHasTheQuantilesOfGammaVariates) {
  struct Quantile {
    int looks;
    double percent, chi_square;
  };
  for (const auto& [looks, percent, chi_square] :
       {Quantile{1, 95.0, 5.991}, {4, 5.0, 2.733}, {4, 95.0, 15.507}, {8, 95.0, 26.296}, {16, 5.0, 20.072}}) {
    const auto level = static_cast<std::size_t>(percent / 100.0 * static_cast<double>(physics::kSpeckleLevels));
    expect_row(
        {"Speckle", std::to_string(static_cast<int>(percent)) + " % of the speckle of " + looks_of(looks) + " is below",
         chi_square / (2.0 * looks), 0.005, "",
         "χ² of 2L degrees of freedom over 2L, Abramowitz and Stegun, table 26.8", "4,096 levels"},
        static_cast<double>(physics::speckle_levels(looks)[level]));
  }
}

// <I^2> / <I>^2 of single-look ground with a texture.
double second_moment(double shape) {
  radar::RadarConfiguration configuration;
  configuration.world.land.texture = shape;
  physics::SurfaceReturn surface(configuration);
  surface.use_texture({.pulse_length_m = 30.0, .spacing_m = 30.0});
  constexpr std::size_t kCells = 1000;
  std::vector<float> variates(kCells + 16);
  Moments intensity;
  for (std::uint32_t row = 0; row < 1000; ++row) {
    physics::simd::speckle(kCells, physics::make_noise_state({1, 1, row}), 1, {}, variates.data());
    for (std::size_t column = 0; column < kCells; ++column) {
      const geo::GeoPoint position{37.0 + 0.0005 * row, -122.0 + 0.0005 * static_cast<double>(column)};
      const double mean = surface.at({position, {}, 0.1}).gamma;
      intensity.add(mean * static_cast<double>(variates[column]));
    }
  }
  return intensity.squares / intensity.count / (intensity.mean() * intensity.mean());
}

TEST(Truth, TexturedGroundIsKDistributed) {
  for (const auto& [name, shape, outside] : {std::tuple("1", 1.0, 4.0), {"8", 8.0, 2.25}})
    expect_row(
        {"Texture", std::string("⟨I²⟩/⟨I⟩² of textured land, one look, shape ") + name, outside, 0.02 * outside, "",
         "K distribution: 2 (1 + 1/ν), Ward, Tough and Watts 2013", "a million samples; 256 levels of texture"},
        second_moment(shape));
}

const std::string kInterim =
    "Billingsley's interim clutter model, cells of 1,000 m², as quoted by the program of J. Champagne 2019";

TEST(Truth, LandHasTheWeibullSlopesOfMeasurements) {
  constexpr double kCell_m2 = 1000.0;
  for (const auto& [angle, grazing_deg, outside] : {std::tuple("0 to 0.25°", 0.125, 3.8),
                                                    {"0.25 to 0.75°", 0.5, 3.5},
                                                    {"0.75 to 1.5°", 1.125, 3.0},
                                                    {"1.5 to 4°", 2.75, 2.7},
                                                    {"4°", 4.0, 2.6}})
    expect_row({"Texture", std::string("Weibull slope of rural land, depression ") + angle, outside, 0.02, "", kInterim,
                "the middle of the class"},
               physics::weibull_slope(physics::LandKind::rural, grazing_deg, kCell_m2));
  expect_row({"Texture", "Weibull slope of forest, desert, marsh and grassland, depression above 1°", 2.0, 0.15, "",
              kInterim, "one share of the rural slope for all angles"},
             physics::weibull_slope(physics::LandKind::even, 1.125, kCell_m2));
}

// Variance / mean^2 of the texture in sweeps over level land: of their power over that without texture.
double land_variance(double range_nm, std::size_t sample) {
  constexpr double kAltitude_m = 6096.0;
  radar::RadarConfiguration configuration;
  model::rbm::Beam textured(configuration);
  configuration.world.land.texture = 0.0;
  model::rbm::Beam even(configuration);
  const model::terrain::AnalyticTerrain plain(model::terrain::flat(1.0));
  const std::size_t samples = static_cast<std::size_t>(configuration.fidelity.samples);
  std::vector<float> power(samples), mean(samples);
  Moments relative;
  for (int sweep = 0; sweep < 1500; ++sweep) {
    const physics::SweepGeometry geometry{{37.0, 0.23 * sweep - 170.0},
                                          geo::AltitudeMsl::metres(kAltitude_m),
                                          geo::Bearing::degrees(0.7 * sweep),
                                          geo::Angle::degrees(-5.0),
                                          geo::Length::nautical_miles(range_nm)};
    for (model::rbm::Beam* beam : {&textured, &even}) {
      beam->begin_pass();
      beam->measure(geometry, plain, beam == &textured ? power : mean);
    }
    for (std::size_t i = sample - 20; i <= sample + 20; i += 10)
      relative.add(static_cast<double>(power[i]) / static_cast<double>(mean[i]));
  }
  return relative.squares / relative.count / (relative.mean() * relative.mean()) - 1.0;
}

TEST(Truth, TextureOfLandInSweepsHasTheVarianceOfItsWeibullSlope) {
  struct Point {
    std::string of;
    double range_nm;
    std::size_t sample;
    double outside;
  };
  for (const Point& point : {Point{"20 NM, in 16 NM", 20.0, 384, 0.535},
                             {"20 NM, in 8 NM", 20.0, 192, 0.400},
                             {"80 NM, in 64 NM", 80.0, 384, 0.655}})
    expect_row({"Texture", "variance / mean² of the texture of sweeps over level land, 20,000 ft, range " + point.of,
                point.outside, 0.25 * point.outside, "",
                "½ Γ(1 + 2a) / Γ(1 + a)² − 1 by hand, a the slope of docs/spec/physics.md#texture",
                "one formula for the cells in a beam of any width"},
               land_variance(point.range_nm, point.sample));
}

}  // namespace
}  // namespace yars::truth

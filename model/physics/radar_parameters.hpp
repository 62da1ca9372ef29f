// Parameters of one radar for sweeps and maps: sections of its configuration, and values that many source files use.
// Inputs: a structure that has all sections, such as radar::RadarConfiguration.
// Outputs: references to sections, and plain values. Code that reads a member of a section includes the header of the
// section.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "lib/radar/modes.hpp"

namespace yars::radar {
struct AntennaConfiguration;
struct Fidelity;
struct HighResolutionConfiguration;
struct ReceiverConfiguration;
struct WorldConfiguration;
}  // namespace yars::radar

namespace yars::model::physics {

class Refraction;

// Parameters of a configuration that determine the geometry of a sweep.
struct GeometryParameters {
  // Converts from radar::RadarConfiguration.
  template <class Configuration>
    requires requires(const Configuration& whole) { whole.fidelity.posts_per_sample; }
  GeometryParameters(const Configuration& whole)
      : earth(whole.fidelity.earth),
        earth_radius_factor(whole.fidelity.earth_radius_factor),
        geodesic_knots(whole.fidelity.geodesic_knots),
        slant_range(whole.fidelity.slant_range),
        exact(whole.fidelity.algorithm == radar::Algorithm::reference) {
    use_air(whole.world.atmosphere.refractivity, whole.world.atmosphere.refractivity_per_km);
  }

  radar::EarthModel earth;
  double earth_radius_factor;                    // effective earth radius factor k; NaN: `refraction` bends the rays
  std::shared_ptr<const Refraction> refraction;  // null with a factor, and on a flat earth
  int geodesic_knots;  // number of exact positions of a sweep, see sample_positions() in ray.hpp
  bool slant_range;    // samples at equal steps of slant range instead of ground range
  bool exact;          // traced rays, instead of their series

 private:
  void use_air(double refractivity, double refractivity_per_km);
};

// Parameters of one radar. Keeps references to the configuration that is passed to the constructor.
struct RadarParameters {
  template <class Configuration>
    requires requires(const Configuration& whole) { whole.high_resolution.looks; }
  RadarParameters(const Configuration& whole)
      : ranges_nm(whole.ranges_nm),
        pulse_us(whole.pulse_us),
        antenna(whole.antenna),
        fidelity(whole.fidelity),
        receiver(whole.receiver),
        high_resolution(whole.high_resolution),
        world(whole.world),
        geometry(whole),
        beam(whole.fidelity.beam),
        interpolation(whole.fidelity.interpolation),
        algorithm(whole.fidelity.algorithm),
        noise(whole.fidelity.noise),
        samples(static_cast<std::size_t>(std::clamp(whole.fidelity.samples, 1, radar::kMaxSamples))),
        frequency_ghz(whole.receiver.frequency_ghz),
        azimuth_beamwidth_deg(whole.antenna.azimuth_beamwidth_deg),
        elevation_beamwidth_deg(whole.antenna.elevation_beamwidth_deg),
        seed(whole.seed) {}

  const std::vector<double>& ranges_nm;  // [NM] selectable, ascending
  const std::vector<double>& pulse_us;   // [us] pulse duration for each range; ranges beyond the list have the last one
  const radar::AntennaConfiguration& antenna;
  const radar::Fidelity& fidelity;
  const radar::ReceiverConfiguration& receiver;
  const radar::HighResolutionConfiguration& high_resolution;
  const radar::WorldConfiguration& world;
  GeometryParameters geometry;
  radar::BeamPattern beam;
  radar::Interpolation interpolation;
  radar::Algorithm algorithm;
  // Fluctuation of sweeps (speckle, thermal noise, texture) and of patch maps (speckle). False: the mean power of
  // thermal noise remains.
  bool noise;
  std::size_t samples;  // number of samples of a sweep, clamped to [1, kMaxSamples]
  double frequency_ghz;
  double azimuth_beamwidth_deg;    // [deg] one-way 3 dB
  double elevation_beamwidth_deg;  // [deg] one-way 3 dB
  std::uint64_t seed;              // seed of all noise
};

}  // namespace yars::model::physics

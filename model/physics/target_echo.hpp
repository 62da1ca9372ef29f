// Cross section of a point target as a radar sees it: fluctuation from scan to scan, and aspect of corner reflectors.
// Inputs: target, number of the scan or map, direction to the radar. Outputs: cross section [m^2].
// Equal seeds, scans and targets give equal bits.
// Source: docs/spec/physics.md#targets.
#pragma once

#include <cstdint>

#include "lib/geo/geodesy.hpp"
#include "lib/radar/modes.hpp"
#include "model/physics/radar_parameters.hpp"
#include "model/physics/sweep_geometry.hpp"

namespace yars::model::physics {

struct PointTarget {
  double cross_section_m2 = 0.0;  // mean; of a reflector: on its axis
  radar::TargetEcho echo = radar::TargetEcho::swerling1;
  std::uint64_t number = 0;  // targets of different numbers fluctuate independently
  int facing_deg = 0;        // true azimuth of a reflector's axis
  int tilt_deg = 0;          // elevation of a reflector's axis
};

// Direction from a target to the radar.
struct Aspect {
  double azimuth_rad = 0.0;    // true
  double elevation_rad = 0.0;  // above the horizontal at the target
};

Aspect aspect_of(geo::GeoPoint target, geo::GeoPoint radar, const Sight& sight);

// Factor of mean 1 on a cross section: exponential (case 1), chi-square with 4 degrees of freedom (case 3), else 1.
// Source: Swerling 1954, RAND RM-1217.
double swerling_factor(radar::TargetEcho echo, std::uint64_t seed, std::uint32_t scan, std::uint64_t target);

// Cross section of a reflector over that on its axis, [0, 1].
double reflector_gain(const PointTarget& target, double frequency_ghz, Aspect to_radar);

class TargetEchoes {
 public:
  explicit TargetEchoes(const RadarParameters& parameters);

  // `aspect` is called for reflectors alone, and returns the Aspect of the target.
  template <class AspectOf>
  double cross_section_m2(const PointTarget& target, std::uint32_t scan, const AspectOf& aspect) const {
    if (radar::is_reflector(target.echo))
      return target.cross_section_m2 * reflector_gain(target, frequency_ghz_, aspect());
    if (!fluctuate_) return target.cross_section_m2;
    return target.cross_section_m2 * swerling_factor(target.echo, seed_, scan, target.number);
  }

 private:
  bool fluctuate_;
  double frequency_ghz_;
  std::uint64_t seed_;
};

}  // namespace yars::model::physics

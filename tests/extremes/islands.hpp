// Terrain with a known result: an island surrounded by voids. Voids return no power with any algorithm, so samples with
// power show the position of the island. The configurations have no smear, no noise and a beam 180 degrees wide.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "lib/geo/geodesy.hpp"
#include "model/rbm/algorithm.hpp"
#include "model/rbm/beam.hpp"
#include "tests/model/physics/ground.hpp"

namespace yars::test {

inline constexpr radar::Algorithm kAlgorithms[] = {radar::Algorithm::standard, radar::Algorithm::reference,
                                                   radar::Algorithm::report_1996};
inline constexpr radar::BeamPattern kBeams[] = {radar::BeamPattern::hard_edge, radar::BeamPattern::gaussian,
                                                radar::BeamPattern::cosecant_squared, radar::BeamPattern::mapping};
inline constexpr double kVoid_m = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kIslandHeight_m = 500.0;

inline std::string name_of(radar::Algorithm algorithm) {
  switch (algorithm) {
    case radar::Algorithm::standard:
      return "standard";
    case radar::Algorithm::reference:
      return "reference";
    case radar::Algorithm::report_1996:
      break;
  }
  return "report-1996";
}

// Calls `body` with a configuration for each algorithm. A failure names the algorithm.
template <class Body>
void for_each_algorithm(int samples, const Body& body) {
  for (const radar::Algorithm algorithm : kAlgorithms) {
    SCOPED_TRACE(name_of(algorithm));
    radar::RadarConfiguration configuration = bare_configuration(samples);
    configuration.fidelity.algorithm = algorithm;
    configuration.fidelity.earth = radar::EarthModel::ellipsoid;
    body(configuration);
  }
}

// Calls `body` for each algorithm and beam pattern. The algorithm of the 1996 report ignores the beam pattern, and has
// one call.
template <class Body>
void for_each_algorithm_and_beam(int samples, const Body& body) {
  for_each_algorithm(samples, [&body](radar::RadarConfiguration& configuration) {
    for (const radar::BeamPattern beam : kBeams) {
      SCOPED_TRACE("beam pattern " + std::to_string(static_cast<int>(beam)));
      configuration.fidelity.beam = beam;
      body(configuration);
      if (configuration.fidelity.algorithm == radar::Algorithm::report_1996) break;
    }
  });
}

inline bool is_dark(const std::vector<float>& power) {
  for (const float value : power)
    if (value != 0.0F) return false;
  return true;
}

// Power of the samples of one sweep. Expects that each is finite and not negative.
inline std::vector<float> seen(const radar::RadarConfiguration& configuration,
                               const model::physics::SweepGeometry& geometry,
                               const model::terrain::TerrainView& terrain) {
  model::rbm::Beam algorithm(configuration);
  std::vector<float> power(model::rbm::sample_count(configuration), -1.0F);
  algorithm.measure(geometry, terrain, power);
  for (std::size_t i = 0; i < power.size(); ++i)
    EXPECT_TRUE(std::isfinite(power[i]) && power[i] >= 0.0F) << "sample " << i << ": " << power[i];
  return power;
}

inline model::physics::SweepGeometry geometry_from(geo::GeoPoint apex, double azimuth_deg, double altitude_m,
                                                   double range_m) {
  model::physics::SweepGeometry geometry = geometry_north(altitude_m, range_m, apex);
  geometry.azimuth = geo::Bearing::degrees(azimuth_deg);
  return geometry;
}

// A disc of elevation kIslandHeight_m about `middle`, void elsewhere.
inline model::terrain::AnalyticTerrain island_at(geo::GeoPoint middle, double radius_m) {
  return model::terrain::AnalyticTerrain([middle, radius_m](geo::GeoPoint position) {
    return geo::geodesic_inverse(middle, position).distance.metres() < radius_m ? kIslandHeight_m : kVoid_m;
  });
}

// Expects power from `near_m` to `far_m` and nowhere else, with a tolerance of two samples: one for the position of a
// sample's middle, one for the report's averaging of neighbours.
inline void expect_lit_between(const std::vector<float>& power, double range_m, double near_m, double far_m) {
  const double spacing_m = range_m / static_cast<double>(power.size());
  for (std::size_t i = 0; i < power.size(); ++i) {
    const double distance_m = (static_cast<double>(i) + 0.5) * spacing_m;
    if (distance_m > near_m + 2.0 * spacing_m && distance_m < far_m - 2.0 * spacing_m) {
      EXPECT_GT(power[i], 0.0F) << "at " << distance_m << " m, between " << near_m << " and " << far_m;
    }
    if (distance_m < near_m - 2.0 * spacing_m || distance_m > far_m + 2.0 * spacing_m) {
      EXPECT_EQ(power[i], 0.0F) << "at " << distance_m << " m, not between " << near_m << " and " << far_m;
    }
  }
}

}  // namespace yars::test

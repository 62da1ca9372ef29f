// Sweeps with minimum and maximum range and with minimum and maximum number of samples.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "lib/radar/modes.hpp"
#include "tests/extremes/islands.hpp"
#include "tests/model/kernel/cockpit.hpp"

namespace yars::model {
namespace {

using test::expect_lit_between;
using test::geometry_from;
using test::seen;

TEST(ExtremeSampling, AtRangesFrom0Point1To320NauticalMilesAnIslandIsSeenAtItsDistance) {
  for (const double range_nm : {0.1, 0.25, 0.67, 1.0, 4.7, 40.0, 160.0, 320.0}) {
    SCOPED_TRACE(range_nm);
    const double range_m = geo::Length::nautical_miles(range_nm).metres();
    const double azimuth_deg = 72.0;
    const geo::GeoPoint middle = geo::geodesic_direct(test::kMidLatitude, geo::Bearing::degrees(azimuth_deg),
                                                      geo::Length::metres(0.6 * range_m));
    const terrain::AnalyticTerrain island = test::island_at(middle, 0.05 * range_m);
    test::for_each_algorithm_and_beam(240, [&](const radar::RadarConfiguration& configuration) {
      // At an altitude of 20 km even the far end of a range of 320 NM is above the horizon.
      const double altitude_m = range_nm > 100.0 ? 20000.0 : 600.0 + 0.1 * range_m;
      expect_lit_between(
          seen(configuration, geometry_from(test::kMidLatitude, azimuth_deg, altitude_m, range_m), island), range_m,
          0.55 * range_m, 0.65 * range_m);
    });
  }
}

TEST(ExtremeSampling, With1To3And4096SamplesTheIslandIsInTheSampleThatContainsIt) {
  constexpr double kRange_m = 40000.0;
  for (const int samples : {1, 2, 3, radar::kMaxSamples}) {
    SCOPED_TRACE(samples);
    const double spacing_m = kRange_m / samples;
    const auto island_index = static_cast<std::size_t>(samples - 1);  // the last sample
    const geo::GeoPoint middle = geo::geodesic_direct(
        test::kMidLatitude, geo::Bearing(), geo::Length::metres((static_cast<double>(island_index) + 0.5) * spacing_m));
    const terrain::AnalyticTerrain island = test::island_at(middle, 0.4 * spacing_m);
    test::for_each_algorithm_and_beam(samples, [&](const radar::RadarConfiguration& configuration) {
      const auto power = seen(configuration, geometry_from(test::kMidLatitude, 0.0, 3000.0, kRange_m), island);
      ASSERT_EQ(power.size(), static_cast<std::size_t>(samples));
      EXPECT_GT(power[island_index], 0.0F);
      for (std::size_t i = 0; i + 1 < island_index; ++i) ASSERT_EQ(power[i], 0.0F) << i;
    });
  }
}

TEST(ExtremeSampling, ANumberOfSamplesBeyondItsLimitsIsClamped) {
  radar::RadarConfiguration configuration;
  for (const auto& [asked, given] : {std::pair{-5, 1}, {0, 1}, {4097, 4096}, {2000000000, 4096}}) {
    configuration.fidelity.samples = asked;
    EXPECT_EQ(rbm::sample_count(configuration), static_cast<std::size_t>(given));
  }
}

TEST(ExtremeSampling, TheKernelMakesSweepsOf1To3And4096SamplesAt0Point1And320NauticalMiles) {
  for (const int samples : {1, 2, 3, radar::kMaxSamples}) {
    for (const double range_nm : {0.1, 320.0}) {
      SCOPED_TRACE(std::to_string(samples) + " samples, " + std::to_string(range_nm) + " NM");
      test::for_each_algorithm(samples, [&](radar::RadarConfiguration& configuration) {
        configuration.fidelity.azimuth_smear = configuration.fidelity.pulse_smear = true;
        configuration.fidelity.noise = true;
        test::Cockpit cockpit(configuration);
        cockpit.tick.command.range_nm = range_nm;
        cockpit.tick.command.antenna_elevation_deg = 0.0;
        const auto sweeps = cockpit.run(110);
        ASSERT_FALSE(sweeps.empty());
        for (const auto& sweep : sweeps) {
          ASSERT_EQ(sweep.samples, static_cast<std::uint32_t>(samples));
          ASSERT_DOUBLE_EQ(sweep.range_m, range_nm * geo::kMetresPerNauticalMile);
          ASSERT_EQ(sweep.flags & databuffer::kSweepBlank, 0U);
        }
        // Level land 4472 m below the aircraft is lit by a beam 180 degrees wide. The middle of 320 NM is beyond the
        // horizon.
        const auto& last = sweeps.back();
        if (range_nm < 1.0) {
          EXPECT_GT(*std::max_element(last.video, last.video + last.samples), 0);
        }
      });
    }
  }
}

}  // namespace
}  // namespace yars::model

// Positions of samples against the exact geodesic, within the bounds stated in model/physics/ray.hpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "lib/geo/geodesy.hpp"
#include "model/physics/ray.hpp"
#include "tests/lib/simd/vector_targets.hpp"

namespace yars::model::rbm {
namespace {

// Maximum distance [m] between positions of a ray's samples and the exact geodesic, for every eleventh sample.
double max_error_m(geo::GeoPoint apex, geo::Bearing azimuth, geo::Length range, std::size_t count) {
  std::vector<float> distance_m(count + terrain::kRunSlack);
  for (std::size_t i = 0; i < count; ++i)
    distance_m[i] = static_cast<float>(range.metres() * static_cast<double>(i) / static_cast<double>(count - 1));
  physics::PositionArrays positions(count);
  physics::sample_positions(apex, azimuth, range, 5, distance_m.data(), positions);
  const geo::GeodesicRay ray(apex, azimuth);
  double worst_m = 0.0;
  for (std::size_t i = 0; i < count; i += 11) {
    const geo::GeoPoint exact = ray.position(geo::Length::metres(static_cast<double>(distance_m[i])));
    geo::GeoPoint found = position_of(positions.run(), i);
    found.longitude_deg = geo::wrapped_degrees(found.longitude_deg);
    worst_m = std::max(worst_m, geo::geodesic_inverse(exact, found).distance.metres());
  }
  return worst_m;
}

// The numbers of samples include rays that are divided into pieces of both sizes, and undivided rays.
TEST(SamplePositions, LieWithinHalfAMetreOfTheGeodesicAtEveryLatitude) {
  double worst_m = 0.0;
  for (const std::size_t count : {2U, 15U, 16U, 17U, 191U, 200U, 480U, 1024U}) {
    for (const double range_nm : {4.7, 10.0, 20.0, 40.0, 80.0, 160.0}) {
      const geo::Length range = geo::Length::nautical_miles(range_nm);
      for (const double latitude : {0.0, 37.0, -60.0, 70.0, 73.9, 74.1, 80.0, 88.0, 89.0, -89.9, 90.0}) {
        for (double azimuth = 0.0; azimuth < 360.0; azimuth += 22.5) {
          const double error_m = max_error_m({latitude, 179.7}, geo::Bearing::degrees(azimuth), range, count);
          worst_m = std::max(worst_m, error_m);
          ASSERT_LT(error_m, 0.5) << "latitude " << latitude << ", azimuth " << azimuth << ", " << range_nm << " NM, "
                                  << count << " samples";
        }
      }
    }
  }
  RecordProperty("worst_m", std::to_string(worst_m));
}

TEST(SamplePositions, AreEqualOnEveryVectorTarget) {
  for (const std::size_t count : {1U, 17U, 191U, 480U})
    for (const double latitude : {37.0, 89.0, 90.0}) {
      std::vector<float> distance_m(count + physics::kPairSlack);
      for (std::size_t i = 0; i < distance_m.size(); ++i)
        distance_m[i] = 300.0F * static_cast<float>(std::min(i, count));
      const auto sampled = [&] {
        physics::PositionArrays positions(count);
        physics::sample_positions({latitude, 179.7}, geo::Bearing::degrees(20.0), geo::Length::metres(150'000.0), 5,
                                  distance_m.data(), positions);
        const terrain::PositionRun run = positions.run();
        std::vector<float> all(run.cells_north.begin(), run.cells_north.end());
        for (const auto& values : {run.cells_east, run.north_deg, run.east_deg})
          all.insert(all.end(), values.begin(), values.end());
        return all;
      };
      const std::vector<float> expected = sampled();
      test::for_each_vector_target(
          [&](const char* target) { EXPECT_EQ(sampled(), expected) << target << ", " << count << ", " << latitude; });
    }
}

// What a sampler keeps of the last apex is not used for another apex or range.
TEST(SamplePositions, DoNotDependOnTheRaysBefore) {
  std::vector<float> distance_m(200 + physics::kPairSlack);
  for (std::size_t i = 0; i < distance_m.size(); ++i)
    distance_m[i] = 90.0F * static_cast<float>(std::min<std::size_t>(i, 200));
  physics::PositionSampler sampler;
  physics::PositionArrays found(200), expected(200);
  for (const geo::GeoPoint apex : {geo::GeoPoint{37.0, 20.0}, {37.0, 20.5}, {37.5, 20.5}, {89.9, 20.5}, {37.5, 20.5}})
    for (const double range_m : {18e3, 300e3, 18e3})
      for (const double azimuth_deg : {10.0, 200.0}) {
        const geo::Bearing azimuth = geo::Bearing::degrees(azimuth_deg);
        const geo::Length range = geo::Length::metres(range_m);
        sampler.sample(apex, azimuth, range, 5, distance_m.data(), found);
        physics::sample_positions(apex, azimuth, range, 5, distance_m.data(), expected);
        ASSERT_EQ(found.north_deg, expected.north_deg) << apex.latitude_deg << ' ' << azimuth_deg << ' ' << range_m;
        ASSERT_EQ(found.east_deg, expected.east_deg) << apex.latitude_deg << ' ' << azimuth_deg << ' ' << range_m;
        ASSERT_EQ(found.cells_north, expected.cells_north);
        ASSERT_EQ(found.cells_east, expected.cells_east);
      }
}

TEST(SamplePositions, LieWithinMillimetresAtMiddleLatitudes) {
  for (const std::size_t count : {2U, 17U, 191U, 200U, 480U, 1024U})
    for (const double range_nm : {4.7, 40.0, 160.0})
      for (const double latitude : {0.5, 37.0, -60.0})
        for (double azimuth = 0.0; azimuth < 360.0; azimuth += 22.5)
          ASSERT_LT(max_error_m({latitude, 179.7}, geo::Bearing::degrees(azimuth),
                                geo::Length::nautical_miles(range_nm), count),
                    0.008)
              << "latitude " << latitude << ", azimuth " << azimuth << ", " << range_nm << " NM, " << count
              << " samples";
}

}  // namespace
}  // namespace yars::model::rbm

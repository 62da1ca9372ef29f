// PatchGeometry: positions on a map and back, and the displacement of a raised point (layover).
#include "model/hrm/patch_geometry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lib/radar/fidelity.hpp"
#include "tests/model/hrm/patch_maker.hpp"

namespace yars::test {
namespace {

using hrm::MapPoint;
using hrm::PatchGeometry;

TEST(PatchGeometry, ReturnsAPositionWithinAMillimetreAnywhereOnEarth) {
  for (const geo::GeoPoint target : {kTarget, geo::GeoPoint{80.0, 20.0}, geo::GeoPoint{-12.0, 179.95},
                                     geo::GeoPoint{89.7, -60.0}, geo::GeoPoint{0.0, 0.0}}) {
    for (const double from_deg : {0.0, 90.0, 200.0, 300.0}) {
      Viewpoint view;
      view.target = target;
      view.from_deg = from_deg;
      view.distance_m = 80.0 * geo::kMetresPerNauticalMile;
      const PatchGeometry geometry(order_from(view), radar::Fidelity(), 0.0);
      for (const MapPoint point : {MapPoint{0.0, 0.0}, MapPoint{9000.0, -7000.0}, MapPoint{-400.0, 30000.0}}) {
        const MapPoint back = geometry.point_of(geometry.position_of(point));
        EXPECT_NEAR(back.right_m, point.right_m, 1e-3) << target.latitude_deg << ' ' << from_deg;
        EXPECT_NEAR(back.up_m, point.up_m, 1e-3) << target.latitude_deg << ' ' << from_deg;
      }
      const MapPoint centre = geometry.point_of(target);
      EXPECT_NEAR(std::hypot(centre.right_m, centre.up_m), 0.0, 1e-3);
    }
  }
}

TEST(PatchGeometry, LaysARaisedPointOverToTheGroundAtItsSlantRange) {
  for (const double distance_m : {5000.0, 37040.0, 148160.0}) {
    for (const double above_m : {1500.0, 4572.0, 12000.0}) {
      Viewpoint view;
      view.distance_m = distance_m;
      view.above_m = above_m;
      const PatchGeometry geometry(order_from(view), radar::Fidelity(), kGround_m);
      for (const double height_m : {-100.0, 20.0, 400.0}) {
        const double slant_m = geometry.earth().sight(above_m, distance_m, height_m).slant_range_m;
        const double exact_m = geometry.earth().distance_at_slant_range(above_m, 0.0, slant_m);
        const double laid_m = hrm::laid_over_m(distance_m, height_m, geometry.above_level_m(distance_m));
        EXPECT_NEAR(laid_m - distance_m, exact_m - distance_m, 0.02 + 0.003 * std::abs(exact_m - distance_m))
            << distance_m << ' ' << above_m << ' ' << height_m;
      }
    }
  }
}

}  // namespace
}  // namespace yars::test

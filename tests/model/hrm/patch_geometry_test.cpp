// PatchGeometry: positions on a map and back, the displacement of a raised point (layover), and tiles of a scene.
#include "model/hrm/patch_geometry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lib/radar/fidelity.hpp"
#include "model/hrm/scene_raster.hpp"
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
      const PatchGeometry geometry(order_from(view), radar::RadarConfiguration(), 0.0);
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
      const PatchGeometry geometry(order_from(view), radar::RadarConfiguration(), kGround_m);
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

// Tiles on the grid points of a coarse grid, at its corners too, are placed; tiles ten windows away are not.
TEST(PlacedTiles, AreThoseOnThePolarGridAnywhereOnEarth) {
  constexpr int kPixels = 48;
  for (const geo::GeoPoint target : {kTarget, geo::GeoPoint{72.0, 20.0}, geo::GeoPoint{-12.0, 179.95},
                                     geo::GeoPoint{89.0, -60.0}, geo::GeoPoint{0.0, 0.0}}) {
    for (const double window_nm : {0.67, 20.0, 80.0}) {
      Viewpoint view;
      view.target = target;
      view.from_deg = 310.0;
      view.window_m = window_nm * geo::kMetresPerNauticalMile;
      view.distance_m = std::max(20'000.0, 1.5 * view.window_m);
      const PatchGeometry geometry(order_from(view), radar::RadarConfiguration(), kGround_m);
      const hrm::PolarGrid grid = hrm::make_polar_grid(geometry, kPixels, 1, {0.3 * view.window_m, view.window_m});
      std::vector<model::scene::Tile> tiles;
      const auto add = [&](double right_m, double ahead_m) {
        tiles.emplace_back().origin = geometry.position_of({right_m, ahead_m - geometry.distance_m()});
      };
      for (int column = 1; column < grid.columns; column += grid.columns / 4)
        for (int row = 1; row < grid.rows; row += grid.rows / 5) {
          const double ahead_m = grid.distance_m(row) / std::hypot(1.0, grid.tangent(column));
          add(grid.tangent(column) * ahead_m, ahead_m);
        }
      const std::size_t on_grid = tiles.size();
      for (const double right : {-10.0, 10.0}) add(right * view.window_m, view.distance_m);
      std::vector<const model::scene::Tile*> pointers;
      for (const model::scene::Tile& tile : tiles) pointers.push_back(&tile);
      EXPECT_EQ(hrm::place_tiles(geometry, grid, pointers, {}).size(), on_grid)
          << target.latitude_deg << ", " << window_nm << " NM";
    }
  }
}

}  // namespace
}  // namespace yars::test

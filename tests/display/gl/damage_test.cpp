// Damage: its rectangles cover what was marked, do not overlap, and stay near what was marked.
#include "display/gl/damage.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

namespace yars::display::gl {
namespace {

int covers(const Damage& damage, float x, float y) {
  return static_cast<int>(std::ranges::count_if(damage.rects(), [&](const Rect& rect) {
    return x >= rect.left && x < rect.right && y >= rect.top && y < rect.bottom;
  }));
}

TEST(Damage, ANewOneIsEmptyAndAllIsOneRectangle) {
  Damage damage(100);
  EXPECT_TRUE(damage.empty());
  EXPECT_TRUE(damage.rects().empty());
  damage.mark({10.0F, 10.0F, 11.0F, 11.0F});
  damage.mark_all();
  ASSERT_EQ(damage.rects().size(), 1U);
  EXPECT_EQ(damage.rects()[0], (Rect{0.0F, 0.0F, 100.0F, 100.0F}));
  damage.clear();
  EXPECT_TRUE(damage.empty());
}

TEST(Damage, ABoxMarksItsTilesAlone) {
  Damage damage(100);
  damage.mark({17.0F, 3.0F, 40.0F, 5.0F});
  ASSERT_EQ(damage.rects().size(), 1U);
  EXPECT_EQ(damage.rects()[0], (Rect{16.0F, 0.0F, 48.0F, 16.0F}));
  damage.mark({90.0F, 90.0F, 300.0F, 300.0F});  // the last tiles are cut off by the picture's edge
  EXPECT_EQ(damage.bounds(), (Rect{16.0F, 0.0F, 100.0F, 100.0F}));
  damage.clear();
  damage.mark({-50.0F, 20.0F, -1.0F, 30.0F});
  damage.mark({20.0F, 101.0F, 30.0F, 130.0F});
  EXPECT_TRUE(damage.empty());
  damage.mark({20.0F, std::numeric_limits<float>::quiet_NaN(), 30.0F, 40.0F});
  EXPECT_TRUE(damage.is_all());
}

// Random triangles: each point of the triangle is in exactly one rectangle; no rectangle is far from it.
TEST(Damage, APolygonIsCoveredOnceAndClosely) {
  constexpr unsigned kSeed = 7;
  constexpr float kMargin = 1.5F;
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<float> position(-60.0F, 360.0F), share(0.0F, 1.0F);
  for (int round = 0; round < 300; ++round) {
    Damage damage(300);
    const std::array<Point, 3> corners{Point{position(random), position(random)},
                                       Point{position(random), position(random)},
                                       Point{position(random), position(random)}};
    damage.mark_polygon(corners, kMargin);
    for (int i = 0; i < 100; ++i) {
      const float a = share(random), b = share(random) * (1.0F - a), c = 1.0F - a - b;
      const float x = a * corners[0].x + b * corners[1].x + c * corners[2].x + (share(random) - 0.5F) * 2.0F * kMargin;
      const float y = a * corners[0].y + b * corners[1].y + c * corners[2].y + (share(random) - 0.5F) * 2.0F * kMargin;
      const bool inside = x >= 0.0F && x < 300.0F && y >= 0.0F && y < 300.0F;
      EXPECT_EQ(covers(damage, x, y), inside ? 1 : 0) << "seed " << kSeed << " round " << round << ' ' << x << ' ' << y;
    }
    const auto [left, right] = std::ranges::minmax(corners, {}, &Point::x);
    for (const Rect& rect : damage.rects()) {
      EXPECT_LE(rect.left, right.x + kMargin);
      EXPECT_GE(rect.right, left.x - kMargin);
    }
  }
}

TEST(Damage, ANarrowWedgeMarksFewTiles) {
  Damage damage(480);
  damage.mark_polygon(std::array{Point{240.0F, 440.0F}, Point{520.0F, 158.0F}, Point{524.0F, 162.0F}}, 1.25F);
  float area = 0.0F;
  for (const Rect& rect : damage.rects()) area += (rect.right - rect.left) * (rect.bottom - rect.top);
  EXPECT_LT(area, 480.0F * 480.0F / 10.0F);
}

TEST(Damage, AddTakesTheTilesOfAnotherPicture) {
  Damage inner(64), outer(128);
  inner.mark({20.0F, 20.0F, 25.0F, 25.0F});  // the tile 16..32
  outer.add(inner, 30, 40);                  // 46..62, 56..72
  EXPECT_EQ(outer.bounds(), (Rect{32.0F, 48.0F, 64.0F, 80.0F}));
  Damage same(64);
  same.add(inner);
  EXPECT_EQ(same.bounds(), inner.bounds());
  inner.mark_all();
  same.add(inner);
  EXPECT_TRUE(same.is_all());
}

TEST(Damage, VisitFindsTheRectanglesThatTouchABox) {
  Damage damage(100);
  damage.mark({0.0F, 0.0F, 10.0F, 10.0F});
  damage.mark({50.0F, 50.0F, 60.0F, 60.0F});
  const auto count = [&](const Rect& box) {
    int found = 0;
    damage.visit(box, [&](const Rect&) { ++found; });
    return found;
  };
  EXPECT_EQ(count({5.0F, 5.0F, 55.0F, 55.0F}), 2);
  EXPECT_EQ(count({5.0F, 5.0F, 6.0F, 6.0F}), 1);
  EXPECT_EQ(count({20.0F, 20.0F, 30.0F, 30.0F}), 0);
  EXPECT_EQ(count({-30.0F, -30.0F, 1.0F, 1.0F}), 1);
  EXPECT_EQ(count({-30.0F, 200.0F, 1000.0F, 300.0F}), 0);
  damage.mark_all();
  EXPECT_EQ(count({5.0F, 95.0F, 6.0F, 1e9F}), 1);
}

}  // namespace
}  // namespace yars::display::gl

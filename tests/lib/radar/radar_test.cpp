// Rules of lib/radar: range by height, windows of patch maps, sequence points, names of modes and settings.
// Also random::standard_normal(). Source: docs/pilots_manual.md#rule-1, #rule-4, #rule-11.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "databuffer/messages/derived_values.hpp"
#include "lib/radar/configuration.hpp"
#include "lib/radar/mission.hpp"
#include "lib/radar/modes.hpp"
#include "lib/random/counter_rng.hpp"

namespace yars::radar {
namespace {

using geo::Length;

double range_nm_at(double height_ft) {
  return range_by_height(Length::feet(height_ft), HeightRanges{}).nautical_miles();
}

TEST(RangeByHeight, IsTenTwentyOrFortyMiles) {
  EXPECT_EQ(range_nm_at(-50.0), 10.0);
  EXPECT_EQ(range_nm_at(500.0), 10.0);
  EXPECT_EQ(range_nm_at(500.1), 20.0);
  EXPECT_EQ(range_nm_at(1000.0), 20.0);
  EXPECT_EQ(range_nm_at(1000.1), 40.0);
  EXPECT_EQ(range_nm_at(std::numeric_limits<double>::quiet_NaN()), 40.0);
}

TEST(RangeByHeight, FollowsAConfiguredTable) {
  const HeightRanges table{{200, 3000, 9000}, {5, 20, 60, 90}};
  const auto miles = [&](double height_ft) { return range_by_height(Length::feet(height_ft), table).nautical_miles(); };
  EXPECT_EQ(miles(200.0), 5.0);
  EXPECT_EQ(miles(3000.0), 20.0);
  EXPECT_EQ(miles(3000.1), 60.0);
  EXPECT_EQ(miles(9000.1), 90.0);
}

TEST(RangeIndexFor, SelectsTheShortestSufficientRangeElseTheLongest) {
  const std::vector<double> apg70{4.7, 10, 20, 40, 80, 160};
  EXPECT_EQ(range_index_for(Length::nautical_miles(10.0), apg70), 1U);
  EXPECT_EQ(range_index_for(Length::nautical_miles(41.0), apg70), 4U);
  EXPECT_EQ(range_index_for(Length::nautical_miles(400.0), apg70), 5U);
  const std::vector<double> another{15, 30};
  EXPECT_EQ(range_index_for(Length::nautical_miles(10.0), another), 0U);
  EXPECT_EQ(range_index_for(Length::nautical_miles(40.0), another), 1U);
}

struct LimitsCase {
  double window_nm, min_range_nm, max_range_nm;
};

TEST(CursorLimits, EqualTheTableOfRule4) {
  for (const auto& [window_nm, min_range_nm, max_range_nm] :
       {LimitsCase{.67, 4.7, 20}, LimitsCase{1.3, 4.7, 40}, LimitsCase{3.3, 4.7, 50}, LimitsCase{4.7, 4.7, 80},
        LimitsCase{10, 10, 160}, LimitsCase{20, 20, 160}, LimitsCase{40, 40, 160}, LimitsCase{80, 80, 160}}) {
    const auto limits = cursor_limits(Length::nautical_miles(window_nm), WindowLimits{});
    ASSERT_TRUE(limits) << window_nm;
    EXPECT_EQ(limits->min.nautical_miles(), min_range_nm) << window_nm;
    EXPECT_EQ(limits->max.nautical_miles(), max_range_nm) << window_nm;
  }
  EXPECT_FALSE(cursor_limits(Length::nautical_miles(5.0), WindowLimits{}));
}

TEST(CursorLimits, FollowAConfiguredTable) {
  WindowLimits table;
  table.windows_nm = {2.5, 5};
  table.min_range_nm = {1, 3};
  table.max_range_nm = {12, 30};
  const auto limits = cursor_limits(Length::nautical_miles(5.0), table);
  ASSERT_TRUE(limits);
  EXPECT_EQ(limits->min.nautical_miles(), 3.0);
  EXPECT_EQ(limits->max.nautical_miles(), 30.0);
  EXPECT_FALSE(cursor_limits(Length::nautical_miles(4.7), table));
}

TEST(CursorLimits, IncludeBothEnds) {
  const CursorLimits limits = *cursor_limits(Length::nautical_miles(10.0), WindowLimits{});
  EXPECT_TRUE(limits.contains(Length::nautical_miles(10.0)));
  EXPECT_TRUE(limits.contains(Length::nautical_miles(160.0)));
  EXPECT_FALSE(limits.contains(Length::nautical_miles(9.99)));
  EXPECT_FALSE(limits.contains(Length::nautical_miles(160.1)));
}

TEST(CursorLimits, ExistForEveryWindowOfTheDefaultRadar) {
  for (const double window_nm : RadarConfiguration{}.windows_nm)
    EXPECT_TRUE(cursor_limits(Length::nautical_miles(window_nm), WindowLimits{})) << window_nm;
}

TEST(LargestWindowThatFits, IsNotLargerThanTheRange) {
  const std::vector<double> windows = RadarConfiguration{}.windows_nm;
  const auto fits = [&](double range_nm) {
    const auto index = largest_window_that_fits(Length::nautical_miles(range_nm), windows);
    return index ? windows[*index] : 0.0;
  };
  EXPECT_EQ(fits(160.0), 80.0);
  EXPECT_EQ(fits(80.0), 80.0);
  EXPECT_EQ(fits(40.0), 40.0);
  EXPECT_EQ(fits(4.7), 4.7);
  EXPECT_EQ(fits(4.69), 3.3);
  EXPECT_EQ(fits(0.5), 0.0);
}

TEST(WindowOfBlankSelection, FollowsTheCursorsRange) {
  const auto window_nm = [](double range_nm) {
    const auto window = window_of_blank_selection(Length::nautical_miles(range_nm), WindowLimits{});
    return window ? window->nautical_miles() : 0.0;
  };
  EXPECT_EQ(window_nm(2.69), 0.0);
  EXPECT_EQ(window_nm(2.7), 3.3);
  EXPECT_EQ(window_nm(50.0), 3.3);
  EXPECT_EQ(window_nm(50.01), 4.7);
  EXPECT_EQ(window_nm(80.0), 4.7);
  EXPECT_EQ(window_nm(80.01), 10.0);
  EXPECT_EQ(window_nm(150.0), 10.0);
  EXPECT_EQ(window_nm(150.01), 0.0);
  EXPECT_EQ(window_nm(std::numeric_limits<double>::quiet_NaN()), 0.0);
}

TEST(WindowOfBlankSelection, FollowsAConfiguredTable) {
  WindowLimits table;
  table.blank_min_range_nm = 1.0;
  table.blank_windows_nm = {2.5, 5};
  table.blank_max_range_nm = {12, 30};
  EXPECT_FALSE(window_of_blank_selection(Length::nautical_miles(0.9), table));
  EXPECT_EQ(window_of_blank_selection(Length::nautical_miles(12.0), table), Length::nautical_miles(2.5));
  EXPECT_EQ(window_of_blank_selection(Length::nautical_miles(12.1), table), Length::nautical_miles(5.0));
  EXPECT_FALSE(window_of_blank_selection(Length::nautical_miles(30.1), table));
}

TEST(PointName, DistinguishesSteerPointsTargetsAndTheirOffsets) {
  EXPECT_EQ(point_name("2"), (PointName{2, 0, false}));
  EXPECT_EQ(point_name("2."), (PointName{2, 0, true}));
  EXPECT_EQ(point_name("2.1"), (PointName{2, 1, false}));
  EXPECT_EQ(point_name("2.01"), (PointName{2, 1, true}));
  EXPECT_EQ(point_name("100.99"), (PointName{100, 99, true}));
}

TEST(PointName, GivesItsTextBack) {
  for (const char* text : {"1", "2.", "2.1", "2.01", "2.10", "100.99", "7.9"})
    EXPECT_EQ(text_of(point_name(text).value()), text);
}

TEST(Route, APointHasTheKindOfItsNameOrIsAnInitialPoint) {
  EXPECT_EQ(kind_by_name({2, 0, false}), PointKind::steer);
  EXPECT_EQ(kind_by_name({2, 0, true}), PointKind::target);
  EXPECT_EQ(kind_by_name({2, 1, false}), PointKind::steer_offset);
  EXPECT_EQ(kind_by_name({2, 1, true}), PointKind::target_offset);
  EXPECT_TRUE(is_kind_of(PointKind::initial, {2, 0, false}));
  EXPECT_FALSE(is_kind_of(PointKind::initial, {2, 0, true}));
  EXPECT_FALSE(is_kind_of(PointKind::initial, {2, 1, false}));
}

TEST(Route, ANameConflictsWithItselfAndANumberWithThatOfAnotherPoint) {
  const std::array<NamedPoint, 3> route{
      {{{2, 0, false}, PointKind::steer}, {{2, 1, false}, PointKind::steer_offset}, {{3, 0, true}, PointKind::target}}};
  EXPECT_EQ(conflict({2, 0, true}, route), &route[0]);
  EXPECT_EQ(conflict({2, 1, false}, route), &route[1]);
  EXPECT_EQ(conflict({3, 0, false}, route), &route[2]);
  EXPECT_EQ(conflict({2, 1, true}, route), nullptr) << "2.01 beside 2.1";
  EXPECT_EQ(conflict({3, 2, false}, route), nullptr);
  EXPECT_EQ(conflict({4, 0, false}, route), nullptr);
}

TEST(Route, TheInitialPointOfATargetIsTheLastSteerPointAfterTheTargetBefore) {
  std::vector<NamedPoint> route{{{5, 0, false}, PointKind::steer}, {{1, 0, false}, PointKind::steer},
                                {{3, 0, true}, PointKind::target}, {{6, 1, false}, PointKind::steer_offset},
                                {{4, 0, false}, PointKind::steer}, {{9, 0, false}, PointKind::steer}};
  EXPECT_EQ(initial_point_before(7, route), 0U);
  EXPECT_EQ(initial_point_before(3, route), 1U);
  EXPECT_EQ(initial_point_before(4, route), std::nullopt) << "no steer point after target 3";
  EXPECT_EQ(initial_point_before(1, route), std::nullopt);
  route[4].kind = PointKind::initial;
  EXPECT_EQ(initial_point_before(7, route), std::nullopt) << "4 is the initial point";
}

TEST(PointName, RefusesOtherText) {
  for (const char* text : {"", ".", ".1", "0", "02", "101", "2.0", "2.00", "2.001", "2.1.1", "-2", "+2", "2 ", "two",
                           "2.x", "99999999999"})
    EXPECT_FALSE(point_name(text)) << text;
}

TEST(PointName, SortsByNumberEachPointBeforeItsOffsets) {
  const std::vector<std::string> sorted{"1", "1.1", "2.", "2.01", "2.11", "10", "10.1", "100", "aim", "base"};
  std::vector<std::string> shuffled{"base", "10.1", "2.11", "100", "1.1", "aim", "2.01", "10", "2.", "1"};
  std::sort(shuffled.begin(), shuffled.end(), [](const auto& a, const auto& b) { return precedes(a, b); });
  EXPECT_EQ(shuffled, sorted);
}

TEST(Names, AreThoseOfYarsWatch) {
  EXPECT_EQ(name_of(Power::standby), "STBY");
  EXPECT_EQ(name_of(Mode::air_to_air), "AA");
  EXPECT_EQ(name_of(Mode::menu), "MENU");
  EXPECT_EQ(name_of(Master::ranging), "AGR");
  EXPECT_EQ(name_of(ScanWidth::quarter), "QTR");
  EXPECT_EQ(name_of(CursorFunction::update), "UPDT");
  EXPECT_EQ(name_of(Navigator::mission), "MN");
}

TEST(StandardNormal, IsRepeatableWithMeanZeroAndVarianceOne) {
  EXPECT_EQ(random::standard_normal(1, 2, 3), random::standard_normal(1, 2, 3));
  double sum = 0.0, squares = 0.0, products = 0.0;
  constexpr std::uint64_t kDraws = 100'000;
  for (std::uint64_t n = 0; n < kDraws; ++n) {
    const double value = random::standard_normal(7, n, 0);
    sum += value;
    squares += value * value;
    products += value * random::standard_normal(7, n, 1);
  }
  // Tolerance: five standard deviations of each estimate.
  EXPECT_NEAR(sum / kDraws, 0.0, 0.016);
  EXPECT_NEAR(squares / kDraws, 1.0, 0.023);
  EXPECT_NEAR(products / kDraws, 0.0, 0.016) << "draws of one count are uncorrelated";
}

TEST(Names, AreAQuestionMarkForAValueOutsideTheEnumeration) {
  EXPECT_EQ(name_of(static_cast<Mode>(200)), "?");
}

}  // namespace
}  // namespace yars::radar

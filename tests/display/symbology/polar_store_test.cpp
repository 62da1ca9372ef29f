#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "display/symbology/radar_video.hpp"

namespace yars::display {
namespace {

databuffer::Sweep sweep_of(double left_deg, double width_deg = 1.0, std::uint32_t samples = 4) {
  databuffer::Sweep sweep{};
  sweep.apex_latitude_deg = 34.0;
  sweep.apex_longitude_deg = -120.0;
  sweep.azimuth_left_deg = left_deg;
  sweep.azimuth_right_deg = left_deg + width_deg;
  sweep.range_m = 1000.0;
  sweep.samples = samples;
  return sweep;
}

TEST(PolarStore, ASweepIntoAnEmptyStoreIsTheFirst) {
  PolarStore store;
  EXPECT_EQ(store.newest(), nullptr);
  EXPECT_EQ(store.insert(sweep_of(10.0)), Insertion::first);
  EXPECT_EQ(store.by_azimuth().size(), 1U);
}

TEST(PolarStore, ASweepLeftOfAllComesBeforeTheFirst) {
  PolarStore store;
  store.insert(sweep_of(10.0));
  EXPECT_EQ(store.insert(sweep_of(8.0)), Insertion::before_first);
  EXPECT_EQ(store.by_azimuth().front().serial, 2U);
}

TEST(PolarStore, ASweepRightOfAllComesAfterTheLast) {
  PolarStore store;
  store.insert(sweep_of(10.0));
  EXPECT_EQ(store.insert(sweep_of(12.0)), Insertion::after_last);
  EXPECT_EQ(store.by_azimuth().back().serial, 2U);
}

TEST(PolarStore, ASweepBetweenTwoIsInsertedBetweenThem) {
  PolarStore store;
  store.insert(sweep_of(10.0));
  store.insert(sweep_of(14.0));
  EXPECT_EQ(store.insert(sweep_of(12.0)), Insertion::between);
  ASSERT_EQ(store.by_azimuth().size(), 3U);
  EXPECT_EQ(store.by_azimuth()[1].serial, 3U);
}

TEST(PolarStore, ASweepReplacesThoseWhoseMiddleItCovers) {
  PolarStore store;
  for (const double left_deg : {10.0, 11.0, 12.0, 13.0}) store.insert(sweep_of(left_deg));
  EXPECT_EQ(store.insert(sweep_of(11.2, 1.5)), Insertion::replaced);  // covers 11.5 and 12.5
  ASSERT_EQ(store.by_azimuth().size(), 3U);
  EXPECT_EQ(store.by_azimuth()[1].serial, 5U);
  EXPECT_EQ(store.insert(sweep_of(10.0)), Insertion::replaced) << "an equal angle";
  EXPECT_EQ(store.by_azimuth().size(), 3U);
}

TEST(PolarStore, NorthIsAnAzimuthLikeAnyOther) {
  PolarStore store;
  for (const double left_deg : {357.0, 358.0, 359.0, 0.0, 1.0}) store.insert(sweep_of(left_deg));
  ASSERT_EQ(store.by_azimuth().size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(store.by_azimuth()[i].serial, i + 1);
  EXPECT_EQ(store.insert(sweep_of(359.4, 1.2)), Insertion::replaced);  // covers 359.5 and 0.5
  EXPECT_EQ(store.by_azimuth().size(), 4U);
}

TEST(PolarStore, AWedgeOverTheSeamOppositeToTheFirstReplacesOnBothSides) {
  PolarStore store;
  store.insert(sweep_of(-0.5));  // middle 0: the seam is at 180
  store.insert(sweep_of(178.0));
  store.insert(sweep_of(181.0));
  EXPECT_EQ(store.insert(sweep_of(177.0, 6.0)), Insertion::replaced);
  EXPECT_EQ(store.by_azimuth().size(), 2U);
}

TEST(PolarStore, ASecondScanLeavesNothingOfTheFirst) {
  PolarStore store;
  for (int i = 0; i < 100; ++i) store.insert(sweep_of(310.0 + i));
  for (int i = 99; i >= 0; --i) store.insert(sweep_of(310.0 + i));
  EXPECT_EQ(store.by_azimuth().size(), 100U);
  for (const StoredSweep& sweep : store.by_azimuth()) EXPECT_GT(sweep.serial, 100U);
}

TEST(PolarStore, NoStoredMiddleLiesUnderANewerWedge) {
  const unsigned seed = 20260101;
  RecordProperty("seed", static_cast<int>(seed));
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> azimuth_deg(0.0, 360.0);
  std::uniform_real_distribution<double> width_deg(0.1, 8.0);
  PolarStore store;
  std::vector<databuffer::Sweep> inserted{databuffer::Sweep{}};
  for (int i = 0; i < 3000; ++i) {
    inserted.push_back(sweep_of(azimuth_deg(random), width_deg(random)));
    store.insert(inserted.back());
  }
  double last_key_deg = -181.0;
  std::vector<bool> row_used(PolarStore::kRows);
  for (const StoredSweep& stored : store.by_azimuth()) {
    EXPECT_GE(stored.azimuth_key_deg, last_key_deg);
    last_key_deg = stored.azimuth_key_deg;
    EXPECT_FALSE(row_used[static_cast<std::size_t>(stored.row)]) << "two sweeps in one row";
    row_used[static_cast<std::size_t>(stored.row)] = true;
    const databuffer::Sweep& own = inserted[stored.serial];
    const double middle_deg = (own.azimuth_left_deg + own.azimuth_right_deg) / 2.0;
    for (std::size_t newer = stored.serial + 1; newer < inserted.size(); ++newer) {
      const databuffer::Sweep& other = inserted[newer];
      const double width = other.azimuth_right_deg - other.azimuth_left_deg;
      const double inside = std::fmod(middle_deg - other.azimuth_left_deg + 720.0, 360.0);
      EXPECT_FALSE(inside > 1e-9 && inside < width - 1e-9) << "seed " << seed;
    }
  }
}

TEST(PolarStore, TheOldestMakesWayWhenAllRowsAreTaken) {
  PolarStore store;
  const double width_deg = 360.0 / (PolarStore::kRows + 100);
  for (int i = 0; i < PolarStore::kRows + 5; ++i) store.insert(sweep_of(i * width_deg, width_deg));
  EXPECT_EQ(store.by_azimuth().size(), static_cast<std::size_t>(PolarStore::kRows));
  for (const StoredSweep& sweep : store.by_azimuth()) EXPECT_GT(sweep.serial, 5U);
}

TEST(PolarStore, AScanOfAThousandNarrowWedgesIsKeptWholeAndReplacedByTheNext) {
  PolarStore store;
  constexpr double kWidth_deg = 0.1;
  for (int i = 0; i < 1000; ++i) store.insert(sweep_of(310.0 + i * kWidth_deg, kWidth_deg));
  ASSERT_EQ(store.by_azimuth().size(), 1000U);
  for (int i = 999; i >= 0; --i) store.insert(sweep_of(310.0 + i * kWidth_deg, kWidth_deg));
  EXPECT_EQ(store.by_azimuth().size(), 1000U);
  for (const StoredSweep& sweep : store.by_azimuth()) EXPECT_GT(sweep.serial, 1000U);
}

// A sweep from so far north of where the others are measured.
databuffer::Sweep flown_north(double left_deg, double north_m, std::uint32_t scan) {
  databuffer::Sweep sweep = sweep_of(left_deg);
  sweep.apex_latitude_deg += north_m / 110'900.0;
  sweep.scan = scan;
  return sweep;
}

std::size_t measured_at_first_apex(const PolarStore& store) {
  const double first_apex_deg = sweep_of(0.0).apex_latitude_deg;
  return static_cast<std::size_t>(std::ranges::count_if(
      store.by_azimuth(), [&](const StoredSweep& stored) { return stored.apex.latitude_deg == first_apex_deg; }));
}

// kNearFraction of the range of 1 km is 50 m: from 20 m north, the near end of a wedge on 45.5 lies on 67.1.
TEST(PolarStore, ACoveredSweepLiesBeneathUntilItsScanHasSweptItsGroundToo) {
  PolarStore store;
  store.insert(flown_north(45.0, 0.0, 1));
  for (double left_deg = 40.0; left_deg < 67.0; left_deg += 1.0) {
    store.insert(flown_north(left_deg, 20.0, 2));
    EXPECT_EQ(measured_at_first_apex(store), 1U) << left_deg;
  }
  for (double left_deg = 67.0; left_deg < 74.0; left_deg += 1.0) store.insert(flown_north(left_deg, 20.0, 2));
  EXPECT_EQ(measured_at_first_apex(store), 0U);
}

TEST(PolarStore, ACoveredSweepGoesAtTheLatestWithTheNextScanOverIt) {
  PolarStore store;
  store.insert(flown_north(45.0, 0.0, 1));
  store.insert(flown_north(45.0, 200.0, 2));
  EXPECT_EQ(measured_at_first_apex(store), 1U) << "its near ground lies behind";
  store.insert(flown_north(45.0, 400.0, 3));
  EXPECT_EQ(measured_at_first_apex(store), 0U);
}

// FULL, then HALF again and again: what FULL saw between HALF's edge and the sweeps that still stand beyond it stays.
TEST(PolarStore, BesideANarrowedScanNoGapOpensToWhatStandsBeyondIt) {
  PolarStore store;
  for (int left = -60; left < 60; ++left) store.insert(flown_north(left, 0.0, 1));
  for (std::uint32_t scan = 2; scan <= 5; ++scan)
    for (int left = -25; left < 25; ++left) store.insert(flown_north(left, 200.0 * scan, scan));
  const auto covered_at_first_apex = [&store] {
    const auto sweeps = store.by_azimuth();
    return std::ranges::count_if(sweeps, [](const StoredSweep& sweep) { return sweep.scan == 1 && sweep.covered; });
  };
  EXPECT_GE(covered_at_first_apex(), 2) << "one at either edge";
  for (std::uint32_t scan = 6; scan <= 8; ++scan)
    for (int left = -60; left < 60; ++left) store.insert(flown_north(left, 200.0 * scan, scan));
  EXPECT_EQ(covered_at_first_apex(), 0) << "FULL has swept them all again";
}

// A whole scan from `left` to `right`; its last sweep says that it is one.
void scan_over(PolarStore& store, int left_deg, int right_deg, std::uint32_t scan, std::uint32_t end_flags = 0) {
  for (int left = left_deg; left < right_deg; ++left) {
    databuffer::Sweep sweep = flown_north(left, 0.0, scan);
    if (left + 1 == right_deg) sweep.flags = databuffer::kSweepScanEnd | end_flags;
    store.insert(sweep);
  }
}

std::ptrdiff_t sweeps_of_scan(const PolarStore& store, std::uint32_t scan) {
  return std::ranges::count(store.by_azimuth(), scan, &StoredSweep::scan);
}

TEST(PolarStore, WhatANarrowerScanCannotRenewGoesAfterTwoWholeScans) {
  PolarStore store;
  scan_over(store, -50, 50, 1);
  scan_over(store, -25, 25, 2);
  EXPECT_EQ(sweeps_of_scan(store, 1), 50) << "after one scan the rest of the wide one stands";
  for (int left = -25; left < 24; ++left) store.insert(flown_north(left, 0.0, 3));
  EXPECT_EQ(sweeps_of_scan(store, 1), 50) << "until the second has come to its end";
  scan_over(store, -25, 25, 3);
  EXPECT_EQ(sweeps_of_scan(store, 1), 0);
  EXPECT_EQ(sweeps_of_scan(store, 3), 50);
}

TEST(PolarStore, WhatAScanElsewhereCannotRenewGoesAfterTwoWholeScans) {
  PolarStore store;
  scan_over(store, 0, 25, 1);
  for (std::uint32_t scan = 2; scan <= 3; ++scan) scan_over(store, 90, 115, scan);
  EXPECT_EQ(sweeps_of_scan(store, 1), 0) << "a sector that went along with the cursor or the track";
}

TEST(PolarStore, ScansThatAreBrokenOffEraseNothing) {
  PolarStore store;
  scan_over(store, -50, 50, 1);
  for (std::uint32_t scan = 2; scan <= 9; ++scan) store.insert(flown_north(0.0, 0.0, scan));
  EXPECT_EQ(sweeps_of_scan(store, 1), 99);
}

TEST(PolarStore, AScanMayEndInABlankSweep) {
  PolarStore store;
  scan_over(store, -50, 50, 1);
  for (std::uint32_t scan = 2; scan <= 3; ++scan) scan_over(store, -25, 25, scan, databuffer::kSweepBlank);
  EXPECT_EQ(sweeps_of_scan(store, 1), 0);
}

TEST(PolarStore, AScanThatIsRenewedIsNeverErasedByItsEnd) {
  PolarStore store;
  for (std::uint32_t scan = 1; scan <= 20; ++scan) {
    scan_over(store, -50, 50, scan);
    EXPECT_EQ(store.by_azimuth().size(), 100U);
  }
}

TEST(PolarStore, CoveredSweepsMakeWayBeforeThoseInSight) {
  PolarStore store;
  store.insert(flown_north(359.0, 0.0, 1));
  store.insert(flown_north(0.0, 0.0, 1));
  store.insert(flown_north(0.0, 200.0, 2));
  const double width_deg = 300.0 / PolarStore::kRows;
  for (int i = 0; i + 2 < PolarStore::kRows; ++i) {
    databuffer::Sweep sweep = flown_north(10.0 + i * width_deg, 200.0, 2);
    sweep.azimuth_right_deg = sweep.azimuth_left_deg + width_deg;
    store.insert(sweep);
  }
  ASSERT_EQ(measured_at_first_apex(store), 1U);
  EXPECT_FALSE(store.by_azimuth().front().covered) << "the older one, on 359.5";
}

TEST(PolarStore, AnotherModeOrEpochBeginsANewPicture) {
  PolarStore store;
  store.insert(sweep_of(10.0));
  databuffer::Sweep other = sweep_of(20.0);
  other.mode = 1;
  EXPECT_EQ(store.insert(other), Insertion::first);
  EXPECT_EQ(store.mode(), 1);
  other.epoch = 1;
  other.azimuth_left_deg += 2.0;
  other.azimuth_right_deg += 2.0;
  EXPECT_EQ(store.insert(other), Insertion::first);
  EXPECT_EQ(store.by_azimuth().size(), 1U);
}

TEST(PolarStore, BlankAndMalformedSweepsLeaveThePictureAsItIs) {
  PolarStore store;
  store.insert(sweep_of(10.0));
  const std::uint64_t version = store.version();
  databuffer::Sweep blank = sweep_of(10.0);
  blank.flags = databuffer::kSweepBlank;
  databuffer::Sweep rangeless = sweep_of(10.0);
  rangeless.range_m = 0.0;
  EXPECT_EQ(store.insert(blank), Insertion::ignored);
  EXPECT_EQ(store.insert(rangeless), Insertion::ignored);
  EXPECT_EQ(store.insert(sweep_of(10.0, -1.0)), Insertion::ignored);
  EXPECT_EQ(store.insert(sweep_of(10.0, 90.0)), Insertion::ignored);
  EXPECT_EQ(store.insert(sweep_of(10.0, 1.0, 0)), Insertion::ignored);
  EXPECT_EQ(store.version(), version);
}

TEST(PolarStore, AFineSweepIsAveragedDownAndEndsWhereItsSamplesEnd) {
  PolarStore store;
  databuffer::Sweep sweep = sweep_of(10.0, 1.0, 4096);
  for (std::size_t i = 0; i < 4096; ++i) sweep.video[i] = static_cast<std::uint8_t>(i % 4 == 0 ? 200 : 100);
  store.insert(sweep);
  const StoredSweep& stored = store.by_azimuth()[0];
  EXPECT_EQ(stored.samples, 1024);
  EXPECT_DOUBLE_EQ(stored.range_m, 1000.0);
  EXPECT_EQ(store.video(stored.row)[0], 125);
  EXPECT_EQ(store.video(stored.row)[1023], 125);
}

TEST(PolarStore, ACoarseSweepIsKeptAsItIs) {
  PolarStore store;
  databuffer::Sweep sweep = sweep_of(10.0, 1.0, 3);
  sweep.video[0] = 7;
  sweep.video[2] = 255;
  store.insert(sweep);
  const auto video = store.video(store.by_azimuth()[0].row);
  EXPECT_EQ(video[0], 7);
  EXPECT_EQ(video[1], 0);
  EXPECT_EQ(video[2], 255);
}

}  // namespace
}  // namespace yars::display

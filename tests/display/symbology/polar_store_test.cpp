// PolarStore: order of sweeps by azimuth, replacement, erasure while the aircraft moves, and averaging of samples.
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

TEST(PolarStore, CountsErasedSweepsAndThoseThatNoNewerSweepReplaces) {
  PolarStore store;
  const auto add = [&](double left_deg, std::uint32_t scan, bool last) {
    databuffer::Sweep sweep = sweep_of(left_deg);
    sweep.scan = scan;
    if (last) sweep.flags = databuffer::kSweepScanEnd;
    store.insert(sweep);
  };
  const auto first_erasures = store.erasures(), first_losses = store.losses();
  for (int i = 0; i < 5; ++i) add(10.0 + i, 1, i == 4);
  EXPECT_EQ(store.erasures(), first_erasures);
  for (int i = 0; i < 3; ++i) add(12.0 - i, 2, i == 2);  // replaces three
  EXPECT_EQ(store.erasures(), first_erasures + 3);
  EXPECT_EQ(store.losses(), first_losses);
  for (int i = 0; i < 3; ++i) add(10.0 + i, 3, i == 2);  // two scans have not renewed the other two
  EXPECT_GT(store.losses(), first_losses);
  EXPECT_EQ(store.by_azimuth().size(), 3U);
  const auto losses = store.losses();
  store.clear();
  EXPECT_GT(store.losses(), losses);
}

TEST(PolarStore, ASweepReplacesStoredSweepsWhoseMiddleItCovers) {
  PolarStore store;
  for (const double left_deg : {10.0, 11.0, 12.0, 13.0}) store.insert(sweep_of(left_deg));
  EXPECT_EQ(store.insert(sweep_of(11.2, 1.5)), Insertion::replaced);  // covers 11.5 and 12.5
  ASSERT_EQ(store.by_azimuth().size(), 3U);
  EXPECT_EQ(store.by_azimuth()[1].serial, 5U);
  EXPECT_EQ(store.insert(sweep_of(10.0)), Insertion::replaced) << "equal azimuth";
  EXPECT_EQ(store.by_azimuth().size(), 3U);
}

TEST(PolarStore, SweepsAcrossNorthAreSortedAndReplaced) {
  PolarStore store;
  for (const double left_deg : {357.0, 358.0, 359.0, 0.0, 1.0}) store.insert(sweep_of(left_deg));
  ASSERT_EQ(store.by_azimuth().size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(store.by_azimuth()[i].serial, i + 1);
  EXPECT_EQ(store.insert(sweep_of(359.4, 1.2)), Insertion::replaced);  // covers 359.5 and 0.5
  EXPECT_EQ(store.by_azimuth().size(), 4U);
}

TEST(PolarStore, AWedgeAcrossTheAzimuthOppositeToTheFirstSweepReplacesOnBothSides) {
  PolarStore store;
  store.insert(sweep_of(-0.5));  // middle at 0 deg: the azimuth order begins at 180 deg
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

TEST(PolarStore, NoMiddleOfAStoredSweepIsInsideANewerWedge) {
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

TEST(PolarStore, AFullStoreDropsTheOldestSweep) {
  PolarStore store;
  const double width_deg = 360.0 / (PolarStore::kRows + 100);
  for (int i = 0; i < PolarStore::kRows + 5; ++i) store.insert(sweep_of(i * width_deg, width_deg));
  EXPECT_EQ(store.by_azimuth().size(), static_cast<std::size_t>(PolarStore::kRows));
  for (const StoredSweep& sweep : store.by_azimuth()) EXPECT_GT(sweep.serial, 5U);
}

TEST(PolarStore, AScanOfAThousandNarrowWedgesIsStoredAndReplacedByTheNextScan) {
  PolarStore store;
  constexpr double kWidth_deg = 0.1;
  for (int i = 0; i < 1000; ++i) store.insert(sweep_of(310.0 + i * kWidth_deg, kWidth_deg));
  ASSERT_EQ(store.by_azimuth().size(), 1000U);
  for (int i = 999; i >= 0; --i) store.insert(sweep_of(310.0 + i * kWidth_deg, kWidth_deg));
  EXPECT_EQ(store.by_azimuth().size(), 1000U);
  for (const StoredSweep& sweep : store.by_azimuth()) EXPECT_GT(sweep.serial, 1000U);
}

// A sweep whose apex is `north_m` north of the apex of sweep_of(). One degree of latitude is about 110,900 m there.
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

// The near point of the wedge at azimuth 45.5 deg is 50 m from its apex: kNearFraction of the range 1 km.
// Seen from an apex 20 m farther north, the azimuth of the near point is 67.1 deg.
TEST(PolarStore, ACoveredSweepStaysUntilTheScanHasSweptItsNearPoint) {
  PolarStore store;
  store.insert(flown_north(45.0, 0.0, 1));
  for (double left_deg = 40.0; left_deg < 67.0; left_deg += 1.0) {
    store.insert(flown_north(left_deg, 20.0, 2));
    EXPECT_EQ(measured_at_first_apex(store), 1U) << left_deg;
  }
  for (double left_deg = 67.0; left_deg < 74.0; left_deg += 1.0) store.insert(flown_north(left_deg, 20.0, 2));
  EXPECT_EQ(measured_at_first_apex(store), 0U);
}

TEST(PolarStore, ACoveredSweepIsErasedWhenALaterScanCoversItAgain) {
  PolarStore store;
  store.insert(flown_north(45.0, 0.0, 1));
  store.insert(flown_north(45.0, 200.0, 2));
  EXPECT_EQ(measured_at_first_apex(store), 1U) << "its near point is behind the new apex";
  store.insert(flown_north(45.0, 400.0, 3));
  EXPECT_EQ(measured_at_first_apex(store), 0U);
}

// Scan 1 is wide (FULL), scans 2 to 5 are narrow (HALF). Covered sweeps of scan 1 stay at the edges of the narrow
// scans, because the uncovered sweeps of scan 1 beyond these edges stay too.
TEST(PolarStore, NoGapOpensBesideANarrowedScan) {
  PolarStore store;
  for (int left = -60; left < 60; ++left) store.insert(flown_north(left, 0.0, 1));
  for (std::uint32_t scan = 2; scan <= 5; ++scan)
    for (int left = -25; left < 25; ++left) store.insert(flown_north(left, 200.0 * scan, scan));
  const auto covered_at_first_apex = [&store] {
    const auto sweeps = store.by_azimuth();
    return std::ranges::count_if(sweeps, [](const StoredSweep& sweep) { return sweep.scan == 1 && sweep.covered; });
  };
  EXPECT_GE(covered_at_first_apex(), 2) << "one at each edge";
  for (std::uint32_t scan = 6; scan <= 8; ++scan)
    for (int left = -60; left < 60; ++left) store.insert(flown_north(left, 200.0 * scan, scan));
  EXPECT_EQ(covered_at_first_apex(), 0) << "wide scans have covered them again";
}

// Inserts a complete scan from `left_deg` to `right_deg`. Its last sweep has the flag kSweepScanEnd and `end_flags`.
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

TEST(PolarStore, TwoCompleteNarrowScansEraseTheRestOfAWideScan) {
  PolarStore store;
  scan_over(store, -50, 50, 1);
  scan_over(store, -25, 25, 2);
  EXPECT_EQ(sweeps_of_scan(store, 1), 50) << "one narrow scan does not erase the rest of the wide scan";
  for (int left = -25; left < 24; ++left) store.insert(flown_north(left, 0.0, 3));
  EXPECT_EQ(sweeps_of_scan(store, 1), 50) << "the second narrow scan is not complete";
  scan_over(store, -25, 25, 3);
  EXPECT_EQ(sweeps_of_scan(store, 1), 0);
  EXPECT_EQ(sweeps_of_scan(store, 3), 50);
}

TEST(PolarStore, TwoCompleteScansOfAnotherSectorEraseAScan) {
  PolarStore store;
  scan_over(store, 0, 25, 1);
  for (std::uint32_t scan = 2; scan <= 3; ++scan) scan_over(store, 90, 115, scan);
  EXPECT_EQ(sweeps_of_scan(store, 1), 0) << "the sector has moved with the cursor or the track";
}

TEST(PolarStore, IncompleteScansEraseOnlyCoveredSweeps) {
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

TEST(PolarStore, RepeatedCompleteScansKeepAllSweeps) {
  PolarStore store;
  for (std::uint32_t scan = 1; scan <= 20; ++scan) {
    scan_over(store, -50, 50, scan);
    EXPECT_EQ(store.by_azimuth().size(), 100U);
  }
}

TEST(PolarStore, AFullStoreDropsCoveredSweepsBeforeOlderUncoveredOnes) {
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
  EXPECT_FALSE(store.by_azimuth().front().covered) << "the older sweep, at 359.5 deg, is uncovered and stays";
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

TEST(PolarStore, ASweepOf4096SamplesIsAveragedTo1024OverTheSameRange) {
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

TEST(PolarStore, ASweepOfFewSamplesIsStoredUnchanged) {
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

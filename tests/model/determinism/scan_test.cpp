// A sweep is a function of configuration, terrain, seed and ticks. The number of threads, the caller and the run do not
// change a bit.
#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "model/kernel/offline_scan.hpp"
#include "model/rbm/beam.hpp"
#include "tests/model/kernel/cockpit.hpp"
#include "tests/model/made_up_objects.hpp"

namespace yars::model::kernel {
namespace {

ScanRequest request_of(const databuffer::ModelTick& tick) {
  ScanRequest request;
  request.pose = *pose_of(tick.ownship);
  request.range = geo::Length::nautical_miles(tick.command.range_nm);
  request.width = geo::Angle::degrees(tick.command.scan_width_deg);
  request.elevation = geo::Angle::degrees(tick.command.antenna_elevation_deg);
  request.gain = tick.command.gain;
  return request;
}

// Hashes of the sweeps of one offline scan.
std::vector<std::uint64_t> hashes(const radar::RadarConfiguration& configuration, int threads,
                                  const scene::SceneViewPointer& scenes = nullptr) {
  const test::Cockpit cockpit(configuration, terrain::built_in_hills());
  OfflineScan scan(configuration, request_of(cockpit.tick), threads);
  scan.run({cockpit.terrain, scenes.get()});
  std::vector<std::uint64_t> result;
  for (const databuffer::Sweep& sweep : scan.sweeps()) result.push_back(sweep.hash);
  return result;
}

radar::RadarConfiguration with(radar::Algorithm algorithm, int samples) {
  radar::RadarConfiguration configuration;
  configuration.fidelity.algorithm = algorithm;
  configuration.fidelity.samples = samples;
  return configuration;
}

TEST(Determinism, AnyNumberOfThreadsGivesTheSameHashes) {
  // `reference` is slow, so it computes fewer samples.
  for (const auto& [algorithm, samples] :
       {std::pair{radar::Algorithm::standard, 137}, {radar::Algorithm::reference, 41}}) {
    const auto configuration = with(algorithm, samples);
    const auto alone = hashes(configuration, 1);
    ASSERT_EQ(alone.size(), 182U);
    for (const int threads : {2, 3, 8, 200}) EXPECT_EQ(hashes(configuration, threads), alone) << threads << " threads";
  }
}

TEST(Determinism, ThreadsThatStealPiecesGiveTheSameHashesInEveryRun) {
  const auto configuration = with(radar::Algorithm::standard, 37);
  const auto alone = hashes(configuration, 1);
  test::Cockpit cockpit(configuration, terrain::built_in_hills());
  OfflineScan scan(configuration, request_of(cockpit.tick), 3);
  for (int run = 0; run < 200; ++run) {
    scan.run({cockpit.terrain, nullptr});
    for (std::size_t i = 0; i < alone.size(); ++i) ASSERT_EQ(scan.sweeps()[i].hash, alone[i]) << run << ' ' << i;
  }
}

TEST(Determinism, AStoppedScanLeavesTheObjectUsable) {
  const auto configuration = with(radar::Algorithm::standard, 37);
  const auto alone = hashes(configuration, 1);
  test::Cockpit cockpit(configuration, terrain::built_in_hills());
  for (const int threads : {1, 3}) {
    OfflineScan scan(configuration, request_of(cockpit.tick), threads);
    for (int steps = 0; steps < 3; ++steps) {
      int asked = 0;
      bool stopped = false;
      try {
        scan.run({cockpit.terrain, nullptr}, [&] { return asked++ < steps; });
      } catch (const parallel::Stopped&) {
        stopped = true;
      }
      // Other threads may take all sweeps before the caller is asked so often.
      EXPECT_EQ(stopped, asked > steps);
      EXPECT_TRUE(stopped || threads > 1);
      scan.run({cockpit.terrain, nullptr}, [] { return true; });
      for (std::size_t i = 0; i < alone.size(); ++i) ASSERT_EQ(scan.sweeps()[i].hash, alone[i]) << threads << ' ' << i;
    }
  }
}

// 300 houses and a runway (height 0) within the scan of test::Cockpit.
scene::SceneViewPointer town() {
  std::vector<test::Building> all{{0.0, 900.0, 45.0, 1800.0, 0.0, 9}};
  for (int row = 0; row < 15; ++row)
    for (int i = 0; i < 20; ++i) all.push_back({70.0 * i, 90.0 * row, 12.0, 18.0, 6.0 + (20 * row + i) % 9, 3});
  return test::scene_of(all, {37.2, -121.8}, 30.0, terrain::built_in_hills());
}

// What is kept of a scatterer for later sweeps does not change them, however weak its echo is.
TEST(Determinism, SweepsOverASceneHaveTheSamePowerInAnyOrder) {
  const auto configuration = with(radar::Algorithm::standard, 480);
  const auto scenes = town();
  const test::Cockpit cockpit(configuration, terrain::built_in_hills());
  const auto power_of = [&](bool backward) {
    rbm::Beam algorithm(configuration);
    std::vector<std::vector<float>> power(120, std::vector<float>(480));
    for (std::size_t i = 0; i < power.size(); ++i) {
      const std::size_t sweep = backward ? power.size() - 1 - i : i;
      const physics::SweepGeometry geometry{{37.2, -121.795},
                                            geo::AltitudeMsl::feet(3000.0),
                                            geo::Bearing::degrees(-30.0 + 0.55 * static_cast<double>(sweep)),
                                            geo::Angle::degrees(-60.0),
                                            geo::Length::nautical_miles(2.0)};
      algorithm.measure(geometry, {cockpit.terrain, scenes.get()}, power[sweep]);
    }
    return power;
  };
  EXPECT_EQ(power_of(false), power_of(true));
}

TEST(Determinism, ScenesGiveTheSameHashesForAnyNumberOfThreadsAndInTheLiveKernel) {
  for (const auto algorithm : {radar::Algorithm::standard, radar::Algorithm::reference}) {
    const auto configuration = with(algorithm, 137);
    const auto scenes = town();
    const auto alone = hashes(configuration, 1, scenes);
    EXPECT_NE(alone, hashes(configuration, 1));
    for (const int threads : {2, 5}) EXPECT_EQ(hashes(configuration, threads, scenes), alone) << threads << " threads";
    test::Cockpit cockpit(configuration, terrain::built_in_hills());
    cockpit.scenes = scenes;
    cockpit.tick.command.antenna_elevation_deg = 0.0;
    OfflineScan scan(configuration, request_of(cockpit.tick), 2);
    scan.run({cockpit.terrain, scenes.get()});
    const auto live = cockpit.run(320);
    ASSERT_GE(live.size(), 182U);
    for (std::size_t i = 0; i < 182U; ++i) ASSERT_EQ(live[i].hash, scan.sweeps()[i].hash) << i;
  }
}

// The sub-beams that successive sweeps share, over ground, scenes and a mover.
TEST(Determinism, SubBeamsGiveTheSameHashesForAnyNumberOfThreadsAndInTheLiveKernel) {
  for (const auto& [algorithm, samples] :
       {std::pair{radar::Algorithm::standard, 137}, {radar::Algorithm::reference, 23}}) {
    auto configuration = with(algorithm, samples);
    configuration.fidelity.sub_beams = 13;
    radar::Mover mover;
    mover.position = {37.2, -121.75};
    mover.speed_mps = 200.0;
    configuration.world.movers.push_back(mover);
    const auto scenes = town();
    test::Cockpit cockpit(configuration, terrain::built_in_hills());
    cockpit.scenes = scenes;
    cockpit.tick.command.antenna_elevation_deg = 0.0;
    const auto live = cockpit.run(320);
    ASSERT_GE(live.size(), 182U);
    for (const int threads : {1, 2, 8}) {
      ScanRequest request = request_of(cockpit.tick);
      request.sim_time_ns = live[0].sim_time_ns;
      OfflineScan scan(configuration, request, threads);
      for (int run = 0; run < 3; ++run) scan.run({cockpit.terrain, scenes.get()});
      for (std::size_t i = 0; i < 182U; ++i) ASSERT_EQ(live[i].hash, scan.sweeps()[i].hash) << threads << ' ' << i;
    }
  }
}

// Rays that were measured while scenes were still being read are in use for 50 ms: ten sweeps, and one by the smear.
TEST(Determinism, SweepsWithSubBeamsAreNotReadyWhileTheyUseRaysOfSweepsThatWereNot) {
  auto configuration = with(radar::Algorithm::standard, 64);
  configuration.fidelity.sub_beams = 5;
  test::Cockpit cockpit(configuration);
  while (!cockpit.run_until(test::is_scan_start)) continue;
  cockpit.scenes_ready = false;
  cockpit.run(50);
  cockpit.scenes_ready = true;
  const auto later = cockpit.run(50);
  ASSERT_EQ(later.size(), 50U);
  for (std::size_t i = 0; i < later.size(); ++i)
    EXPECT_EQ((later[i].flags & databuffer::kSweepNotReady) != 0U, i < 12) << i;
}

TEST(Determinism, SweepsAreNotReadyWhileScenesAreStillBeingRead) {
  test::Cockpit cockpit(with(radar::Algorithm::standard, 64));
  cockpit.scenes_ready = false;
  for (const databuffer::Sweep& sweep : cockpit.run(50)) EXPECT_NE(sweep.flags & databuffer::kSweepNotReady, 0U);
  cockpit.scenes_ready = true;
  const auto later = cockpit.run(200);
  ASSERT_GT(later.size(), 10U);
  EXPECT_EQ(later.back().flags & databuffer::kSweepNotReady, 0U);
}

TEST(Determinism, AnotherSeedGivesOtherHashes) {
  auto configuration = with(radar::Algorithm::standard, 137);
  const auto first = hashes(configuration, 1);
  configuration.seed = 2;
  EXPECT_NE(hashes(configuration, 1), first);
}

TEST(Determinism, TheLiveKernelAndTheOfflineScanAgree) {
  const auto configuration = with(radar::Algorithm::standard, 480);
  test::Cockpit cockpit(configuration, terrain::built_in_hills());
  // The antenna starts at elevation 0, so that the live scan has this elevation from its first sweep.
  cockpit.tick.command.antenna_elevation_deg = 0.0;
  OfflineScan scan(configuration, request_of(cockpit.tick), 2);
  scan.run(cockpit.terrain);
  const auto live = cockpit.run(320);
  ASSERT_GE(live.size(), 182U);
  ASSERT_EQ(scan.sweeps().size(), 182U);
  for (std::size_t i = 0; i < 182U; ++i) ASSERT_EQ(live[i].hash, scan.sweeps()[i].hash) << i;
}

TEST(Determinism, TheSameTicksGiveTheSameSweepsAgain) {
  const auto configuration = with(radar::Algorithm::standard, 200);
  const auto flight = [&] {
    test::Cockpit cockpit(configuration, terrain::built_in_hills());
    std::vector<std::uint64_t> result;
    for (int i = 0; i < 900; ++i) {
      cockpit.tick.ownship.latitude_deg += 1e-5;
      cockpit.tick.ownship.heading_deg += 0.01;
      cockpit.tick.command.gain = static_cast<std::uint8_t>(3 - i / 300);
      cockpit.set_flag(databuffer::kSniff, i > 700);
      if (const auto* sweep = cockpit.step()) result.push_back(sweep->hash);
    }
    return result;
  };
  const auto first = flight();
  EXPECT_GT(first.size(), 500U);
  EXPECT_EQ(flight(), first);
}

}  // namespace
}  // namespace yars::model::kernel

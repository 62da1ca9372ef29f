// Scans with rain, jammers and movers: the live kernel and the offline scan give the same sweeps.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "model/kernel/offline_scan.hpp"
#include "model/kernel/sweep_chain.hpp"
#include "model/rbm/beam.hpp"
#include "tests/model/kernel/cockpit.hpp"

namespace yars::model::kernel {
namespace {

radar::RadarConfiguration world_with_rain_jammer_and_mover() {
  radar::RadarConfiguration configuration;
  configuration.fidelity.algorithm = radar::Algorithm::reference;
  configuration.fidelity.samples = 120;
  radar::WorldConfiguration& world = configuration.world;
  world.rain.cells.push_back({{37.25, -121.7}, 9000.0, 20.0, 6000.0});
  radar::Jammer jammer;
  jammer.position = {37.3, -121.8};
  jammer.altitude_m = 3000.0;
  jammer.band = 2;
  jammer.channels = {4};
  world.jamming.jammers.push_back(jammer);
  radar::Mover mover;
  mover.position = {37.2, -121.75};
  mover.speed_mps = 200.0;
  mover.heading_deg = 10.0;
  world.movers.push_back(mover);
  return configuration;
}

ScanRequest request_of(const databuffer::ModelTick& tick, std::int64_t sim_time_ns) {
  ScanRequest request;
  request.pose = *pose_of(tick.ownship);
  request.range = geo::Length::nautical_miles(tick.command.range_nm);
  request.width = geo::Angle::degrees(tick.command.scan_width_deg);
  request.elevation = geo::Angle::degrees(tick.command.antenna_elevation_deg);
  request.gain = tick.command.gain;
  request.sim_time_ns = sim_time_ns;
  request.band = tick.command.band;
  request.channel = tick.command.channel;
  return request;
}

std::vector<std::uint64_t> offline_hashes(const radar::RadarConfiguration& configuration, const test::Cockpit& cockpit,
                                          std::int64_t sim_time_ns) {
  OfflineScan scan(configuration, request_of(cockpit.tick, sim_time_ns), 2);
  scan.run(cockpit.terrain);
  std::vector<std::uint64_t> hashes;
  for (const databuffer::Sweep& sweep : scan.sweeps()) hashes.push_back(sweep.hash);
  return hashes;
}

TEST(WorldScan, IsTheSameLiveAndOffline) {
  const radar::RadarConfiguration configuration = world_with_rain_jammer_and_mover();
  test::Cockpit cockpit(configuration, terrain::flat(0.0));
  cockpit.tick.command.antenna_elevation_deg = 0.0;
  cockpit.tick.command.band = 2;
  cockpit.tick.command.channel = 4;
  const auto live = cockpit.run(320);
  ASSERT_GE(live.size(), 182U);
  const auto hashes = offline_hashes(configuration, cockpit, live[0].sim_time_ns);
  ASSERT_EQ(hashes.size(), 182U);
  for (std::size_t i = 0; i < hashes.size(); ++i) ASSERT_EQ(live[i].hash, hashes[i]) << i;
}

TEST(WorldScan, ChangesWithTheChannelTheTimeAndTheRain) {
  radar::RadarConfiguration configuration = world_with_rain_jammer_and_mover();
  test::Cockpit cockpit(configuration, terrain::flat(0.0));
  const auto unjammed = offline_hashes(configuration, cockpit, 0);
  EXPECT_EQ(offline_hashes(configuration, cockpit, 0), unjammed);
  EXPECT_NE(offline_hashes(configuration, cockpit, 60'000'000'000), unjammed) << "the mover has moved";
  cockpit.tick.command.band = 2;
  cockpit.tick.command.channel = 4;
  EXPECT_NE(offline_hashes(configuration, cockpit, 0), unjammed) << "jammed";
  cockpit.tick.command.channel = 0;
  configuration.world.rain.cells.clear();
  EXPECT_NE(offline_hashes(configuration, cockpit, 0), unjammed) << "dry";
}

// Brightest sample about a mover over the sea, in a sweep of scan `scan`. Speckle changes it by some levels.
int brightest_sample(radar::RadarConfiguration configuration, radar::TargetEcho echo, std::uint32_t scan) {
  configuration.antenna.elevation_beamwidth_deg = 180.0;
  configuration.fidelity.beam = radar::BeamPattern::hard_edge;
  configuration.receiver.looks = 16;
  configuration.world.movers = {{.position = {37.2, -121.75}, .cross_section_m2 = 2e3, .echo = echo}};
  SweepChain chain(configuration);
  SweepHeader header;
  header.apex = {37.0, -121.75};
  header.altitude = geo::AltitudeMsl::metres(3000.0);
  header.left = geo::Bearing::degrees(359.7);
  header.right = geo::Bearing::degrees(0.3);
  header.range = geo::Length::nautical_miles(20.0);
  SweepChain::Labels labels;
  labels.scan = scan;
  databuffer::Sweep sweep;
  chain.advance(header, labels, terrain::AnalyticTerrain(terrain::flat(0.0)), sweep);
  EXPECT_TRUE(chain.flush(sweep));
  return *std::max_element(sweep.video + sweep.samples / 2, sweep.video + sweep.samples * 3 / 4);
}

TEST(WorldScan, DrawsTheEchoOfAMoverByItsNumber) {
  for (const auto algorithm : {radar::Algorithm::standard, radar::Algorithm::reference}) {
    radar::RadarConfiguration configuration;
    configuration.fidelity.algorithm = algorithm;
    std::vector<int> levels, steady;
    for (std::uint32_t scan = 1; scan <= 12; ++scan) {
      levels.push_back(brightest_sample(configuration, radar::TargetEcho::swerling1, scan));
      steady.push_back(brightest_sample(configuration, radar::TargetEcho::steady, scan));
    }
    EXPECT_GT(*std::ranges::max_element(levels) - *std::ranges::min_element(levels), 60);
    EXPECT_LT(*std::ranges::max_element(steady) - *std::ranges::min_element(steady), 30);
  }
}

}  // namespace
}  // namespace yars::model::kernel

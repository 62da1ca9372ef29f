// Replay: the kernel computes the recorded sweeps again, also if the model was killed between a sweep and its status.
#include "radar/recording/replay.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/model/kernel/cockpit.hpp"
#include "tests/model/made_up_objects.hpp"
#include "world/world_values.hpp"

namespace yars::recording {
namespace {

model::terrain::TerrainViewPointer hills() {
  return std::make_shared<const model::terrain::AnalyticTerrain>(model::terrain::built_in_hills());
}

// A model driven tick by tick as in its process, and a replay that receives what a recorder would write.
class Recorded {
 public:
  // Scene stores of the model (`live`) and of the replay (`replayed`).
  explicit Recorded(model::scene::SceneStore* live = nullptr, model::scene::SceneStore* replayed = nullptr,
                    const radar::RadarConfiguration& configuration = {})
      : configuration_(configuration),
        cockpit_(configuration_, model::terrain::built_in_hills()),
        store_(hills()),
        replay_(configuration_, store_, replayed) {
    // The live view has more scenes than the scan needs.
    if (live != nullptr) cockpit_.scenes = live->prepare({{37.0, -122.0}, 500'000.0, 0});
    cockpit_.tick.resumed_tick = -1;
    cockpit_.tick.flags |= databuffer::kTickRestart;
  }

  void run(int ticks) {
    for (int i = 0; i < ticks; ++i) {
      move();
      const bool has_sweep = cockpit_.step() != nullptr;
      replay_.tick(cockpit_.tick);
      if (has_sweep) replay_.recorded(digest_of(cockpit_.sweep));
      status_ = cockpit_.status();
      cockpit_.tick.flags &= ~databuffer::kTickRestart;
    }
  }
  // From now on the aircraft moves by 1.4 m a tick.
  void fly() { step_deg_ = 1e-5; }
  // From now on the aircraft turns at this rate, clockwise positive.
  void turn(double rate_dps) { turn_deg_ = radar::kTickSeconds * rate_dps; }
  // Runs the model without a recorder, which then begins with the model's status.
  void run_before_the_recorder(int ticks) {
    for (int i = 0; i < ticks; ++i) {
      move();
      cockpit_.step();
      cockpit_.tick.flags &= ~databuffer::kTickRestart;
    }
    replay_.start({cockpit_.status()});
  }
  // Kills the model after it has published the next tick, and before its status. `swept`: the sweep is published, too.
  void kill_inside_tick(bool swept) {
    const bool has_sweep = cockpit_.step() != nullptr;
    replay_.tick(cockpit_.tick);
    if (swept && has_sweep) replay_.recorded(digest_of(cockpit_.sweep));
    restart();
  }
  void restart() {
    cockpit_.kernel = model::kernel::RadarKernel(configuration_);
    cockpit_.kernel.use_world(world_);
    cockpit_.kernel.resume(status_);
    cockpit_.tick.flags |= databuffer::kTickRestart;
    cockpit_.tick.resumed_tick = status_.tick;
    cockpit_.tick.tick += 7;  // ticks without a model
  }
  // Another world from the next tick on.
  void change_world(const databuffer::WorldState& world) {
    world_ = configuration_.world;
    world::apply(world, world_);
    cockpit_.kernel.use_world(world_);
    replay_.world(world);
  }
  void tell_replay(const databuffer::WorldState& world) { replay_.world(world); }
  void update_velocity() { cockpit_.set_flag(databuffer::kIpvu, true); }
  const databuffer::ModelStatus& status() const { return status_; }
  const Comparison& comparison() const { return replay_.comparison(); }

 private:
  void move() {
    cockpit_.tick.ownship.latitude_deg += step_deg_;
    cockpit_.tick.ownship.longitude_deg += step_deg_;
    if (turn_deg_ == 0.0) return;
    databuffer::Ownship& ownship = cockpit_.tick.ownship;
    ownship.heading_deg = geo::Bearing::degrees(ownship.heading_deg + turn_deg_).degrees();
    ownship.velocity_north_mps = 240.0 * std::cos(ownship.heading_deg * geo::kRadiansPerDegree);
    ownship.velocity_east_mps = 240.0 * std::sin(ownship.heading_deg * geo::kRadiansPerDegree);
  }

  double step_deg_ = 0.0, turn_deg_ = 0.0;
  radar::RadarConfiguration configuration_;
  test::Cockpit cockpit_;
  radar::WorldConfiguration world_ = configuration_.world;
  model::terrain::FixedTerrainStore store_;
  Replay replay_;
  databuffer::ModelStatus status_{};
};

// Rain over the scanned area.
databuffer::WorldState rainy_world() {
  radar::WorldConfiguration world;
  world.rain.cells = {{{37.25, -121.7}, 30'000.0, 60.0, 6000.0}};
  databuffer::WorldState state = world::world_state_from(world);
  state.flags = {};
  state.edit = 1;
  return state;
}

TEST(Replay, UsesAWorldFromItsTickOn) {
  Recorded recorded;
  recorded.run(300);
  recorded.change_world(rainy_world());
  recorded.run(400);
  EXPECT_EQ(recorded.comparison().different(), 0U);
  EXPECT_GT(recorded.comparison().equal(), 500U);
}

TEST(Replay, KeepsTheWorldOverARestartOfTheModel) {
  Recorded recorded;
  recorded.run(300);
  recorded.change_world(rainy_world());
  recorded.run(100);
  recorded.restart();
  recorded.run(300);
  EXPECT_EQ(recorded.comparison().different(), 0U);
  EXPECT_GT(recorded.comparison().equal(), 400U);
}

TEST(Replay, OfTheConfiguredWorldUsesItsOwnConfiguration) {
  radar::RadarConfiguration configuration;
  configuration.world.rain.cells = {{{37.25, -121.7}, 30'000.0, 60.0, 6000.0}};
  Recorded recorded(nullptr, nullptr, configuration);
  databuffer::WorldState world = world::world_state_from({});
  recorded.tell_replay(world);  // the values are another configuration's
  recorded.run(300);
  EXPECT_EQ(recorded.comparison().different(), 0U);
  EXPECT_GT(recorded.comparison().equal(), 150U);
}

TEST(Replay, ComputesEverySweepAgain) {
  Recorded recorded;
  recorded.run(1000);
  EXPECT_GT(recorded.comparison().equal(), 800U);
  EXPECT_EQ(recorded.comparison().different(), 0U);
  EXPECT_EQ(recorded.comparison().missing(), 0U);
}

TEST(Replay, ComputesTheSameSweepsThoughTheLiveViewHasMoreScenes) {
  const auto folder = std::filesystem::temp_directory_path() / ("yars_replay_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  std::vector<radar::Scene> scenes;
  for (const geo::GeoPoint position :
       {geo::GeoPoint{38.4, -122.0}, geo::GeoPoint{37.15, -121.85}, geo::GeoPoint{37.2, -121.8}}) {
    scenes.push_back({.file = (folder / (std::to_string(scenes.size()) + ".flt")).string()});
    const auto bytes =
        test::flt_of({{}, {90.0, 0.0, 40.0, 15.0, 12.0, 3}, {0.0, 300.0, 45.0, 900.0, 0.0, 9}}, position);
    std::ofstream(scenes.back().file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }
  model::scene::SceneStoreOptions options;
  options.use = model::scene::SceneUse::scatterers;
  const auto open = [&] {
    return std::move(
        *model::scene::SceneStore::open(scenes, std::make_unique<model::terrain::FixedTerrainStore>(hills()), options));
  };
  const auto live = open(), replayed = open();
  Recorded with_scenes(live.get(), replayed.get());
  with_scenes.run(600);
  EXPECT_GT(with_scenes.comparison().equal(), 450U);
  EXPECT_EQ(with_scenes.comparison().different(), 0U);
  const auto live_only = open();
  Recorded without(live_only.get(), nullptr);
  without.run(600);
  EXPECT_GT(without.comparison().different(), 10U) << "the scenes change the sweeps";
  std::filesystem::remove_all(folder);
}

TEST(Replay, ContinuesWithTheStatusFromWhichARestartedModelResumed) {
  for (int before = 395; before < 405; ++before) {
    SCOPED_TRACE(before);
    Recorded recorded;
    recorded.run(before);
    recorded.restart();
    recorded.run(200);
    recorded.kill_inside_tick(false);
    recorded.run(200);
    recorded.kill_inside_tick(true);
    recorded.run(200);
    EXPECT_GT(recorded.comparison().equal(), 700U);
    EXPECT_EQ(recorded.comparison().different(), 0U);
    EXPECT_EQ(recorded.comparison().missing(), 0U);
    EXPECT_LE(recorded.comparison().extra(), 1U);  // sweep of the unfinished tick
  }
}

// Sweeps with sub-beams use rays of earlier sweeps. These were measured from other positions of the aircraft.
TEST(Replay, ComputesSweepsWithSubBeamsInFlightWhereverTheRecordingBegins) {
  for (const int before : {300, 341}) {
    SCOPED_TRACE(before);
    radar::RadarConfiguration configuration;
    configuration.fidelity.sub_beams = 13;
    configuration.fidelity.samples = 2048;  // half of one is 18 m at 40 NM
    Recorded recorded(nullptr, nullptr, configuration);
    recorded.fly();
    recorded.run_before_the_recorder(before);
    recorded.run(200);
    recorded.restart();
    recorded.run(200);
    EXPECT_GT(recorded.comparison().equal(), 300U);
    EXPECT_EQ(recorded.comparison().different(), 0U);
    EXPECT_LE(recorded.comparison().missing(), 17U);
  }
}

// In a turn against a slow scan the beam hardly moves. Its rays are measured again every 50 ms, in ticks that depend on
// when the pass began.
TEST(Replay, ComputesSweepsInATurnAgainstASlowScanWhereverTheRecordingBegins) {
  for (const int before : {1500, 1506}) {
    SCOPED_TRACE(before);
    radar::RadarConfiguration configuration;
    configuration.antenna.azimuth_rate_dps = 10.0;
    configuration.fidelity.sub_beams = 13;
    configuration.fidelity.samples = 256;
    Recorded recorded(nullptr, nullptr, configuration);
    recorded.fly();
    recorded.turn(-8.0);
    recorded.run_before_the_recorder(before);
    recorded.run(3000);
    EXPECT_GT(recorded.comparison().equal(), 1000U);
    EXPECT_EQ(recorded.comparison().different(), 0U);
  }
}

TEST(Replay, ComputesTheSweepsAfterAVelocityUpdateThoughTheModelWasRestartedDuringIt) {
  for (const int before : {5, 150, 300, 600}) {
    SCOPED_TRACE(before);
    Recorded recorded;
    recorded.run(300);
    recorded.update_velocity();
    recorded.run(before);
    recorded.restart();
    recorded.run(1200 - before);
    EXPECT_EQ(recorded.status().velocity_count, 1U);
    EXPECT_GT(recorded.comparison().equal(), 500U);
    EXPECT_EQ(recorded.comparison().different(), 0U);
    EXPECT_EQ(recorded.comparison().missing(), 0U);
  }
}

TEST(Replay, ADifferentSweepIsCounted) {
  Comparison comparison;
  databuffer::Sweep sweep{};
  sweep.number = 3;
  sweep.hash = 17;
  comparison.replayed(sweep);
  sweep.hash = 18;
  comparison.recorded(digest_of(sweep));
  EXPECT_EQ(comparison.different(), 1U);
  EXPECT_EQ(comparison.equal(), 0U);
}

}  // namespace
}  // namespace yars::recording

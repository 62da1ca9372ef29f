// Changes of the world while the kernel runs: the sweeps are those of a kernel that had the world from its start, the
// scan goes on, and an equal world changes nothing.
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "tests/model/kernel/cockpit.hpp"

namespace yars::model::kernel {
namespace {

using Change = std::function<void(radar::WorldConfiguration&)>;

constexpr int kTicksBefore = 120, kTicksAfter = 260;  // 0.6 s and 1.3 s: the change falls into the middle of a scan
constexpr std::size_t kSmearMemory = 2;               // [sweeps] measured before the change that its first sweeps use

struct Named {
  std::string name;
  Change change;
};

void add_rain(radar::WorldConfiguration& world) {
  world.rain.cells.push_back({{37.25, -121.7}, 30'000.0, 60.0, 6000.0});
}
void add_jammer(radar::WorldConfiguration& world) {
  radar::Jammer jammer;
  jammer.position = {37.3, -121.8};
  world.jamming.jammers.push_back(jammer);
}
// In the beam during the second half of the first scan.
void add_mover(radar::WorldConfiguration& world) {
  radar::Mover mover;
  mover.position = {37.15, -121.8};
  mover.cross_section_m2 = 1e6;
  mover.speed_mps = 15.0;
  mover.since = geo::Duration::seconds(0.3);
  world.movers.push_back(mover);
}

std::vector<Named> changes() {
  return {{"rain", add_rain},
          {"sea state", [](auto& world) { world.sea.state = 6.0; }},
          {"wind", [](auto& world) { world.sea.wind_from_deg = 45.0; }},
          {"jammer", add_jammer},
          {"mover", add_mover}};
}

radar::RadarConfiguration with_sub_beams(int count) {
  radar::RadarConfiguration configuration;
  configuration.fidelity.samples = 120;
  configuration.fidelity.sub_beams = count;
  return configuration;
}

// A cockpit over the sea.
struct SeaCockpit : test::Cockpit {
  SeaCockpit(const radar::RadarConfiguration& configuration, radar::Mode mode)
      : Cockpit(configuration, terrain::flat(0.0)) {
    tick.command.mode = static_cast<std::uint8_t>(mode);
    tick.command.channel = 1;
  }
};

std::size_t count_different(const std::vector<databuffer::Sweep>& a, const std::vector<databuffer::Sweep>& b) {
  std::size_t different = 0;
  for (std::size_t i = 0; i < a.size(); ++i) different += a[i].hash != b[i].hash;
  return different;
}

// Sweeps of a kernel configured with one world, changed to another one after kTicksBefore, from then on.
std::vector<databuffer::Sweep> changed_sweeps(test::Cockpit& cockpit, const radar::WorldConfiguration& world) {
  cockpit.run(kTicksBefore);
  cockpit.kernel.use_world(world);
  return cockpit.run(kTicksAfter);
}

// Sweeps after kTicksBefore of a kernel whose world stays.
std::vector<databuffer::Sweep> unchanged_sweeps(const radar::RadarConfiguration& configuration, radar::Mode mode) {
  SeaCockpit cockpit(configuration, mode);
  cockpit.run(kTicksBefore);
  return cockpit.run(kTicksAfter);
}

// `old_world`: the sweeps without a change.
void expect_sweeps_of_the_new_world(const radar::RadarConfiguration& before, const radar::RadarConfiguration& after,
                                    radar::Mode mode, const std::vector<databuffer::Sweep>& old_world) {
  SeaCockpit changed(before, mode);
  const auto sweeps = changed_sweeps(changed, after.world);
  const auto expected = unchanged_sweeps(after, mode);
  ASSERT_EQ(sweeps.size(), expected.size()) << "no sweep is lost";
  ASSERT_GT(sweeps.size(), kSmearMemory + 10);
  for (std::size_t i = 0; i < sweeps.size(); ++i) {
    ASSERT_EQ(sweeps[i].number, expected[i].number);
    ASSERT_EQ(sweeps[i].flags, expected[i].flags);
    if (i < kSmearMemory) continue;
    ASSERT_EQ(sweeps[i].hash, expected[i].hash) << "sweep " << i << " after the change";
  }
  EXPECT_GT(count_different(sweeps, old_world), 0U) << "the change is seen";
}

TEST(WorldChange, GivesTheSweepsOfAKernelThatHadTheWorldFromItsStart) {
  for (const auto algorithm : {radar::Algorithm::standard, radar::Algorithm::reference})
    for (const int sub_beams : {1, 4}) {
      radar::RadarConfiguration before = with_sub_beams(sub_beams);
      before.fidelity.algorithm = algorithm;
      before.fidelity.samples = algorithm == radar::Algorithm::reference ? 40 : 120;
      const auto old_world = unchanged_sweeps(before, radar::Mode::rbm);
      for (const auto& [name, change] : changes()) {
        radar::RadarConfiguration after = before;
        change(after.world);
        SCOPED_TRACE(name + ", algorithm " + std::to_string(static_cast<int>(algorithm)) + ", sub-beams " +
                     std::to_string(sub_beams));
        expect_sweeps_of_the_new_world(before, after, radar::Mode::rbm, old_world);
      }
    }
}

TEST(WorldChange, GivesTheSweepsOfTheNewWorldWithDopplerBeamSharpening) {
  const auto old_world = unchanged_sweeps(with_sub_beams(1), radar::Mode::hrm);
  for (const auto& [name, change] : changes()) {
    if (name == "mover") continue;  // it is not in the sector
    radar::RadarConfiguration after = with_sub_beams(1);
    change(after.world);
    SCOPED_TRACE(name);
    expect_sweeps_of_the_new_world(with_sub_beams(1), after, radar::Mode::hrm, old_world);
  }
}

TEST(WorldChange, OfWhatWasConfiguredTakesItAway) {
  for (const auto& [name, change] : changes()) {
    radar::RadarConfiguration before = with_sub_beams(4);
    change(before.world);
    SCOPED_TRACE(name);
    expect_sweeps_of_the_new_world(before, with_sub_beams(4), radar::Mode::rbm,
                                   unchanged_sweeps(before, radar::Mode::rbm));
  }
}

TEST(WorldChange, ToAnEqualWorldChangesNoBit) {
  radar::RadarConfiguration configuration = with_sub_beams(4);
  for (const auto& [name, change] : changes()) change(configuration.world);
  SeaCockpit told(configuration, radar::Mode::rbm), left(configuration, radar::Mode::rbm);
  for (int i = 0; i < kTicksBefore; ++i) {
    // In flight, so that rays that were measured again would differ.
    for (SeaCockpit* cockpit : {&told, &left}) cockpit->tick.ownship.latitude_deg += 1e-5;
    told.kernel.use_world(configuration.world);
    const auto* sweep = told.step();
    const auto* expected = left.step();
    ASSERT_EQ(sweep == nullptr, expected == nullptr) << i;
    if (sweep == nullptr) continue;
    ASSERT_EQ(sweep->hash, expected->hash) << i;
  }
}

// In SNIFF (receive only) a jammer alone needs terrain.
TEST(WorldChange, AddsAJammerWhoseLineOfSightNeedsTerrain) {
  SeaCockpit cockpit({}, radar::Mode::rbm);
  cockpit.set_flag(databuffer::kSniff, true);
  EXPECT_FALSE(cockpit.kernel.need(cockpit.tick).ground);
  radar::WorldConfiguration world;
  add_jammer(world);
  cockpit.kernel.use_world(world);
  EXPECT_TRUE(cockpit.kernel.need(cockpit.tick).ground);
}

TEST(WorldChange, OutlastsAChangeOfTheNumberOfSamples) {
  radar::RadarConfiguration after = with_sub_beams(1);
  add_rain(after.world);
  SeaCockpit changed(with_sub_beams(1), radar::Mode::rbm), configured(after, radar::Mode::rbm);
  changed.kernel.use_world(after.world);
  changed.tick.samples = configured.tick.samples = 90;
  const auto sweeps = changed.run(kTicksAfter), expected = configured.run(kTicksAfter);
  ASSERT_EQ(sweeps.size(), expected.size());
  EXPECT_EQ(count_different(sweeps, expected), 0U);
  EXPECT_EQ(sweeps.back().samples, 90U);
}

}  // namespace
}  // namespace yars::model::kernel

// What the recorder takes from a session in which a model runs already.
#include "tools/session/recorder.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <variant>
#include <vector>

#include "radar/recording/recording_io.hpp"
#include "tests/databuffer/session/open_session.hpp"
#include "tests/model/kernel/cockpit.hpp"
#include "tests/model/terrain/formats/dted_builder.hpp"
#include "world/world_values.hpp"

namespace yars::tools {
namespace {

class RecorderTest : public databuffer::testing::OpenSessionTest {
 protected:
  // Publishes a tick, and the model's status after it unless the model is still computing.
  void run_tick(databuffer::Session& session, bool still_computes) {
    cockpit_.step();
    session.layout().model_ticks.publish(cockpit_.tick);
    if (!still_computes) session.layout().model_status.publish(cockpit_.status());
  }
  std::vector<std::int64_t> recorded_ticks(databuffer::Session& session, int ticks_after) {
    const auto path = folder_.path() / "recording";
    {
      auto writer = recording::RecordingWriter::create(path, {});
      Recorder recorder(session, *writer, {}, false);
      for (int i = 0; i < ticks_after; ++i) run_tick(session, false);
      recorder.drain(cockpit_.tick.tick);
      recorder.flush();
    }
    auto reader = recording::RecordingReader::open(path);
    std::vector<std::int64_t> ticks;
    while (const auto item = reader->next()) {
      if (const auto* start = std::get_if<recording::StartingPoint>(&*item)) start_ = start->status.tick;
      if (const auto* tick = std::get_if<databuffer::ModelTick>(&*item)) ticks.push_back(tick->tick);
    }
    return ticks;
  }

  radar::RadarConfiguration configuration_;
  test::Cockpit cockpit_{configuration_, model::terrain::flat(0.0)};
  test::TemporaryFolder folder_;
  std::int64_t start_ = -1;
};

TEST_F(RecorderTest, BeginsWithTheTickAfterTheStatus) {
  for (const bool still_computes : {false, true}) {
    auto session = open();
    for (int i = 0; i < 100; ++i) run_tick(session, false);
    const std::int64_t last_status = cockpit_.tick.tick;
    if (still_computes) run_tick(session, true);
    const auto ticks = recorded_ticks(session, 5);
    EXPECT_EQ(start_, last_status);
    ASSERT_EQ(ticks.size(), still_computes ? 6U : 5U);
    for (std::size_t i = 0; i < ticks.size(); ++i)
      EXPECT_EQ(ticks[i], last_status + 1 + static_cast<std::int64_t>(i)) << still_computes;
    std::filesystem::remove(folder_.path() / "recording");
  }
}

// Worlds and ticks in the order of a recording: the edit of a world, or -1 for a tick.
std::vector<std::int64_t> edits_and_ticks(const std::filesystem::path& path) {
  std::vector<std::int64_t> found;
  auto reader = recording::RecordingReader::open(path);
  while (const auto item = reader->next()) {
    if (const auto* world = std::get_if<databuffer::WorldState>(&*item)) found.push_back(std::int64_t(world->edit));
    if (std::holds_alternative<databuffer::ModelTick>(*item)) found.push_back(-1);
  }
  return found;
}

TEST_F(RecorderTest, WritesTheWorldInEffectBeforeTheFirstTickAndEachLaterOneBeforeItsTick) {
  auto session = open();
  const auto latch = [&](std::uint64_t edit) {
    databuffer::WorldState world = world::world_state_from({});
    world.edit = edit;
    session.layout().world_latched.publish(world);
    cockpit_.tick.world = session.layout().world_latched.next();
  };
  for (const std::uint64_t edit : {0U, 1U, 2U}) {
    latch(edit);
    run_tick(session, false);
  }
  const auto path = folder_.path() / "worlds";
  {
    auto writer = recording::RecordingWriter::create(path, {});
    Recorder recorder(session, *writer, {}, false);
    // Latched after the recorder began, and before it reads the tick that used the world before.
    run_tick(session, true);
    latch(3);
    run_tick(session, true);
    recorder.drain(cockpit_.tick.tick);
    recorder.flush();
  }
  EXPECT_EQ(edits_and_ticks(path), (std::vector<std::int64_t>{2, -1, 3, -1}));
}

TEST_F(RecorderTest, WithoutAWorldWritesNone) {
  auto session = open();
  run_tick(session, false);
  const auto path = folder_.path() / "no-world";
  {
    auto writer = recording::RecordingWriter::create(path, {});
    Recorder recorder(session, *writer, {}, false);
    run_tick(session, true);
    recorder.drain(cockpit_.tick.tick);
    recorder.flush();
  }
  EXPECT_EQ(edits_and_ticks(path), std::vector<std::int64_t>{-1});
}

}  // namespace
}  // namespace yars::tools

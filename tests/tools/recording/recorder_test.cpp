// What the recorder takes from a session in which a model runs already.
#include "tools/session/recorder.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <variant>
#include <vector>

#include "tests/databuffer/session/open_session.hpp"
#include "tests/model/kernel/cockpit.hpp"
#include "tests/model/terrain/formats/dted_builder.hpp"
#include "tools/recording/recording_reader.hpp"
#include "tools/recording/recording_writer.hpp"

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

}  // namespace
}  // namespace yars::tools

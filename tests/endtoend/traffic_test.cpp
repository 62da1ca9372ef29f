// Surface traffic of an external program: radar-model latches it, and drops it when its source ends. Invalid traffic is
// refused. A replay of the recording computes the same sweeps.
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <optional>

#include "databuffer/session/session.hpp"
#include "radar/recording/recording_io.hpp"
#include "tests/endtoend/process_set.hpp"

namespace yars::endtoend {
namespace {

using databuffer::Traffic;

// Three ships on a line from south to north.
Traffic a_convoy(std::uint32_t epoch) {
  Traffic traffic{};
  traffic.count = 3;
  traffic.epoch = epoch;
  for (std::uint32_t i = 0; i < traffic.count; ++i)
    traffic.entities[i] = {37.5 + 0.05 * i, -122.8, 5.0, 8.0, 10.0, 1e6, i + 1, 0};
  return traffic;
}

std::vector<Traffic> traffic_in(const std::filesystem::path& file) {
  std::vector<Traffic> found;
  auto reader = recording::RecordingReader::open(file);
  if (!reader) return found;
  while (const auto item = reader->next())
    if (const auto* traffic = std::get_if<Traffic>(&*item)) found.push_back(*traffic);
  return found;
}

TEST(TrafficFromOutside, IsLatchedDroppedAndReplayed) {
  ProcessSet set("traffic");
  set.start("state", {"state-machine"});
  set.start("model", {"radar-model"});
  set.start("flight", {"flight-model", "--source", "fixed:37.5,-123.0,15000,90,480"});
  const auto recording = set.folder() / "traffic.yarsrec";
  set.start("recorder", {"yars", "record", recording.string()});
  ASSERT_TRUE(set.wait_until([](const auto& watch) { return watch["tick"] > 20; })) << set.log_of("model");
  ASSERT_TRUE(eventually([&] { return set.is_recorded(); }, 60.0)) << set.log_of("recorder");
  ASSERT_EQ(set.yars({"inject", "power opr"}).code, 0);

  auto session = databuffer::Session::open(set.session(), "instructor");
  ASSERT_TRUE(session);
  auto claim = std::make_optional(session->claim(databuffer::Role::traffic));
  ASSERT_TRUE(*claim);
  auto& layout = session->layout();
  const auto latched = [&](std::uint64_t number) {
    return eventually([&] { return layout.traffic_latched.next() >= number; }, 30.0);
  };
  layout.traffic.publish(a_convoy(session->clock().epoch));
  ASSERT_TRUE(latched(1));
  const std::string status = set.yars({"status"}).output;
  EXPECT_NE(status.find("traffic: pid " + std::to_string(getpid()) + " reports 3 ships"), std::string::npos) << status;
  EXPECT_TRUE(set.wait_until([](const auto& watch) { return watch["sweeps"] > 400; }, 60.0));
  Traffic bad = a_convoy(session->clock().epoch);
  bad.entities[2].longitude_deg = 500.0;
  layout.traffic.publish(bad);
  EXPECT_TRUE(eventually([&] { return set.yars({"status"}).output.find("longitude_deg") != std::string::npos; }, 30.0));
  layout.traffic.clear();
  claim.reset();
  ASSERT_TRUE(latched(2)) << "a record without entities";
  const auto sweeps = set.watch()["sweeps"].get<int>();
  EXPECT_TRUE(set.wait_until([&](const auto& watch) { return watch["sweeps"] > sweeps + 100; }, 60.0));
  set.kill("recorder", SIGTERM);
  ASSERT_EQ(set.wait("recorder"), 0) << set.log_of("recorder");
  EXPECT_EQ(set.end_all(), (std::map<std::string, int>{{"state", 0}, {"model", 0}, {"flight", 0}}));

  const auto recorded = traffic_in(recording);
  ASSERT_EQ(recorded.size(), 2U);
  EXPECT_EQ(recorded[0].count, 3U);
  EXPECT_EQ(recorded[1].count, 0U);
  const auto replay = nlohmann::json::parse(set.yars({"replay", recording.string(), "--events"}, 240.0).output);
  EXPECT_EQ(replay["different"], 0) << replay.dump();
  EXPECT_LE(replay["missing"], 17) << "sweeps that use rays from before the recording: " << replay.dump();
  EXPECT_GT(replay["equal"].get<int>() + replay["not_ready"].get<int>(), 400);
}

}  // namespace
}  // namespace yars::endtoend

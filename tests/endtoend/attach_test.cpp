// The example flight models of docs/attach.md, in C and in Python, fly a running set. When an attached flight model
// stops, the set's own flight model takes over, and hands back when the attached one continues.
#include <gtest/gtest.h>
#include <signal.h>

#include <cmath>

#include "databuffer/session/receivers.hpp"
#include "databuffer/session/session.hpp"
#include "lib/geo/geodesy.hpp"
#include "tests/endtoend/process_set.hpp"

namespace yars::endtoend {
namespace {

constexpr double kMaxSpeed_mps = 300.0;  // more than the speed of every source in this file

geo::GeoPoint position_of(const nlohmann::json& watch) {
  return {watch["ownship"]["lat"].get<double>(), watch["ownship"]["lon"].get<double>()};
}

double metres_between(geo::GeoPoint from, geo::GeoPoint to) {
  return geo::geodesic_inverse(from, to).distance.metres();
}

bool comes_from(const nlohmann::json& watch, const char* source) {
  return !watch["ownship"].is_null() && watch["ownship"]["source"] == source;
}

// Sim time [s] at which the radar received the position. On a busy machine that is a while before the clock's time.
double received_s(const nlohmann::json& watch) {
  return watch["sim_time"].get<double>() - 1e-3 * watch["ownship"]["age_ms"].get<double>();
}

// Expects the flight of both examples: a circle of radius 8 km about `centre`, at 200 m/s.
void expect_circles(const ProcessSet& set, const char* source, geo::GeoPoint centre) {
  ASSERT_TRUE(set.wait_until([&](const auto& watch) { return comes_from(watch, source); })) << set.watch().dump();
  const auto before = set.watch();
  ASSERT_TRUE(set.wait_until([&](const auto& watch) { return watch["tick"] > before["tick"].get<int>() + 200; }));
  const auto after = set.watch();
  EXPECT_NEAR(metres_between(centre, position_of(after)), 8000.0, 60.0) << after.dump();
  const double time_s = received_s(after) - received_s(before);
  EXPECT_NEAR(metres_between(position_of(before), position_of(after)) / time_s, 200.0, 40.0);
}

TEST(AttachedFlightModel, TheExampleInCFliesTheRadar) {
  ProcessSet set("attach-c");
  set.start("state", {"state-machine"});
  set.start("model", {"radar-model"});
  ASSERT_TRUE(set.wait_until([](const auto& watch) { return watch["tick"] > 10; })) << set.log_of("model");
  set.start_tool("fly", {YARS_BIN_DIR "/example_fly", set.session(), "37.5", "-122.5"});
  expect_circles(set, "fly.c", {37.5, -122.5});
  ASSERT_EQ(set.yars({"inject", "power opr"}).code, 0);
  EXPECT_TRUE(set.wait_until([](const auto& watch) { return watch["sweeps"] > 50; }));
  set.kill("fly", SIGTERM);
  EXPECT_EQ(set.wait("fly"), 0) << set.log_of("fly");
  for (const auto& [role, code] : set.end_all()) EXPECT_EQ(code, 0) << role;
  EXPECT_FALSE(set.segment_exists());
}

TEST(AttachedFlightModel, TheExampleInPythonFliesTheRadar) {
  ProcessSet set("attach-python");
  set.start("state", {"state-machine"});
  set.start("model", {"radar-model"});
  ASSERT_TRUE(set.wait_until([](const auto& watch) { return watch["tick"] > 10; })) << set.log_of("model");
  set.start_tool("fly", {"python3", "-B", YARS_SOURCE_DIR "/examples/fly.py", set.session(), "37.5", "-122.5"});
  expect_circles(set, "fly.py", {37.5, -122.5});
  set.kill("fly", SIGTERM);
  EXPECT_EQ(set.wait("fly"), 0) << set.log_of("fly");
  for (const auto& [role, code] : set.end_all()) EXPECT_EQ(code, 0) << role;
  EXPECT_FALSE(set.segment_exists());
}

// Reads all ticks of radar-model. Collects the jumps of the latched position within an epoch, and counts the changes of
// the source.
class JumpDetector {
 public:
  explicit JumpDetector(const databuffer::SessionLayout& layout)
      : layout_(&layout), cursor_(layout.model_ticks.next()) {}
  void poll() {
    databuffer::ModelTick tick{};
    for (auto read = layout_->model_ticks.read(cursor_, tick); read.delivered;
         read = layout_->model_ticks.read(cursor_, tick)) {
      if ((tick.flags & databuffer::kTickOwnshipValid) == 0U) continue;
      const geo::GeoPoint position{tick.ownship.latitude_deg, tick.ownship.longitude_deg};
      if (seen_ > 0 && tick.epoch == epoch_) {
        const double time_s = 5e-3 * static_cast<double>(tick.tick - tick_);
        const double max_jump_m = databuffer::kPositionTolerance_m + 40.0 + kMaxSpeed_mps * time_s;
        if (const double jump_m = metres_between(position_, position); jump_m > max_jump_m)
          unexplained_.push_back(std::string(source_) + " to " + tick.ownship.source + ": " + std::to_string(jump_m));
      }
      if (seen_ > 0 && source_ != tick.ownship.source) ++changes_;
      position_ = position;
      tick_ = tick.tick;
      epoch_ = tick.epoch;
      source_ = tick.ownship.source;
      ++seen_;
    }
  }
  const std::vector<std::string>& unexplained() const { return unexplained_; }
  int changes() const { return changes_; }
  std::uint64_t seen() const { return seen_; }

 private:
  const databuffer::SessionLayout* layout_;
  std::uint64_t cursor_;
  geo::GeoPoint position_;
  std::int64_t tick_ = 0;
  std::uint32_t epoch_ = 0;
  std::string source_;
  std::vector<std::string> unexplained_;
  int changes_ = 0;
  std::uint64_t seen_ = 0;
};

TEST(AttachedFlightModel, AStopAndAContinuationChangeTheSourceWithoutJumpsWithinAnEpoch) {
  ProcessSet set("attach-stop");
  set.start("state", {"state-machine"});
  set.start("model", {"radar-model"});
  set.start("own", {"flight-model", "--source", "fixed:36.9,-121.0,15000,90,400"});
  ASSERT_TRUE(set.wait_until([](const auto& watch) { return comes_from(watch, "fixed"); })) << set.log_of("own");
  auto session = databuffer::Session::open_read_only(set.session());
  ASSERT_TRUE(session);
  JumpDetector detector(std::as_const(*session).layout());
  const auto flies = [&](const char* source) {
    return eventually(
        [&] {
          detector.poll();
          return comes_from(set.watch(), source);
        },
        30.0);
  };
  set.start_tool("fly", {YARS_BIN_DIR "/example_fly", set.session(), "37.5", "-122.5"});
  ASSERT_TRUE(flies("fly.c"));
  EXPECT_TRUE(set.runs("own")) << "the set's own flight model stands by";
  for (int round = 0; round < 2; ++round) {
    set.kill("fly", SIGSTOP);
    ASSERT_TRUE(flies("fixed"));
    // The set's own flight model continues near the circle, not from its configured start.
    EXPECT_LT(metres_between({37.5, -122.5}, position_of(set.watch())), 12000.0);
    set.kill("fly", SIGCONT);
    ASSERT_TRUE(flies("fly.c"));
  }
  detector.poll();
  EXPECT_EQ(detector.unexplained(), std::vector<std::string>{});
  EXPECT_GE(detector.changes(), 5) << "from fixed to fly.c, then twice to fixed and back; more when fly.c is held up";
  EXPECT_GT(detector.seen(), 200U);
  set.kill("fly", SIGTERM);
  EXPECT_EQ(set.wait("fly"), 0);
  for (const auto& [role, code] : set.end_all()) EXPECT_EQ(code, 0) << role;
}

TEST(AttachedFlightModel, TheExampleEndsWithTheSetAndRemovesTheSegment) {
  ProcessSet set("attach-end");
  set.start("state", {"state-machine"});
  set.start("model", {"radar-model"});
  ASSERT_TRUE(set.wait_until([](const auto& watch) { return watch["tick"] > 10; })) << set.log_of("model");
  set.start_tool("fly", {YARS_BIN_DIR "/example_fly", set.session(), "37.5", "-122.5"});
  ASSERT_TRUE(set.wait_until([](const auto& watch) { return comes_from(watch, "fly.c"); })) << set.watch().dump();
  set.kill("model", SIGTERM);
  EXPECT_EQ(set.wait("model"), 0);
  EXPECT_TRUE(set.runs("fly")) << "state-machine still runs";
  set.kill("state", SIGTERM);
  EXPECT_EQ(set.wait("state"), 0);
  EXPECT_EQ(set.wait("fly"), 0) << set.log_of("fly");
  EXPECT_FALSE(set.segment_exists());
}

TEST(AttachedFlightModel, AnUnnamedFlightModelIsReportedByItsLane) {
  ProcessSet set("attach-unnamed");
  set.start("state", {"state-machine"});
  set.start("model", {"radar-model"});
  ASSERT_TRUE(set.wait_until([](const auto& watch) { return watch["tick"] > 10; })) << set.log_of("model");
  auto session = databuffer::Session::open(set.session(), "mine");
  ASSERT_TRUE(session);
  const auto lane = session->claim_ownship_lane(50);
  ASSERT_TRUE(lane);
  databuffer::Ownship own{};
  own.longitude_deg = -122.5;
  own.altitude_msl_m = 4500.0;
  own.radar_altitude_m = std::nan("");
  const auto status_has = [&](double latitude_deg, const char* expected) {
    own.latitude_deg = latitude_deg;
    return eventually(
        [&] {
          own.epoch = session->clock().epoch;
          ++own.source_time_ns;
          session->layout().ownship[lane->lane()].publish(own);
          const std::string status_text = set.yars({"status"}).output;
          return status_text.find(expected) != std::string::npos && status_text.find("no ownship") == std::string::npos;
        },
        20.0);
  };
  EXPECT_TRUE(status_has(37.5, "ownship: unnamed (lane 0), 37.5")) << set.yars({"status"}).output;
  EXPECT_TRUE(status_has(39.5, "the aircraft of 'unnamed (lane 0)' has jumped")) << set.yars({"status"}).output;
}

}  // namespace
}  // namespace yars::endtoend

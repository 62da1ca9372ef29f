// Test of a set whose aircraft comes from JSBSim, over the coast of California, with the aircraft and the script of
// tests/flightmodel/bridges/jsbsim. JSBSim sends each state twice: to flight-model as text, and to this test in the
// format FLIGHTGEAR with full precision. The ownship that radar-model latches must lie on JSBSim's path at about the
// right time. The environment's YARS_JSBSIM names the program, else the test searches for it. YARS_JSBSIM_SECONDS:
// duration, default 20 s.
#include <gmock/gmock.h>
#include <signal.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "flightmodel/bridges/bridge.hpp"
#include "lib/geo/frames.hpp"
#include "tests/flightmodel/bridges/live/bridged_set.hpp"
#include "tests/flightmodel/bridges/live/udp_peer.hpp"

namespace yars::endtoend {
namespace {

using databuffer::Ownship;

// The error is at most 4.5 m, half a step of longitude in JSBSim's text, plus 3 m. The 3 m are the error of one second
// of dead reckoning in the hardest turn, when a loaded machine delays JSBSim by a second. The rest is margin.
constexpr double kPathBound_m = 10.0;
constexpr double kAltitudeBound_m = 6.0;  // climb of 12 m/s, reported 0.5 s late
constexpr double kHeadingBound_deg = 2.0;
// Time before and after a latched position in which JSBSim's path is searched: a loaded machine delays programs, and
// JSBSim then catches up. Within this time the path does not cross itself.
constexpr double kTimeBound_s = 5.0;

std::string jsbsim_program() {
  if (const char* named = std::getenv("YARS_JSBSIM"); named != nullptr) return named;
  if (tool_exists("JSBSim")) return "JSBSim";
  const char* games = "/usr/games/JSBSim";
  return std::filesystem::exists(games) ? games : "";
}

double flight_seconds() {
  const char* given = std::getenv("YARS_JSBSIM_SECONDS");
  return given == nullptr ? 20.0 : std::atof(given);
}

std::string text_of_file(const std::filesystem::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

// Writes JSBSim's output directive `text` to `file`, with the port in place of @PORT@. Returns the option for the file.
std::string write_output(const std::filesystem::path& file, std::string text, std::uint16_t port) {
  const std::string placeholder = "@PORT@";
  text.replace(text.find(placeholder), placeholder.size(), std::to_string(port));
  std::ofstream(file) << text;
  return "--logdirectivefile=" + file.string();
}

// A state of JSBSim, or a latched ownship.
struct TimedOwnship {
  double received_s;  // monotonic clock; of a latched ownship: its source time
  databuffer::Ownship own;
};

// Error of a latched ownship: distance from JSBSim's path, and differences from JSBSim's state at the nearest point.
struct Miss {
  double path_m = 1e9, altitude_m = 1e9, heading_deg = 1e9, late_s = 1e9;
};

Miss miss_of(const databuffer::Ownship& own, double latched_s, const std::deque<TimedOwnship>& truths) {
  const geo::LocalTangentFrame frame({own.latitude_deg, own.longitude_deg}, geo::HeightAboveEllipsoid());
  const auto to_plane = [&frame](const databuffer::Ownship& position) {
    return frame.enu_from_geodetic({position.latitude_deg, position.longitude_deg}, geo::HeightAboveEllipsoid());
  };
  Miss best;
  for (std::size_t i = 1; i < truths.size(); ++i) {
    const TimedOwnship &a = truths[i - 1], &b = truths[i];
    if (std::abs(a.received_s - latched_s) > kTimeBound_s) continue;
    const auto from = to_plane(a.own), to = to_plane(b.own);
    const double dx = to.x - from.x, dy = to.y - from.y;
    const double share = std::clamp(-(from.x * dx + from.y * dy) / (dx * dx + dy * dy), 0.0, 1.0);
    const double path_m = std::hypot(from.x + share * dx, from.y + share * dy);
    if (path_m >= best.path_m) continue;
    const double altitude_m = a.own.altitude_msl_m + share * (b.own.altitude_msl_m - a.own.altitude_msl_m);
    best = {path_m, std::abs(own.altitude_msl_m - altitude_m),
            std::abs(geo::wrapped_degrees(own.heading_deg - a.own.heading_deg)),
            latched_s - (a.received_s + share * (b.received_s - a.received_s))};
  }
  return best;
}

class JsbsimLive : public BridgedSet {
 protected:
  JsbsimLive() : BridgedSet("jsbsim") {}

  void start_jsbsim(const std::string& program, std::uint16_t text_port, std::uint16_t native_port, double seconds) {
    const std::filesystem::path root = YARS_SOURCE_DIR "/tests/flightmodel/bridges/jsbsim";
    const std::string native = R"(<output name="localhost" type="FLIGHTGEAR" port="@PORT@" protocol="UDP" rate="50"/>)";
    set_.start_tool("jsbsim",
                    {program, "--realtime", "--nice", "--nohighlight", "--root=" + root.string(),
                     "--script=scripts/coast.xml", "--end=" + std::to_string(seconds),
                     write_output(set_.folder() / "text.xml", text_of_file(root / "text_output.xml"), text_port),
                     write_output(set_.folder() / "native.xml", native, native_port)});
  }

  void hear_truth(const UdpPeer& peer, int timeout_ms) {
    for (auto heard = peer.hear(timeout_ms); heard; heard = peer.hear(0)) {
      const auto sample = flightmodel::bridges::decode_flightgear(heard->datagram);
      ASSERT_TRUE(sample) << sample.error().message();
      truths_.push_back({1e-9 * static_cast<double>(databuffer::monotonic_ns()), sample->ownship});
      last_heard_s_ = truths_.back().received_s;
      if (truths_.size() > 1'000) truths_.pop_front();
    }
  }

  // Keeps the ticks whose ownship is JSBSim's, until JSBSim's states around their time have been received.
  void read_ticks() {
    databuffer::ModelTick tick{};
    while (layout().model_ticks.read(cursor_, tick).delivered) {
      if ((tick.flags & databuffer::kTickOwnshipValid) == 0U || text::text_of(tick.ownship.source) != "jsbsim")
        continue;
      if (tick.ownship.source_time_ns == last_latched_ns_) continue;
      last_latched_ns_ = tick.ownship.source_time_ns;
      const auto clock = session_->clock();
      latched_.push_back(
          {1e-9 * static_cast<double>(clock.base_monotonic_ns + last_latched_ns_ - clock.base_sim_ns), tick.ownship});
    }
  }

  void compare_settled() {
    while (!latched_.empty() && !truths_.empty() &&
           latched_.front().received_s + kTimeBound_s < truths_.back().received_s) {
      const Miss miss = miss_of(latched_.front().own, latched_.front().received_s, truths_);
      worst_.path_m = std::max(worst_.path_m, miss.path_m);
      worst_.altitude_m = std::max(worst_.altitude_m, miss.altitude_m);
      worst_.heading_deg = std::max(worst_.heading_deg, miss.heading_deg);
      worst_.late_s = std::max(worst_.late_s, std::abs(miss.late_s));
      latched_.pop_front();
      ++compared_;
    }
  }

  std::deque<TimedOwnship> truths_, latched_;
  std::uint64_t cursor_ = 0;
  std::int64_t last_latched_ns_ = -1;
  double last_heard_s_ = 0.0;
  Miss worst_{0.0, 0.0, 0.0, 0.0};
  int compared_ = 0;
};

TEST_F(JsbsimLive, FliesTheRadarOverTheCoast) {
  const std::string program = jsbsim_program();
  if (program.empty()) GTEST_SKIP() << "needs JSBSim (Debian's package flightgear has it), in PATH or by YARS_JSBSIM";
  const double seconds = flight_seconds();
  const std::uint16_t port = listen("jsbsim:0");
  std::vector<std::string> options{"--config", YARS_SOURCE_DIR "/config/california.guf"};
  if (!shared_data().empty()) options.insert(options.end(), {"--terrain", (shared_data() / "dted").string()});
  start_radar(options);
  const UdpPeer truth;
  start_jsbsim(program, port, truth.port(), seconds);
  while (set_.runs("jsbsim")) {
    hear_truth(truth, 20);
    read_ticks();
    compare_settled();
  }
  std::printf("%d records compared: worst %.2f m from the path, %.2f m of altitude, %.2f deg of heading, %.3f s late\n",
              compared_, worst_.path_m, worst_.altitude_m, worst_.heading_deg, worst_.late_s);
  // 50 records per second are published. A loaded machine latches fewer, so the test requires only a minimum.
  EXPECT_GT(compared_, 100) << set_.log_of("bridge") << set_.output_of("jsbsim");
  EXPECT_LT(worst_.path_m, kPathBound_m);
  EXPECT_LT(worst_.altitude_m, kAltitudeBound_m);
  EXPECT_LT(worst_.heading_deg, kHeadingBound_deg);
  EXPECT_THAT(set_.log_of("bridge"), ::testing::Not(::testing::HasSubstr("refused")));
  for (const char* role : {"bridge", "radar-model"}) set_.kill(role, SIGTERM);
  for (const char* role : {"bridge", "radar-model"}) EXPECT_EQ(set_.wait(role), 0) << set_.log_of(role);
}

}  // namespace
}  // namespace yars::endtoend

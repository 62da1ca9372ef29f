// A patch map in the segment. The test acts as radar-model: it reads the command and publishes the map. The programs
// state-machine and radar-display show the map, also after a restart.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstring>
#include <mutex>
#include <optional>
#include <thread>

#include "databuffer/session/picture_pool.hpp"
#include "databuffer/session/session.hpp"
#include "lib/imageio/png.hpp"
#include "tests/databuffer/session/made_up_map.hpp"
#include "tests/endtoend/process_set.hpp"
#include "tests/lib/imageio/read_png.hpp"

namespace yars::endtoend {
namespace {

using nlohmann::json;

// Stands for radar-model and flight-model. Publishes a constant ownship and the status that the test sets, 50 times a
// second.
class PlayedModel {
 public:
  explicit PlayedModel(const std::string& session) : session_(open(session)) {
    role_ = *session_.claim(databuffer::Role::radar_model);
    lane_ = *session_.claim_ownship_lane(50);
    status_.mappable = 1;
    status_.flags = databuffer::kModelScanning;
    beat_ = std::thread([this] {
      while (!stop_) {
        beat();
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
      }
    });
  }
  ~PlayedModel() {
    stop_ = true;
    beat_.join();
  }
  PlayedModel(const PlayedModel&) = delete;
  PlayedModel& operator=(const PlayedModel&) = delete;

  template <class Change>
  void change_status(Change change) {
    const std::lock_guard guard(mutex_);
    change(status_);
  }
  // Publishes a white map as the result of the request.
  void complete(std::uint64_t id, std::uint32_t request) {
    const databuffer::PatchMap map = databuffer::testing::made_up_map(id, 480);
    const std::vector<std::uint8_t> white(480 * 480, 255);
    ASSERT_TRUE(databuffer::publish_patch(session_.layout(), map, white, {}));
    change_status([&](databuffer::ModelStatus& status) {
      status.map_newest = id;
      status.map_request = status.map_done_request = request;
    });
  }
  databuffer::RadarState state() {
    databuffer::RadarState state{};
    session_.layout().radar_state.read(state);
    return state;
  }

 private:
  static databuffer::Session open(const std::string& name) {
    auto session = databuffer::Session::open(name, "radar-model");
    if (!session) throw std::runtime_error(session.error().message());
    return std::move(*session);
  }

  void beat() {
    const std::lock_guard guard(mutex_);
    databuffer::Ownship ownship{};
    ownship.latitude_deg = 34.2;
    ownship.longitude_deg = -120.6;
    ownship.altitude_msl_m = 4572.0;
    ownship.velocity_north_mps = 200.0;
    ownship.radar_altitude_m = std::numeric_limits<double>::quiet_NaN();
    std::strcpy(ownship.source, "test");
    session_.heartbeat();
    session_.layout().ownship[static_cast<std::size_t>(lane_.lane())].publish(ownship);
    ++status_.tick;
    status_.ownship = ownship;
    session_.layout().model_status.publish(status_);
  }

  databuffer::Session session_;
  databuffer::Claim role_, lane_;
  std::mutex mutex_;
  databuffer::ModelStatus status_{};
  std::atomic<bool> stop_{false};
  std::thread beat_;
};

// True when the newest frame of the folder is bright in more than 80 % of its pixels: the white map fills the display.
bool shows_white_map(const std::filesystem::path& folder) {
  std::optional<std::filesystem::path> newest;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".png" && (!newest || entry.path() > *newest)) newest = entry.path();
  if (!newest) return false;
  const auto image = test::read_png(*newest);
  if (!image) return false;
  std::size_t lit = 0;
  const auto channels = static_cast<std::size_t>(image->channels);
  for (std::size_t i = 1; i < image->pixels.size(); i += channels) lit += image->pixels[i] > 120 ? 1 : 0;
  return lit > image->pixels.size() / channels * 8 / 10;
}

TEST(MapPool, ACommandedMapIsShownAndShownAgainAfterARestart) {
  ProcessSet set("maps");
  const auto first_frames = set.folder() / "first";
  const auto second_frames = set.folder() / "second";
  set.start("state-machine", {"state-machine"});
  set.start("radar-display", {"radar-display", "--headless", "--frames", first_frames.string(), "--every", "0.1"});
  ASSERT_TRUE(eventually([&] { return set.segment_exists(); }, 20.0));
  PlayedModel model(set.session());
  ASSERT_EQ(set.yars({"inject", "power opr"}).code, 0);
  ASSERT_TRUE(set.wait_until([](const json& state) { return state["cursor"].is_object(); }));

  // The cursor is straight ahead at half of the range, in the blind zone.
  EXPECT_TRUE(eventually(
      [&] {
        EXPECT_EQ(set.yars({"inject", "tdc release"}).code, 1);
        return set.watch()["message"] == "BLIND ZONE";
      },
      20.0));
  EXPECT_EQ(model.state().map_request, 0U);

  // Move the cursor to the right until its bearing has changed by more than 12 deg.
  const double ahead_deg = set.watch()["cursor"]["bearing_deg"];
  ASSERT_EQ(set.yars({"inject", "tdc 1 0"}).code, 0);
  EXPECT_TRUE(set.wait_until([ahead_deg](const json& state) {
    return std::remainder(state["cursor"]["bearing_deg"].get<double>() - ahead_deg, 360.0) > 12.0;
  }));
  ASSERT_EQ(set.yars({"inject", "tdc 0 0"}).code, 0);
  EXPECT_TRUE(eventually(
      [&] {
        set.yars({"inject", "tdc release"});
        return (model.state().flags & databuffer::kMapping) != 0;
      },
      20.0));
  model.complete(1, model.state().map_request);
  EXPECT_TRUE(set.wait_until([](const json& state) { return state["mode"] == "PATCH"; }));
  EXPECT_TRUE(eventually([&] { return shows_white_map(first_frames); }, 20.0)) << set.log_of("radar-display");

  set.yars({"inject", "freeze"});
  set.kill("state-machine", SIGKILL);
  set.kill("radar-display", SIGKILL);
  set.wait("state-machine");
  set.wait("radar-display");
  set.start("state-machine", {"state-machine"});
  set.start("radar-display", {"radar-display", "--headless", "--frames", second_frames.string(), "--every", "0.1"});
  EXPECT_TRUE(
      eventually([&] { return std::filesystem::exists(second_frames) && shows_white_map(second_frames); }, 20.0))
      << set.log_of("radar-display");
  const json state = set.watch();
  EXPECT_EQ(state["mode"], "PATCH");
  EXPECT_EQ(state["recall"], "NEW");
}

}  // namespace
}  // namespace yars::endtoend

// What both clients in C do alike, as functions of yars.h and of libyars-client, called from this process beside a
// session of C++. The sources of the library are in this program, so that sanitizers see them.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <vector>

#include "databuffer/client/yars.h"
#include "databuffer/client/yars_client.h"
#include "databuffer/session/picture_pool.hpp"
#include "databuffer/session/session.hpp"
#include "tests/databuffer/session/session_name.hpp"
#include "tests/shm/child_process.hpp"

namespace yars::databuffer {
namespace {

class HeaderFace {
 public:
  static constexpr bool kIsLibrary = false;
  ~HeaderFace() { detach(); }
  int attach(const std::string& name) { return yars_attach(&s_, name.c_str(), "tester"); }
  void detach() { yars_detach(&s_); }
  std::string error() const { return s_.error; }
  int set_runs() { return yars_set_runs(&s_); }
  int claim_ownship() { return yars_claim_ownship_lane(&s_, 50); }
  int claim_traffic() { return yars_claim_traffic(&s_); }
  int claim_input() { return yars_claim_input_lane(&s_, "tester"); }
  int publish_ownship(const yars_ownship& ownship) { return yars_publish_ownship(&s_, &ownship); }
  int publish_nav(const yars_nav& nav) { return yars_publish_nav(&s_, &nav); }
  int publish_traffic(const yars_traffic& traffic) { return yars_publish_traffic(&s_, &traffic); }
  int push(const yars_input_event& event) { return yars_push_event(&s_, &event); }
  int read_sweep() { return yars_read_sweep(&s_, &cursor_, &sweep_); }
  std::uint64_t lost() const { return cursor_.lost; }
  const yars_sweep& sweep() const { return sweep_; }
  int read_frame(std::uint64_t after) {
    pixels_.resize(YARS_MOST_FRAME_BYTES);
    return yars_read_frame(&s_, after, &frame_, pixels_.data());
  }
  const yars_glass_frame& frame() const { return frame_; }
  const unsigned char* pixels() const { return pixels_.data(); }
  int read_radar_state(yars_radar_state& state) { return yars_read_radar_state(&s_, &state); }
  int read_caption(yars_caption& caption) { return yars_read_caption(&s_, &caption); }

 private:
  yars_session s_{};
  yars_sweep_cursor cursor_{};
  yars_sweep sweep_{};
  yars_glass_frame frame_{};
  std::vector<unsigned char> pixels_;
};

class LibraryFace {
 public:
  static constexpr bool kIsLibrary = true;
  ~LibraryFace() { detach(); }
  int attach(const std::string& name) { return yars_client_attach(name.c_str(), "tester", &client_); }
  void detach() { yars_client_detach(client_); }
  std::string error() const { return yars_client_error(); }
  int set_runs() { return yars_client_set_runs(client_); }
  int claim_ownship() { return yars_client_claim_ownship(client_, 50); }
  int claim_traffic() { return yars_client_claim_traffic(client_); }
  int claim_input() { return yars_client_claim_input(client_, "tester"); }
  int publish_ownship(const yars_ownship& ownship) { return yars_client_publish_ownship(client_, &ownship); }
  int publish_nav(const yars_nav& nav) { return yars_client_publish_nav(client_, &nav); }
  int publish_traffic(const yars_traffic& traffic) { return yars_client_publish_traffic(client_, &traffic); }
  int push(const yars_input_event& event) { return yars_client_push_event(client_, &event); }
  int read_sweep() { return yars_client_read_sweep(client_, &cursor_, &sweep_); }
  std::uint64_t lost() const { return cursor_.lost; }
  const yars_sweep& sweep() const { return sweep_; }
  int read_frame(std::uint64_t after) { return yars_client_read_frame(client_, after, &frame_, &pixels_); }
  const yars_glass_frame& frame() const { return frame_; }
  const unsigned char* pixels() const { return pixels_; }
  int read_radar_state(yars_radar_state& state) { return yars_client_read_radar_state(client_, &state); }
  int read_caption(yars_caption& caption) { return yars_client_read_caption(client_, &caption); }

 private:
  yars_client* client_ = nullptr;
  yars_client_cursor cursor_{};
  yars_sweep sweep_{};
  yars_glass_frame frame_{};
  const unsigned char* pixels_ = nullptr;
};

template <class Face>
class ClientFaceTest : public testing::SessionTest {
 protected:
  // The reason why the session cannot be joined.
  std::string refusal() {
    EXPECT_LT(face_.attach(name_), 0);
    return face_.error();
  }
  void expect_refusal(const std::string& fragment) {
    const std::string found = refusal();
    EXPECT_NE(found.find(fragment), std::string::npos) << found;
  }
  void join() {
    session_.emplace(std::move(*Session::open(name_, "maker")));
    ASSERT_EQ(face_.attach(name_), 0) << face_.error();
  }
  // A file of the session's name with a participant, as `fill` writes it. Returns its descriptor.
  int made_up_file(std::size_t size) {
    const int file = open(path().c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    EXPECT_EQ(ftruncate(file, static_cast<off_t>(size)), 0);
    struct flock lock{};
    lock.l_type = F_RDLCK;
    lock.l_len = 1;
    EXPECT_EQ(fcntl(file, F_OFD_SETLK, &lock), 0);
    return file;
  }
  void publish_sweeps(std::uint32_t first, std::uint32_t sweeps, std::uint32_t samples = 5) {
    for (std::uint32_t n = first; n < first + sweeps; ++n) {
      Sweep sweep{};
      sweep.number = n;
      sweep.samples = samples;
      sweep.range_m = 1000.0 * n;
      std::fill_n(std::begin(sweep.video), std::min<std::size_t>(samples, radar::kMaxSamples),
                  static_cast<std::uint8_t>(n % 200));
      session_->layout().sweeps.publish(sweep);
    }
  }
  std::vector<std::uint32_t> read_sweeps() {
    std::vector<std::uint32_t> numbers;
    while (face_.read_sweep() == 1) numbers.push_back(face_.sweep().number);
    return numbers;
  }

  std::optional<Session> session_;
  Face face_;
};
using Faces = ::testing::Types<HeaderFace, LibraryFace>;
class FaceNames {
 public:
  template <class Face>
  static std::string GetName(int) {
    return Face::kIsLibrary ? "OfTheLibrary" : "OfTheHeader";
  }
};
TYPED_TEST_SUITE(ClientFaceTest, Faces, FaceNames);

// ---- What cannot be joined
TYPED_TEST(ClientFaceTest, AttachingWithoutASessionIsAnError) {
  const std::string found = this->refusal();
  EXPECT_NE(found.find("no such session"), std::string::npos) << found;
  EXPECT_NE(found.find("start the set with --session " + this->name_ + ","), std::string::npos) << found;
  EXPECT_TRUE(found.ends_with("(`yars --session NAME status`)")) << found;
  EXPECT_FALSE(this->file_exists()) << "a client makes no segment";
}

TYPED_TEST(ClientFaceTest, ANameIsNoPath) {
  for (const char* name : {"../../x", "", "a/b", "-x", "a\x1b[2J", "12345678901234567890123456789012345678901"}) {
    EXPECT_LT(this->face_.attach(name), 0) << name;
    EXPECT_NE(this->face_.error().find("1 to 40 letters"), std::string::npos) << this->face_.error();
    EXPECT_EQ(this->face_.error().find('\x1b'), std::string::npos);
  }
}

TYPED_TEST(ClientFaceTest, AnotherLayoutIsRefused) {
  auto session = Session::open(this->name_, "maker");
  ASSERT_TRUE(session);
  session->layout().header.hash += 1;
  this->expect_refusal("expected layout version 3");
  EXPECT_TRUE(this->file_exists());
}

TYPED_TEST(ClientFaceTest, ALeftoverIsRefusedAndStays) {
  shm::testing::ChildProcess maker([this] {
    const auto session = Session::open(this->name_, "maker");
    kill(getpid(), SIGKILL);
  });
  EXPECT_EQ(maker.wait(), -SIGKILL);
  this->expect_refusal("a leftover: its programs have died; start the set with --session " + this->name_);
  EXPECT_TRUE(this->file_exists());
}

TYPED_TEST(ClientFaceTest, AShortFileIsRefused) {
  for (const std::size_t size : {std::size_t{0}, std::size_t{100}, sizeof(SessionLayout) - 4096}) {
    const int file = this->made_up_file(size);
    EXPECT_FALSE(this->refusal().empty());
    close(file);
    unlink(this->path().c_str());
  }
}

TYPED_TEST(ClientFaceTest, AFileOfAnotherUserIsRefused) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can make such a file";
  const int file = this->made_up_file(sizeof(SessionLayout));
  ASSERT_EQ(fchown(file, 1, 1), 0);
  this->expect_refusal("expected a file of");
  EXPECT_TRUE(this->file_exists());
  close(file);
}

TYPED_TEST(ClientFaceTest, WhatIsNoFileIsRefused) {
  ASSERT_EQ(mkfifo(this->path().c_str(), 0600), 0);
  EXPECT_FALSE(this->refusal().empty());
  unlink(this->path().c_str());
  ASSERT_EQ(symlink("/dev/null", this->path().c_str()), 0);
  EXPECT_FALSE(this->refusal().empty());
  unlink(this->path().c_str());
  ASSERT_EQ(mkdir(this->path().c_str(), 0700), 0);
  EXPECT_FALSE(this->refusal().empty());
  rmdir(this->path().c_str());
}

// ---- Taking part
TYPED_TEST(ClientFaceTest, TheLastToLeaveRemovesTheSegment) {
  this->join();
  this->session_.reset();
  EXPECT_TRUE(this->file_exists());
  this->face_.detach();
  EXPECT_FALSE(this->file_exists());
}

TYPED_TEST(ClientFaceTest, ASetThatDiesIsNoticedAndLeavesAWorkingSegment) {
  shm::testing::ChildProcess set([this] {
    auto session = Session::open(this->name_, "maker");
    const auto role = session->claim(Role::state_machine);
    pause();
  });
  ASSERT_TRUE(shm::testing::wait_until([this] { return this->face_.attach(this->name_) == 0; })) << this->face_.error();
  EXPECT_TRUE(shm::testing::wait_until([this] { return this->face_.set_runs() == 1; }));
  ASSERT_EQ(this->face_.claim_ownship(), 0);
  ASSERT_EQ(this->face_.claim_input(), 0);
  set.kill_now();
  EXPECT_EQ(this->face_.set_runs(), 0);
  EXPECT_EQ(this->face_.publish_ownship({}), 0);
  EXPECT_EQ(this->face_.push({}), 0);
  EXPECT_EQ(this->face_.read_sweep(), 0);
  this->face_.detach();
  EXPECT_FALSE(this->file_exists());
}

TYPED_TEST(ClientFaceTest, ASetRunsWhileRadarModelOrStateMachineHoldsItsRole) {
  this->join();
  EXPECT_EQ(this->face_.set_runs(), 0) << "neither radar-model nor state-machine runs";
  for (const Role role : {Role::radar_model, Role::state_machine}) {
    const auto held = this->session_->claim(role);
    ASSERT_TRUE(held);
    EXPECT_EQ(this->face_.set_runs(), 1);
  }
  EXPECT_EQ(this->face_.set_runs(), 0) << "both have ended";
  this->face_.detach();
  EXPECT_EQ(this->face_.set_runs(), 0) << "without a session";
}

TYPED_TEST(ClientFaceTest, NothingIsSentWithoutAClaim) {
  this->join();
  EXPECT_LT(this->face_.publish_ownship({}), 0);
  EXPECT_LT(this->face_.publish_nav({}), 0);
  EXPECT_LT(this->face_.publish_traffic({}), 0);
  EXPECT_LT(this->face_.push({}), 0);
  EXPECT_NE(this->face_.error().find("claim"), std::string::npos) << this->face_.error();
  EXPECT_FALSE(this->session_->layout().traffic.has_value());
}

TYPED_TEST(ClientFaceTest, ASecondClaimKeepsTheFirst) {
  this->join();
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(this->face_.claim_ownship(), 0);
    EXPECT_EQ(this->face_.claim_input(), 0);
    EXPECT_EQ(this->face_.claim_traffic(), 0);
  }
  EXPECT_FALSE(this->session_->ownship_lane_is_held(1));
  EXPECT_FALSE(this->session_->input_lane_is_held(1));
}

TYPED_TEST(ClientFaceTest, WhatOthersHoldIsRefused) {
  this->join();
  std::vector<Claim> claims;
  claims.push_back(std::move(*this->session_->claim(Role::traffic)));
  for (std::size_t i = 0; i < kOwnshipLanes; ++i) claims.push_back(std::move(*this->session_->claim_ownship_lane(1)));
  for (std::size_t i = 0; i < kInputLanes; ++i) claims.push_back(std::move(*this->session_->claim_input_lane("other")));
  EXPECT_EQ(this->face_.claim_traffic(), -1);
  EXPECT_EQ(this->face_.claim_ownship(), -1);
  EXPECT_NE(this->face_.error().find("taken"), std::string::npos) << this->face_.error();
  EXPECT_EQ(this->face_.claim_input(), -1);
  claims.clear();
  EXPECT_EQ(this->face_.claim_ownship(), 0);
}

TYPED_TEST(ClientFaceTest, EventsForAFullLaneAreDroppedAndCounted) {
  this->join();
  ASSERT_EQ(this->face_.claim_input(), 0);
  for (std::size_t n = 0; n < kInputLaneDepth; ++n) ASSERT_EQ(this->face_.push({}), 0);
  EXPECT_EQ(this->face_.push({}), -1);
  EXPECT_NE(this->face_.error().find("dropped"), std::string::npos) << this->face_.error();
  auto& input = this->session_->layout().input;
  EXPECT_EQ(input.dropped(0), 1u);
  InputEvent out{};
  for (std::size_t n = 0; n < kInputLaneDepth; ++n) {
    ASSERT_TRUE(input.pop(0, out));
    EXPECT_EQ(out.number, n + 1);
  }
  EXPECT_FALSE(input.pop(0, out));
  EXPECT_EQ(this->face_.push({}), 0);
}

// ---- Reading
TYPED_TEST(ClientFaceTest, ARecordIsThereOnceItIsPublished) {
  this->join();
  yars_radar_state state{};
  EXPECT_EQ(this->face_.read_radar_state(state), 0);
  RadarState published{};
  published.range_nm = 40.0;
  this->session_->layout().radar_state.publish(published);
  EXPECT_EQ(this->face_.read_radar_state(state), 1);
  EXPECT_EQ(state.range_nm, 40.0);
}

TYPED_TEST(ClientFaceTest, ACaptionIsThereWhileItsTourRuns) {
  this->join();
  yars_caption caption{};
  Caption published{};
  published.step = 3;
  this->session_->layout().caption.publish(published);
  EXPECT_EQ(this->face_.read_caption(caption), 0);
  {
    const auto tour = this->session_->claim(Role::tour);
    ASSERT_TRUE(tour);
    EXPECT_EQ(this->face_.read_caption(caption), 1);
    EXPECT_EQ(caption.step, 3u);
  }
  EXPECT_EQ(this->face_.read_caption(caption), 0);
}

TYPED_TEST(ClientFaceTest, EachSweepIsReadOnceWithItsSamples) {
  this->join();
  EXPECT_EQ(this->face_.read_sweep(), 0) << "none yet";
  this->publish_sweeps(7, 2);
  ASSERT_EQ(this->face_.read_sweep(), 1);
  const yars_sweep& sweep = this->face_.sweep();
  EXPECT_EQ(sweep.number, 7u);
  EXPECT_EQ(sweep.range_m, 7000.0);
  EXPECT_EQ(sweep.samples, 5u);
  EXPECT_EQ(std::vector<int>(sweep.video, sweep.video + 5), std::vector<int>(5, 7));
  EXPECT_EQ(this->read_sweeps(), std::vector<std::uint32_t>{8});
  EXPECT_EQ(this->face_.read_sweep(), 0);
  EXPECT_EQ(this->face_.lost(), 0u);
}

TYPED_TEST(ClientFaceTest, ALateReaderBeginsWithTheOldestAndHasLostNone) {
  this->join();
  this->publish_sweeps(1, YARS_SWEEPS + 10);
  const auto numbers = this->read_sweeps();
  ASSERT_EQ(numbers.size(), YARS_SWEEPS - 1u);
  EXPECT_EQ(numbers.front(), 12u);
  EXPECT_EQ(numbers.back(), YARS_SWEEPS + 10u);
  EXPECT_EQ(this->face_.lost(), 0u);
}

TYPED_TEST(ClientFaceTest, SweepsOverwrittenBeforeTheyAreReadAreCounted) {
  this->join();
  EXPECT_EQ(this->face_.read_sweep(), 0) << "the cursor starts here";
  this->publish_sweeps(1, YARS_SWEEPS + 10);
  EXPECT_EQ(this->read_sweeps().size(), YARS_SWEEPS - 1u);
  EXPECT_EQ(this->face_.lost(), 11u);
}

TYPED_TEST(ClientFaceTest, ASweepWithMoreSamplesThanTheMaximumIsSkipped) {
  this->join();
  this->publish_sweeps(1, 1, YARS_MOST_SAMPLES + 1);
  this->publish_sweeps(2, 1);
  EXPECT_EQ(this->read_sweeps(), std::vector<std::uint32_t>{2});
  EXPECT_EQ(this->face_.lost(), 1u);
}

TYPED_TEST(ClientFaceTest, TheNewestFrameIsRead) {
  this->join();
  EXPECT_EQ(this->face_.read_frame(0), 0);
  GlassFrame frame{};
  frame.width = 3;
  frame.height = 5;  // 60 bytes: the last word is half full
  for (frame.id = 1; frame.id <= 4; ++frame.id)
    publish_frame(this->session_->layout(), frame, std::vector<std::uint8_t>(60, static_cast<std::uint8_t>(frame.id)));
  ASSERT_EQ(this->face_.read_frame(0), 1);
  EXPECT_EQ(this->face_.frame().id, 4u);
  EXPECT_EQ(std::accumulate(this->face_.pixels(), this->face_.pixels() + 60, 0), 240);
  EXPECT_EQ(this->face_.read_frame(4), 0);
  EXPECT_EQ(this->face_.read_frame(9), 1) << "`after` may come from a damaged slot";
}

TYPED_TEST(ClientFaceTest, AFrameLargerThanItsSlotIsNotRead) {
  this->join();
  GlassFrame frame{};
  frame.id = 1;
  frame.width = frame.height = kMaxFramePixels + 1;
  publish_frame(this->session_->layout(), frame, std::vector<std::uint8_t>(16));
  EXPECT_EQ(this->face_.read_frame(0), 0);
}

}  // namespace
}  // namespace yars::databuffer

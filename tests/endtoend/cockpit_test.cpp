// Cockpit hardware through input-monitor and state-machine. FIFOs stand for the device files of a panel and a stick.
// Each record of a device becomes an applied event. Also learning of a device map, and refused input sources.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/input.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <utility>

#include "databuffer/messages/input_event.hpp"
#include "databuffer/session/session.hpp"
#include "tests/endtoend/process_set.hpp"

namespace yars::endtoend {
namespace {

using ::testing::HasSubstr;

// An input event of Linux (linux/input.h) without its time.
struct Move {
  int type;
  int code;
  int value;
};

// The writing end of a FIFO that stands for a device.
class Hardware {
 public:
  explicit Hardware(const std::filesystem::path& path) : path_(path) { EXPECT_EQ(mkfifo(path.c_str(), 0600), 0); }
  ~Hardware() { unplug(); }
  Hardware(const Hardware&) = delete;
  Hardware& operator=(const Hardware&) = delete;

  // Opens the FIFO once a program reads it. False after 20 s without a reader.
  bool plug_in() {
    return eventually(
        [this] {
          descriptor_ = open(path_.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
          return descriptor_ >= 0;
        },
        20.0);
  }
  void unplug() {
    if (descriptor_ >= 0) close(descriptor_);
    descriptor_ = -1;
  }
  // Writes the move and the report event that ends it.
  void send(const Move& move) const {
    for (const Move& one : {move, Move{EV_SYN, SYN_REPORT, 0}}) {
      input_event record{};
      record.type = static_cast<std::uint16_t>(one.type);
      record.code = static_cast<std::uint16_t>(one.code);
      record.value = one.value;
      ASSERT_EQ(write(descriptor_, &record, sizeof record), ssize_t(sizeof record));
    }
  }

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
};

// The events that state-machine has applied, as texts.
class AppliedEvents {
 public:
  explicit AppliedEvents(const std::string& session) : session_(databuffer::Session::open_read_only(session)) {
    if (session_) cursor_ = std::as_const(*session_).layout().applied_events.next();
  }
  // Waits for the next event. Empty after 10 s without one.
  std::string next() {
    std::string text;
    databuffer::AppliedEvent applied{};
    eventually(
        [&] {
          if (std::as_const(*session_).layout().applied_events.read(cursor_, applied).delivered)
            text = databuffer::text_of(applied.event);
          return !text.empty();
        },
        10.0);
    return text;
  }

 private:
  error::Expected<databuffer::Session> session_;
  std::uint64_t cursor_ = 0;
};

class Cockpit : public ::testing::Test {
 protected:
  Cockpit() : set_("cockpit"), panel_path_(set_.folder() / "panel"), stick_path_(set_.folder() / "stick") {}

  std::string write_stick_map() const {
    const auto path = (set_.folder() / "stick.guf").string();
    std::ofstream(path) << R"(( Devices `( ( Device "two-axes" :buttons `( ( Button "BTN_TRIGGER" "tdc press" ) )
      :axes `( ( Axis "ABS_X" tdcX 0 255 128 0.0 ) ( Axis "ABS_Y" tdcY 0 255 128 0.0 :inverted true ) ) ) ) ))";
    return path;
  }
  void start_set() {
    set_.start("state-machine", {"state-machine"});
    set_.start("input-monitor", {"input-monitor", "--config", write_stick_map(), "--source",
                                 "evdev:" + panel_path_.string() + ",mfd-cougar", "--source",
                                 "evdev:" + stick_path_.string() + ",two-axes"});
    ASSERT_TRUE(set_.wait_until([](const auto& watch) { return watch["processes"].size() >= 2; }))
        << set_.log_of("input-monitor");
  }

  ProcessSet set_;
  std::filesystem::path panel_path_;
  std::filesystem::path stick_path_;
};

TEST_F(Cockpit, EveryButtonAndAxisOfAPanelAndAStickIsApplied) {
  Hardware panel(panel_path_);
  Hardware stick(stick_path_);
  start_set();
  AppliedEvents applied(set_.session());
  ASSERT_TRUE(panel.plug_in());
  ASSERT_TRUE(stick.plug_in());
  for (int button = 1; button <= 20; ++button) {
    // BTN_TRIGGER is 0x120, BTN_TRIGGER_HAPPY1 is 0x2c0. The panel numbers its buttons in the other direction.
    const int code = button <= 16 ? 0x120 + button - 1 : 0x2c0 + button - 17;
    panel.send({EV_KEY, code, 1});
    panel.send({EV_KEY, code, 0});
    EXPECT_EQ(applied.next(), "pb " + std::to_string(21 - button));
  }
  const std::vector<std::pair<Move, std::string>> moves{
      {{EV_ABS, ABS_X, 255}, "tdc 1 0"},       {{EV_ABS, ABS_X, 64}, "tdc -0.5 0"},
      {{EV_ABS, ABS_Y, 0}, "tdc -0.5 1"},      {{EV_KEY, BTN_TRIGGER, 1}, "tdc press"},
      {{EV_ABS, ABS_Y, 192}, "tdc -0.5 -0.5"}, {{EV_ABS, ABS_X, 128}, "tdc 0 -0.5"},
      {{EV_ABS, ABS_Y, 128}, "tdc 0 0"},       {{EV_KEY, BTN_TRIGGER, 0}, "tdc release"}};
  for (const auto& [move, event] : moves) {
    stick.send(move);
    EXPECT_EQ(applied.next(), event);
  }
  for (const auto& [role, code] : set_.end_all()) EXPECT_EQ(code, 0) << role << ": " << set_.log_of(role);
}

TEST_F(Cockpit, AnUnpluggedStickReleasesItsControlsAndWorksAgainAfterItsReturn) {
  Hardware panel(panel_path_);
  auto stick = std::make_unique<Hardware>(stick_path_);
  start_set();
  AppliedEvents applied(set_.session());
  ASSERT_TRUE(panel.plug_in());
  ASSERT_TRUE(stick->plug_in());
  stick->send({EV_ABS, ABS_X, 255});
  EXPECT_EQ(applied.next(), "tdc 1 0");
  stick->send({EV_KEY, BTN_TRIGGER, 1});
  EXPECT_EQ(applied.next(), "tdc press");
  std::filesystem::remove(stick_path_);
  stick.reset();
  EXPECT_EQ(applied.next(), "tdc release");
  EXPECT_EQ(applied.next(), "tdc 0 0");
  panel.send({EV_KEY, 0x120, 1});
  EXPECT_EQ(applied.next(), "pb 20") << "the panel still works";
  Hardware again(stick_path_);
  ASSERT_TRUE(again.plug_in());
  again.send({EV_ABS, ABS_X, 0});
  EXPECT_EQ(applied.next(), "tdc -1 0");
  set_.kill("input-monitor", SIGTERM);
  EXPECT_EQ(applied.next(), "tdc 0 0") << "input-monitor releases the TDC when it ends";
  EXPECT_EQ(set_.wait("input-monitor"), 0);
  EXPECT_THAT(set_.log_of("input-monitor"), HasSubstr("waits for it"));
}

TEST_F(Cockpit, ALearnedDeviceMapPassesTheCheckAndWorks) {
  const auto learned = (set_.folder() / "learned.guf").string();
  {
    Hardware panel(panel_path_);
    set_.start_tool("learn", {"sh", "-c", "exec \"$0\" --learn \"$1\" --out \"$2\" </dev/null",
                              std::string(YARS_BIN_DIR) + "/input-monitor", panel_path_.string(), learned});
    ASSERT_TRUE(panel.plug_in());
    for (int button = 1; button <= 20; ++button) panel.send({EV_KEY, 0x120 + (button % 16) + (button / 16) * 0x1a0, 1});
    for (const int value : {0, 300, 1000, 0, -1000, 0}) panel.send({EV_ABS, ABS_RX, value});
    for (const int value : {0, -1000, 0, 1000, 0}) panel.send({EV_ABS, ABS_RY, value});
  }
  EXPECT_EQ(set_.wait("learn"), 1) << "the device was unplugged before the last control";
  EXPECT_THAT(set_.log_of("learn"), HasSubstr("24 controls"));
  const auto check = run_program({"yars", "config", "check", learned});
  EXPECT_EQ(check.code, 0) << check.output << check.errors;
  EXPECT_THAT(check.output, HasSubstr("0 warnings"));

  std::filesystem::remove(panel_path_);
  Hardware panel(panel_path_);
  set_.start("state-machine", {"state-machine"});
  set_.start("input-monitor",
             {"input-monitor", "--config", learned, "--source", "evdev:" + panel_path_.string() + ",learned"});
  ASSERT_TRUE(set_.wait_until([](const auto& watch) { return watch["processes"].size() >= 2; }));
  AppliedEvents applied(set_.session());
  ASSERT_TRUE(panel.plug_in());
  panel.send({EV_KEY, 0x120 + 5, 1});
  EXPECT_EQ(applied.next(), "pb 5");
  panel.send({EV_ABS, ABS_RY, -1000});
  EXPECT_EQ(applied.next(), "tdc 0 1");
}

TEST(CockpitUsage, AnUnusableSourceIsRefusedInOneLine) {
  const auto refused = [](const std::vector<std::string>& command, int code) {
    const auto finished = run_program(command);
    EXPECT_EQ(finished.code, code) << finished.errors;
    EXPECT_EQ(std::count(finished.errors.begin(), finished.errors.end(), '\n'), 1) << finished.errors;
    return finished.errors;
  };
  EXPECT_THAT(refused({"input-monitor", "--source", "evdev:"}, 2), HasSubstr("evdev:PATH"));
  EXPECT_THAT(refused({"input-monitor", "--source", "evdev:/dev/null"}, 1), HasSubstr("an input device"));
  EXPECT_THAT(refused({"input-monitor", "--out", "x.guf"}, 2), HasSubstr("--learn"));
}

}  // namespace
}  // namespace yars::endtoend

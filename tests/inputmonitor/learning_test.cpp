// Learning: the dialogue of `input-monitor --learn`, which makes a device map from the controls that the user moves.
#include "inputmonitor/learning.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/schema/slot_text.hpp"
#include "inputmonitor/device_decoder.hpp"
#include "tests/inputmonitor/device_support.hpp"

namespace yars::inputmonitor {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

// A dialogue with a clock: events are 20 ms apart.
class Dialogue {
 public:
  explicit Dialogue(const DeviceInfo& info = {}, const Learning::RestValues& rest = {}, Typing typing = Typing::keys)
      : learning(info, rest, typing) {
    shown = learning.begin(now_ns);
  }
  // The request that is shown now.
  std::string request() const {
    const std::size_t end = shown.find_last_of('\n');
    const std::size_t begin = shown.find_last_of('\n', end - 1);
    return shown.substr(begin + 1, end - begin - 1);
  }
  std::string feed(const RawEvent& raw) {
    now_ns += 20 * kMillisecond_ns;
    return said(learning.feed(raw, now_ns));
  }
  std::string press(int code) {
    const std::string text = feed(key(static_cast<std::uint16_t>(code), 1));
    return text + feed(kReport) + feed(key(static_cast<std::uint16_t>(code), 0)) + feed(kReport);
  }
  std::string move(std::uint16_t code, const std::vector<int>& values) {
    std::string text;
    for (const int value : values) text += feed(axis(code, value));
    return text;
  }
  std::string type(std::string_view keys) { return said(learning.type(keys, now_ns)); }
  std::string wait(double time_s) {
    now_ns += std::llround(time_s * 1e9);
    return said(learning.wait(now_ns));
  }
  void skip_to(const std::string& name) {
    while (!learning.finished() && request().find(' ' + name) == std::string::npos) type("s");
  }
  // The map, printed as `input-monitor --learn` writes it and read as `--config` reads it.
  std::string text() const { return config::print_devices({learning.device("learned")}); }
  radar::Device read_back() const { return maps_of(text()).at(0); }
  // The events of the learned map for these raw events.
  std::vector<std::string> events(const std::vector<RawEvent>& raw) const {
    DeviceDecoder decoder(*resolve_map(read_back(), {}));
    std::vector<std::string> found;
    std::int64_t time_ns = 0;
    for (const RawEvent& one : raw) {
      decoder.feed(one, time_ns += 50 * kMillisecond_ns);
      for (const std::string& event : texts_of(decoder.take(time_ns))) found.push_back(event);
    }
    return found;
  }

  Learning learning;
  std::string shown;
  std::int64_t now_ns = 0;

 private:
  std::string said(const std::string& text) {
    shown += text;
    return text;
  }
};

DeviceInfo with_axes(const std::vector<std::uint16_t>& codes, AxisRange range) {
  DeviceInfo info;
  for (const std::uint16_t code : codes) info.axes[code] = range;
  return info;
}

TEST(Learning, TwentyButtonsAreRequestedInTurn) {
  Dialogue dialogue;
  for (int button = 1; button <= 20; ++button) {
    EXPECT_THAT(dialogue.request(), HasSubstr(" button " + std::to_string(button) + " of the display ("));
    EXPECT_THAT(dialogue.press(0x130 + button), HasSubstr("got it: a button"));
  }
  EXPECT_THAT(dialogue.request(), HasSubstr("TDC right: push it to the end and let go"));
  EXPECT_THAT(dialogue.events({key(0x131, 1), key(0x144, 1)}), ElementsAre("pb 1", "pb 20"));
}

// No request, answer or hint has a code of the kernel or a control character.
TEST(Learning, TheTextsHaveNoCodes) {
  Dialogue dialogue(with_axes({ABS_X, ABS_Y}, {0, 255}), {{ABS_X, 128}, {ABS_Y, 128}});
  dialogue.press(0x120);
  dialogue.press(0x120);
  dialogue.move(ABS_HAT0X, {1, 0});
  dialogue.type("?");
  dialogue.skip_to("TDC right");
  dialogue.move(ABS_X, {180, 128, 255, 128, 255, 128});
  dialogue.wait(30);
  while (!dialogue.learning.finished()) dialogue.type("s");
  EXPECT_THAT(dialogue.shown, AllOf(Not(HasSubstr("ABS_")), Not(HasSubstr("BTN_")), Not(HasSubstr("evdev"))));
  for (const char character : dialogue.shown) EXPECT_TRUE(character == '\n' || (character >= ' ' && character <= '~'));
}

TEST(Learning, SkipNextPartBackAndEnd) {
  Dialogue dialogue;
  EXPECT_THAT(dialogue.type("b"), HasSubstr("first"));
  dialogue.type("s");
  dialogue.press(0x131);
  EXPECT_THAT(dialogue.type("b"), AllOf(HasSubstr("forgotten"), HasSubstr("button 2 ")));
  dialogue.press(0x132);
  EXPECT_EQ(dialogue.learning.learned(), 1U);
  EXPECT_THAT(dialogue.type("n"), HasSubstr("TDC right"));
  EXPECT_THAT(dialogue.type("n"), HasSubstr("castle switch up"));
  EXPECT_THAT(dialogue.type("\x1b[B\r "), IsEmpty()) << "an arrow key, Enter and a blank";
  EXPECT_THAT(dialogue.type("x"), HasSubstr("? shows"));
  EXPECT_FALSE(dialogue.learning.finished());
  dialogue.type("q");
  EXPECT_TRUE(dialogue.learning.finished());
  EXPECT_THAT(dialogue.feed(key(0x133, 1)), IsEmpty());
  EXPECT_THAT(dialogue.read_back().buttons, ::testing::SizeIs(1));
}

TEST(Learning, AWordOnALineIsOneKey) {
  Dialogue dialogue({}, {}, Typing::lines);
  EXPECT_THAT(dialogue.type("skip\ns\nback\n"), HasSubstr("left out"));
  EXPECT_THAT(dialogue.request(), HasSubstr("button 2 "));
}

// A map has what was found, and of that only what is not the default.
TEST(Learning, TheMapHasNoEmptySlots) {
  Dialogue dialogue;
  dialogue.type("s");
  dialogue.press(0x121);
  EXPECT_EQ(dialogue.text(),
            "( Devices\n  :devices `(\n    ( Device\n      :name \"learned\"\n      :buttons `(\n"
            "        ( Button :code \"button 2\" :press \"pb 2\" )\n      )\n    )\n  )\n)\n");
  dialogue.skip_to("castle switch");
  dialogue.move(ABS_HAT0Y, {-1, 0});
  EXPECT_THAT(dialogue.text(),
              HasSubstr("( Axis :code \"ABS_HAT0Y\" :drives directions :low -1 :high 1 :negative \"coolie up\" )"));
}

TEST(Learning, AControlIsLearnedOnce) {
  Dialogue dialogue;
  dialogue.press(0x121);
  EXPECT_THAT(dialogue.press(0x121), HasSubstr("that is button 1 of the display already"));
  EXPECT_THAT(dialogue.request(), HasSubstr("already")) << "the request still stands above";
  dialogue.press(0x122);
  EXPECT_EQ(dialogue.learning.learned(), 2U);
}

// Each end of a stick that has become the TDC is taken, also one that was skipped.
TEST(Learning, AStickIsNoButtonAsWell) {
  Dialogue dialogue(with_axes({ABS_X}, {0, 255}), {{ABS_X, 128}});
  dialogue.skip_to("TDC right");
  dialogue.move(ABS_X, {255, 128});
  dialogue.skip_to("castle switch");
  EXPECT_THAT(dialogue.move(ABS_X, {0, 128}), HasSubstr("that is TDC right already"));
}

TEST(Learning, EndsCentreAndDirectionOfAStickAreLearned) {
  Dialogue dialogue(with_axes({ABS_X, ABS_Y}, {0, 255}), {{ABS_X, 130}, {ABS_Y, 128}});
  dialogue.skip_to("TDC right");
  EXPECT_THAT(dialogue.move(ABS_X, {60, 5, 130}), HasSubstr("got it: one way of a stick"));
  EXPECT_THAT(dialogue.move(ABS_X, {5, 130}), HasSubstr("that is the way of TDC right; push it the other way"));
  EXPECT_THAT(dialogue.move(ABS_Y, {5, 128}), HasSubstr("not the stick or hat of TDC right"));
  EXPECT_THAT(dialogue.press(0x121), HasSubstr("TDC right is a stick or hat"));
  EXPECT_THAT(dialogue.move(ABS_X, {250, 130}), HasSubstr("got it"));
  const auto device = dialogue.read_back();
  ASSERT_EQ(device.axes.size(), 1U);
  const auto& axis_of_x = device.axes[0];
  EXPECT_EQ(axis_of_x.use, radar::AxisUse::tdc_x);
  EXPECT_EQ(std::tuple(axis_of_x.low, axis_of_x.high, axis_of_x.centre, axis_of_x.inverted),
            std::tuple(5.0, 250.0, 130.0, true));
  EXPECT_THAT(dialogue.events({axis(ABS_X, 5), axis(ABS_X, 130), axis(ABS_X, 250)}),
              ElementsAre("tdc 1 0", "tdc 0 0", "tdc -1 0"));
}

TEST(Learning, OneDirectionIsMirroredToTheOther) {
  Dialogue dialogue(with_axes({ABS_Y}, {-100, 100}), {{ABS_Y, 0}});
  dialogue.skip_to("TDC down");
  dialogue.move(ABS_Y, {90, 0});
  const auto found = dialogue.read_back().axes.at(0);
  EXPECT_EQ(std::tuple(found.low, found.high, found.centre, found.inverted), std::tuple(-90.0, 90.0, 0.0, true));
}

// The stick comes back to 6 of 100.
TEST(Learning, TheDeadZoneIsTwiceTheErrorOfTheRestPosition) {
  Dialogue dialogue(with_axes({ABS_X}, {-100, 100}), {{ABS_X, 0}});
  dialogue.skip_to("TDC right");
  dialogue.move(ABS_X, {100, 22, 6});
  EXPECT_DOUBLE_EQ(dialogue.read_back().axes.at(0).dead_zone, 0.12);
}

TEST(Learning, TheTdcMayBeAHat) {
  Dialogue dialogue;
  dialogue.skip_to("TDC right");
  dialogue.move(ABS_HAT0X, {1, 0, -1, 0});
  dialogue.move(ABS_HAT0Y, {-1, 0, 1, 0});
  EXPECT_THAT(dialogue.request(), HasSubstr("TDC switch"));
  EXPECT_THAT(dialogue.events({axis(ABS_HAT0X, 1), axis(ABS_HAT0X, 0), axis(ABS_HAT0Y, -1)}),
              ElementsAre("tdc 1 0", "tdc 0 0", "tdc 0 1"));
}

TEST(Learning, TheTdcMayBeFourButtons) {
  Dialogue dialogue;
  dialogue.skip_to("TDC right");
  dialogue.press(BTN_DPAD_RIGHT);
  EXPECT_THAT(dialogue.move(ABS_X, {0, 100, 0}), HasSubstr("TDC right is a button; use a button here, too"));
  for (const int code : {BTN_DPAD_LEFT, BTN_DPAD_UP, BTN_DPAD_DOWN}) dialogue.press(code);
  EXPECT_THAT(dialogue.request(), HasSubstr("TDC switch"));
  EXPECT_THAT(dialogue.events({key(BTN_DPAD_RIGHT, 1), key(BTN_DPAD_RIGHT, 0), key(BTN_DPAD_DOWN, 1)}),
              ElementsAre("tdc 1 0", "tdc 0 0", "tdc 0 -1"));
}

TEST(Learning, AHatIsCastleSwitchAndAcquisitionSwitch) {
  Dialogue dialogue;
  dialogue.skip_to("castle switch");
  dialogue.move(ABS_HAT0X, {1, 0});
  EXPECT_THAT(dialogue.move(ABS_HAT0X, {1, 0}), HasSubstr("that is castle switch up already"));
  dialogue.move(ABS_HAT0Y, {-1, 0, 1, 0});
  EXPECT_THAT(dialogue.request(), HasSubstr("freeze"));
  EXPECT_THAT(dialogue.events({axis(ABS_HAT0Y, -1), axis(ABS_HAT0Y, 0), axis(ABS_HAT0Y, 1), axis(ABS_HAT0Y, 0),
                               axis(ABS_HAT0X, 1)}),
              ElementsAre("acq fwd", "acq aft", "coolie up"));
}

// An axis has one interval of repetition. Freeze must not repeat because the antenna does.
TEST(Learning, AHatWithFreezeOnItDoesNotRepeat) {
  Dialogue dialogue;
  dialogue.skip_to("freeze");
  dialogue.move(ABS_HAT0Y, {-1, 0, 1, 0});
  EXPECT_EQ(dialogue.read_back().axes.at(0).repeat_s, 0.0);
  EXPECT_THAT(dialogue.events({axis(ABS_HAT0Y, 1)}), ElementsAre("elevation up"));
}

TEST(Learning, ASliderSetsTheAntenna) {
  Dialogue dialogue(with_axes({ABS_THROTTLE}, {0, 255}), {{ABS_THROTTLE, 100}});
  dialogue.skip_to("antenna wheel");
  EXPECT_THAT(dialogue.press(0x121), HasSubstr("that is a button and not a wheel"));
  EXPECT_THAT(dialogue.move(ABS_THROTTLE, {250, 100, 4}), IsEmpty());
  EXPECT_THAT(dialogue.wait(2), HasSubstr("got it: a wheel or slider"));
  EXPECT_THAT(dialogue.events({axis(ABS_THROTTLE, 250), axis(ABS_THROTTLE, 4)}),
              ElementsAre("elevation -15", "elevation 15"));
}

TEST(Learning, HintsAreGivenOnceARequest) {
  Dialogue dialogue(with_axes({ABS_X}, {0, 255}), {{ABS_X, 128}});
  EXPECT_THAT(dialogue.wait(19), IsEmpty());
  EXPECT_THAT(dialogue.wait(2), HasSubstr("nothing has moved for 20 s"));
  EXPECT_THAT(dialogue.wait(100), IsEmpty());
  dialogue.skip_to("TDC right");
  EXPECT_THAT(dialogue.move(ABS_X, {180, 128}), HasSubstr("only a little"));
  EXPECT_THAT(dialogue.move(ABS_X, {180, 128}), IsEmpty());
  dialogue.type("s");
  dialogue.move(ABS_X, {255});
  EXPECT_THAT(dialogue.wait(2), IsEmpty());
  EXPECT_THAT(dialogue.wait(2), HasSubstr("has not come back"));
  EXPECT_THAT(dialogue.type("r"), AllOf(HasSubstr("again"), HasSubstr("TDC left")));
  EXPECT_THAT(dialogue.move(ABS_X, {0, 255}), HasSubstr("got it")) << "r makes the present place that of rest";
}

TEST(Learning, AMoveThatBeganBeforeAButtonIsNotTheNextControl) {
  Dialogue dialogue(with_axes({ABS_X}, {0, 255}), {{ABS_X, 130}});
  EXPECT_THAT(dialogue.move(ABS_X, {250}), IsEmpty());
  EXPECT_THAT(dialogue.press(0x121), HasSubstr("got it"));
  EXPECT_THAT(dialogue.move(ABS_X, {255, 130}), IsEmpty());
  EXPECT_THAT(dialogue.request(), HasSubstr("button 2 "));
}

TEST(Learning, ADeviceThatComesBackGoesOn) {
  Dialogue dialogue(with_axes({ABS_X}, {0, 255}), {{ABS_X, 130}});
  dialogue.press(0x121);
  EXPECT_THAT(dialogue.learning.reconnect({{ABS_X, 128}}, dialogue.now_ns),
              AllOf(HasSubstr("is back"), HasSubstr("button 2 ")));
  dialogue.press(0x122);
  EXPECT_EQ(dialogue.learning.learned(), 2U);
}

TEST(Learning, TheMapHasVendorAndProductOfAKnownDevice) {
  DeviceInfo info;
  info.known = true;
  info.name = "Some Stick";
  info.vendor = 0x044f;
  info.product = 0xb351;
  Dialogue dialogue(info);
  EXPECT_THAT(dialogue.shown, HasSubstr("the controls of Some Stick"));
  dialogue.press(0x120);
  const auto device = dialogue.read_back();
  EXPECT_EQ(device.vendor, "044f");
  EXPECT_EQ(device.products, "b351");
}

TEST(Learning, ExtremeValuesAndCodesGiveAValidMap) {
  Dialogue dialogue;
  for (const int value : {2147483647, -2147483647 - 1, 0, 2147483647})
    for (int code = 0; code < 0x10000; code += 7) {
      dialogue.feed({EV_ABS, std::uint16_t(code), value});
      dialogue.feed({EV_KEY, std::uint16_t(code), 1});
      if (code % 2 == 0) dialogue.wait(1.0);
    }
  dialogue.read_back();
}

}  // namespace
}  // namespace yars::inputmonitor

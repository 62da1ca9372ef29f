// Tests of events as text: event_from_text() reads them and text_of() writes them, as
// docs/pilots_manual.md#controls spells them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "databuffer/messages/input_event.hpp"
#include "databuffer/messages/validation.hpp"

namespace yars::databuffer {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

struct EventSpelling {
  const char* text;
  EventKind kind;
  int argument;
};

// Events without an operand, or with a word or a whole number as operand.
const std::vector<EventSpelling> kEvents{
    {"tdc press", EventKind::tdc_press, 0},
    {"tdc release", EventKind::tdc_release, 0},
    {"coolie up", EventKind::castle_up, 0},
    {"acq fwd", EventKind::acquisition, 1},
    {"acq aft", EventKind::acquisition, -1},
    {"freeze", EventKind::freeze, 0},
    {"elevation up", EventKind::elevation_step, 1},
    {"elevation down", EventKind::elevation_step, -1},
    {"elevation down 3", EventKind::elevation_step, -3},
    {"mode ag", EventKind::master_mode, 0},
    {"mode aa", EventKind::master_mode, 1},
    {"mode agr", EventKind::master_mode, 2},
    {"radar rbm", EventKind::radar_mode, 0},
    {"radar hrm", EventKind::radar_mode, 1},
    {"radar bcn", EventKind::radar_mode, 3},
    {"radar pvu", EventKind::radar_mode, 4},
    {"power off", EventKind::power, 0},
    {"power stby", EventKind::power, 1},
    {"power opr", EventKind::power, 2},
    {"nav mn", EventKind::navigator, 0},
    {"nav ins", EventKind::navigator, 1},
    {"nav toggle", EventKind::navigator, -1},
    {"altimeter ok", EventKind::altimeter, 1},
    {"altimeter fail", EventKind::altimeter, 0},
    {"contrast up", EventKind::contrast, 1},
    {"contrast down", EventKind::contrast, -1},
    {"next", EventKind::next, 0},
    {"pb 1", EventKind::push_button, 1},
    {"pb 20", EventKind::push_button, 20},
};

TEST(EventText, TheInstructorsErrorsHaveANavigatorAndTwoComponents) {
  const struct {
    const char* text;
    EventKind kind;
    int navigator;
  } rows[] = {{"nav error mn 2500 -100.5", EventKind::navigator_error, 0},
              {"nav error ins 2500 -100.5", EventKind::navigator_error, 1},
              {"nav drift mn 2500 -100.5", EventKind::navigator_drift, 0},
              {"nav drift ins 2500 -100.5", EventKind::navigator_drift, 1}};
  for (const auto& row : rows) {
    // A drift is limited to 1,000 ft/s: it gets 250 in place of 2500.
    const bool drift = row.kind == EventKind::navigator_drift;
    const auto event =
        event_from_text(drift ? std::string(row.text).replace(row.navigator == 0 ? 13 : 14, 4, "250") : row.text);
    ASSERT_TRUE(event) << row.text;
    EXPECT_EQ(event->kind, static_cast<std::uint16_t>(row.kind));
    EXPECT_EQ(event->argument, row.navigator);
    EXPECT_EQ(event->x, drift ? 250.0 : 2500.0);
    EXPECT_EQ(event->y, -100.5);
    EXPECT_EQ(event_from_text(text_of(*event))->x, event->x) << text_of(*event);
  }
  for (const char* wrong : {"nav error", "nav error mn", "nav error mn 5", "nav error gps 1 1", "nav drift mn 1e9 0",
                            "nav error mn 1 nan", "nav error mn 1 2 3"})
    EXPECT_THAT(event_from_text(wrong).error().message(), HasSubstr("nav error mn N_FT E_FT")) << wrong;
}

std::string refusal_of(const std::string& text) {
  const auto event = event_from_text(text);
  return event ? "accepted" : event.error().message();
}

TEST(EventText, EachEventIsReadAndWritten) {
  for (const auto& [text, kind, argument] : kEvents) {
    const auto event = event_from_text(text);
    ASSERT_TRUE(event) << text << ": " << event.error().message();
    EXPECT_EQ(event->kind, static_cast<std::uint16_t>(kind)) << text;
    EXPECT_EQ(event->argument, argument) << text;
    EXPECT_EQ(text_of(*event), text);
  }
}

TEST(EventText, TdcDeflectionHasTwoNumbers) {
  const auto event = event_from_text("tdc 0.5 -1");
  ASSERT_TRUE(event);
  EXPECT_EQ(event->kind, static_cast<std::uint16_t>(EventKind::tdc));
  EXPECT_EQ(event->x, 0.5);
  EXPECT_EQ(event->y, -1.0);
  EXPECT_EQ(text_of(*event), "tdc 0.5 -1");
  const auto cursor = event_from_text("cursor 0.25 1");
  ASSERT_TRUE(cursor);
  EXPECT_EQ(cursor->kind, static_cast<std::uint16_t>(EventKind::cursor));
  EXPECT_EQ(text_of(*cursor), "cursor 0.25 1");
}

TEST(EventText, ElevationIsAbsoluteDegrees) {
  const auto event = event_from_text("elevation -5");
  ASSERT_TRUE(event);
  EXPECT_EQ(event->kind, static_cast<std::uint16_t>(EventKind::elevation));
  EXPECT_EQ(event->x, -5.0);
}

TEST(EventText, ASequencePointHasAName) {
  const auto event = event_from_text("sp 2.01");
  ASSERT_TRUE(event);
  EXPECT_STREQ(event->text, "2.01");
  EXPECT_EQ(text_of(*event), "sp 2.01");
}

TEST(EventText, BlanksAndCaseDoNotMatter) {
  const auto event = event_from_text("  PB\t13 ");
  ASSERT_TRUE(event);
  EXPECT_EQ(text_of(*event), "pb 13");
}

TEST(EventText, AWrongOperandShowsTheSpellingsOfItsEventOnly) {
  const std::string message = refusal_of("power maybe");
  EXPECT_THAT(message, HasSubstr("power off | power stby | power opr"));
  EXPECT_THAT(message, HasSubstr("\"power maybe\""));
  EXPECT_EQ(message.find("coolie"), std::string::npos);
}

TEST(EventText, AnUnknownEventShowsAllSpellings) {
  const std::string message = refusal_of("fire");
  for (const auto* verb : {"pb", "tdc", "coolie", "acq", "freeze", "elevation", "mode", "radar", "power", "nav", "sp",
                           "altimeter", "contrast"})
    EXPECT_THAT(message, HasSubstr(verb));
}

TEST(EventText, AMisspelledEventIsAnsweredWithTheOneThatWasMeant) {
  for (const auto& [text, meant] : {std::pair{"pb13", "pb 13"},
                                    {"pb-13", "pb 13"},
                                    {"PB_13", "pb 13"},
                                    {"elvation5", "elevation 5"},
                                    {"pb 21", "pb 20"},
                                    {"pb 0", "pb 1"},
                                    {"sp2.1", "sp 2.1"},
                                    {"power on", "power opr"},
                                    {"power standby", "power stby"},
                                    {"elevation 500", "elevation 60"},
                                    {"elevation-5", "elevation -5"},
                                    {"tdc 2 0", "tdc 1 0"},
                                    {"cursor 1.2 0.5", "cursor 1 0.5"},
                                    {"elevation up 300", "elevation up 240"}})
    EXPECT_THAT(refusal_of(text), HasSubstr("did you mean '" + std::string(meant) + "'?")) << text;
  for (const char* text : {"pb", "pb x", "sp 999", "13", "-", "freeze 1", "nav drift mn 1e9 0"})
    EXPECT_EQ(refusal_of(text).find("did you mean"), std::string::npos) << refusal_of(text);
}

TEST(EventText, WhatButtonsDoIsAnsweredWithTheButtons) {
  EXPECT_EQ(refusal_of("rage inc"),
            "event: expected an event, found \"rage inc\"; the range is on buttons of the display: 'pb 13' lengthens "
            "it, 'pb 14' shortens it in RBM");
  EXPECT_THAT(refusal_of("gain up"), HasSubstr("'pb 3' steps it"));
  EXPECT_THAT(refusal_of("rain"), Not(HasSubstr("gain is on buttons")));
}

TEST(EventText, MalformedEventsAndValuesOutOfRangeAreRefused) {
  for (const auto* text : {"",
                           "   ",
                           "pb",
                           "pb 0",
                           "pb 21",
                           "pb -1",
                           "pb 1.5",
                           "pb 13 14",
                           "pb 99999",
                           "tdc",
                           "tdc 1",
                           "tdc 1.01 0",
                           "cursor 1.01 0",
                           "cursor 0 -0.1",
                           "cursor 0.5",
                           "tdc nan 0",
                           "tdc 0 inf",
                           "elevation 60.1",
                           "elevation nan",
                           "elevation up 0",
                           "elevation up -1",
                           "elevation up 241",
                           "elevation sideways",
                           "freeze now",
                           "radar patch",
                           "radar aa",
                           "sp",
                           "sp 0",
                           "sp 101",
                           "sp 2.00",
                           "sp 2.100",
                           "sp two",
                           "sp 22222222222222222222",
                           "acq",
                           "contrast 3"})
    EXPECT_NE(refusal_of(text), "accepted") << text;
}

TEST(EventText, AnEventOutsideTheInterfaceHasATextThatIsRefused) {
  InputEvent event{};
  event.kind = 99;
  EXPECT_THAT(text_of(event), HasSubstr("99"));
  EXPECT_NE(refusal_of(text_of(event)), "accepted");
}

bool same_content(const InputEvent& a, const InputEvent& b) {
  return a.kind == b.kind && a.argument == b.argument && a.x == b.x && a.y == b.y &&
         std::memcmp(a.text, b.text, sizeof a.text) == 0;
}

// A random event, valid or not, with values only in the fields that its kind uses.
InputEvent random_event(std::mt19937& random) {
  InputEvent event{};
  event.kind = static_cast<std::uint16_t>(std::uniform_int_distribution(0, 17)(random));
  const auto kind = static_cast<EventKind>(event.kind);
  std::uniform_real_distribution<double> deflection(-1.0, 1.0);
  if (kind == EventKind::tdc) {
    event.x = deflection(random);
    event.y = deflection(random) * std::pow(10.0, std::uniform_int_distribution(-300, 0)(random));
  } else if (kind == EventKind::elevation) {
    event.x = 61.0 * deflection(random);
  } else if (kind == EventKind::sequence_point) {
    std::string name = std::to_string(std::uniform_int_distribution(1, 101)(random));
    const int shape = std::uniform_int_distribution(0, 3)(random);
    if (shape > 0) name += '.';
    if (shape > 1) name += std::to_string(std::uniform_int_distribution(0, 100)(random));
    set_text(event, name);
  } else if (kind != EventKind::tdc_press && kind != EventKind::tdc_release && kind != EventKind::castle_up &&
             kind != EventKind::freeze) {
    event.argument = static_cast<std::int16_t>(std::uniform_int_distribution(-3, 21)(random));
  }
  return event;
}

TEST(EventText, ValidEventsAreEqualAfterWritingAndReading) {
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  int valid = 0;
  for (int round = 0; round < 20'000; ++round) {
    const InputEvent event = random_event(random);
    const auto again = event_from_text(text_of(event));
    ASSERT_EQ(again.has_value(), !validate(event).has_value()) << text_of(event);
    if (!again) continue;
    ASSERT_TRUE(same_content(event, *again)) << text_of(event);
    ++valid;
  }
  EXPECT_GT(valid, 5'000);
}

}  // namespace
}  // namespace yars::databuffer

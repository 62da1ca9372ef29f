// Tours: syntax, errors, captions, and the wait for the pilot.
#include "inputmonitor/tour.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "databuffer/messages/input_event.hpp"
#include "databuffer/messages/validation.hpp"
#include "lib/file/text_file.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::inputmonitor {
namespace {

using ::testing::HasSubstr;

constexpr std::int64_t kSecond_ns = 1'000'000'000;

std::string refusal_of(const std::string& text) {
  const auto tour = parse_tour(text, "x.tour");
  return tour ? "accepted" : tour.error().message();
}

databuffer::InputEvent event_of(const std::string& text) {
  return databuffer::event_from_text(text).value();
}

// A tour that is played from the sim time `from_s`.
class Player {
 public:
  explicit Player(const std::string& text, bool for_pilot = false, double from_s = 100.0)
      : source_(parse_tour(text, "x.tour").value(), "x.tour", for_pilot), from_s_(from_s) {}

  // Events that are sent at this time of the tour's start.
  std::string at(double time_s) {
    std::string texts;
    for (const auto& event : source_.take({0, std::llround((from_s_ + time_s) * kSecond_ns)}))
      texts += (texts.empty() ? "" : ", ") + databuffer::text_of(event);
    return texts;
  }
  void applied(const std::string& text, bool done = true, bool own = false) {
    source_.observe({{event_of(text), done, own}});
  }
  // Number of the caption, its first line, and "?" while the tour waits.
  std::string caption() const {
    const auto* caption = source_.caption();
    if (caption == nullptr) return "none";
    EXPECT_FALSE(databuffer::validate(*caption));
    return std::to_string(caption->step) + "/" + std::to_string(caption->steps) + " " +
           std::string(text::text_of(caption->lines[0].text)) + (caption->waiting != 0 ? "?" : "");
  }
  TourSource& source() { return source_; }

 private:
  TourSource source_;
  double from_s_;
};

constexpr const char* kTwoSteps =
    "title Two steps\n"
    "0.1 auto power opr\n"
    "1 caption Range down.|Twice.\n"
    "2 pb 14\n"
    "3 pb 14\n"
    "10 caption Freeze.\n"
    "11 freeze\n"
    "20 end\n";

TEST(Tour, HasATitleCaptionsOfLinesAndEvents) {
  const auto tour = parse_tour(kTwoSteps, "x.tour");
  ASSERT_TRUE(tour) << tour.error().message();
  EXPECT_EQ(tour->title, "Two steps");
  EXPECT_EQ(tour->end_ns, 20 * kSecond_ns);
  ASSERT_EQ(tour->items.size(), 6U);
  EXPECT_TRUE(tour->items[0].automatic);
  EXPECT_TRUE(tour->items[1].is_caption);
  EXPECT_THAT(tour->items[1].lines, ::testing::ElementsAre("Range down.", "Twice."));
  EXPECT_FALSE(tour->items[2].automatic);
  EXPECT_EQ(databuffer::text_of(tour->items[2].event), "pb 14");
}

TEST(Tour, ACaptionWithoutATimeHasThatOfTheLineAbove) {
  const auto tour = parse_tour("2 freeze\ncaption Here\n+1.5 caption\nend\n", "x.tour");
  ASSERT_TRUE(tour) << tour.error().message();
  EXPECT_EQ(tour->items[1].time_ns, 2 * kSecond_ns);
  EXPECT_EQ(tour->items[2].time_ns, 3'500'000'000);
  EXPECT_TRUE(tour->items[2].lines.empty());
  EXPECT_EQ(tour->end_ns, 3'500'000'000);
}

TEST(Tour, ErrorsCarryTheLineAndWhatWasExpected) {
  EXPECT_THAT(refusal_of("1 caption a|b|c|d\n2 end\n"), HasSubstr("x.tour:1: expected at most 3 lines, found 4"));
  EXPECT_THAT(refusal_of("1 caption " + std::string(48, 'x') + "\n2 end\n"), HasSubstr("at most 47 ASCII characters"));
  EXPECT_THAT(refusal_of("1 caption caf\xc3\xa9\n2 end\n"), HasSubstr("ASCII"));
  EXPECT_THAT(refusal_of("title\n2 end\n"), HasSubstr("a title of 1 to 47"));
  EXPECT_THAT(refusal_of("1 pb 33\n2 end\n"), HasSubstr("x.tour:1: expected pb 1..20"));
  EXPECT_THAT(refusal_of("1 auto pb 33\n2 end\n"), HasSubstr("x.tour:1: expected pb 1..20"));
  EXPECT_THAT(refusal_of("1 auto freze\n2 end\n"), HasSubstr("did you mean 'freeze'?"));
  EXPECT_THAT(refusal_of("captions\n2 end\n"), HasSubstr("caption TEXT"));
  EXPECT_THAT(refusal_of("1 freeze\n"), HasSubstr("expected a last line `end`, found none"));
}

TEST(TourSource, PlaysByItselfFromItsStart) {
  Player player(kTwoSteps);
  EXPECT_EQ(player.at(0.0), "");
  EXPECT_EQ(player.caption(), "none");
  EXPECT_EQ(player.at(1.0), "power opr");
  EXPECT_EQ(player.caption(), "1/2 Range down.");
  EXPECT_EQ(player.at(3.0), "pb 14, pb 14");
  EXPECT_EQ(player.at(11.0), "freeze");
  EXPECT_EQ(player.caption(), "2/2 Freeze.");
  EXPECT_FALSE(player.source().ended());
  player.at(20.0);
  EXPECT_TRUE(player.source().ended());
  EXPECT_EQ(player.caption(), "none");
}

TEST(TourSource, WhenSimTimeGoesBackItBeginsAgain) {
  Player player(kTwoSteps);
  player.at(0.0);
  player.at(11.0);
  EXPECT_EQ(player.at(-50.0), "");
  EXPECT_EQ(player.caption(), "none");
  EXPECT_EQ(player.at(-49.0), "power opr");
  EXPECT_EQ(player.caption(), "1/2 Range down.");
}

TEST(TourSource, ForThePilotItWaitsUntilHeHasDoneTheStep) {
  Player player(kTwoSteps, true);
  player.at(0.0);
  EXPECT_EQ(player.at(1.0), "power opr") << "the tour sends what is marked auto";
  EXPECT_EQ(player.caption(), "1/2 Range down.");
  EXPECT_EQ(player.at(2.0), "");
  EXPECT_EQ(player.caption(), "1/2 Range down.?");
  EXPECT_EQ(player.at(60.0), "");
  player.applied("pb 14");
  player.applied("pb 13");
  player.at(61.0);
  EXPECT_EQ(player.caption(), "1/2 Range down.?") << "one is missing";
  player.applied("pb 14", false);
  player.at(62.0);
  EXPECT_EQ(player.caption(), "1/2 Range down.?") << "it had no effect";
  player.applied("pb 14");
  player.at(63.0);
  EXPECT_EQ(player.caption(), "1/2 Range down.");
  EXPECT_EQ(player.at(69.9), "") << "the tour's clock goes on from its time 3 s";
  EXPECT_EQ(player.caption(), "1/2 Range down.");
  player.at(70.0);
  EXPECT_EQ(player.caption(), "2/2 Freeze.");
}

TEST(TourSource, WhatThePilotDoesBeforeTheClockStopsCounts) {
  Player player(kTwoSteps, true);
  player.at(0.0);
  player.at(1.0);
  player.applied("pb 14");
  player.applied("pb 14");
  EXPECT_EQ(player.at(2.0), "");
  EXPECT_EQ(player.caption(), "1/2 Range down.");
  EXPECT_EQ(player.at(10.0), "");
  EXPECT_EQ(player.caption(), "2/2 Freeze.");
}

TEST(TourSource, NextMakesTheTourSendWhatIsMissing) {
  Player player(kTwoSteps, true);
  player.at(0.0);
  player.at(1.0);
  player.at(2.0);
  player.applied("pb 14");
  player.applied("next");
  EXPECT_EQ(player.at(30.0), "pb 14") << "of two, one is missing";
  EXPECT_EQ(player.at(31.0), "");
  EXPECT_EQ(player.caption(), "1/2 Range down.");
  player.applied("next");
  player.at(31.5);
  EXPECT_EQ(player.caption(), "2/2 Freeze.") << "nothing was left to do before the next caption";
}

TEST(TourSource, ItsOwnEventsAreNotThePilots) {
  Player player("1 caption One.\n1.5 auto pb 14\n3 pb 14\n9 end\n", true);
  player.at(0.0);
  EXPECT_EQ(player.at(2.0), "pb 14");
  player.applied("pb 14", true, true);  // the echo: terminal and tour may share a lane
  player.at(3.0);
  EXPECT_EQ(player.caption(), "1/1 One.?");
  player.applied("pb 14", true, true);
  player.at(4.0);
  EXPECT_EQ(player.caption(), "1/1 One.");
}

TEST(TourSource, AnyDeflectionAndAnyElevationWillDo) {
  Player player("1 caption One.\n2 tdc 0.5 0.1\n2.5 tdc 0 0\n3 elevation -5\n9 end\n", true);
  player.at(0.0);
  player.at(2.0);
  player.applied("tdc -1 0");
  player.applied("tdc -1 1");
  player.applied("elevation up");
  player.at(3.0);
  EXPECT_EQ(player.caption(), "1/1 One.?") << "the TDC is still deflected";
  player.applied("tdc 0 0");
  player.at(4.0);
  EXPECT_EQ(player.caption(), "1/1 One.");
}

TEST(TourSource, ADeflectionThatItLeavesIsReleasedAtTheEnd) {
  Player player("1 tdc 0.5 0\n5 end\n");
  player.at(0.0);
  player.at(1.0);
  const auto left = player.source().release();
  ASSERT_EQ(left.size(), 1U);
  EXPECT_EQ(databuffer::text_of(left[0]), "tdc 0 0");
  EXPECT_TRUE(player.source().release().empty());
}

// scripts/start takes the length of a tour from its last line.
TEST(Tour, EachShippedTourIsValidAndEndsWithATime) {
  int tours = 0;
  for (const auto& file : std::filesystem::directory_iterator(YARS_SOURCE_DIR "/config/tours")) {
    if (file.path().extension() != ".tour") continue;
    ++tours;
    const auto text = file::read_text_file(file.path());
    ASSERT_TRUE(text) << text.error().message();
    const auto tour = parse_tour(*text, file.path().filename().string());
    ASSERT_TRUE(tour) << tour.error().message();
    EXPECT_FALSE(tour->title.empty()) << file.path();
    const auto last = text::words_of(text::numbered_lines(*text).back().text);
    ASSERT_EQ(last.size(), 2U) << file.path();
    EXPECT_EQ(text::finite_number(last[0]).value_or(-1.0) * kSecond_ns, static_cast<double>(tour->end_ns));
  }
  EXPECT_GE(tours, 2);
}

}  // namespace
}  // namespace yars::inputmonitor

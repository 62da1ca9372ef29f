// Messages of a page: events and keys of the pilot; anything else is refused and changes nothing.
#include "station/page_message.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "databuffer/messages/input_event.hpp"

namespace yars::station {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<std::string> texts_of(const std::vector<databuffer::InputEvent>& events) {
  std::vector<std::string> texts;
  for (const databuffer::InputEvent& event : events) texts.push_back(databuffer::text_of(event));
  return texts;
}
std::vector<std::string> sent(PagePilot& pilot, std::string_view message) {
  const auto events = pilot.events_of(message);
  return events ? texts_of(*events) : std::vector<std::string>{events.error().message()};
}

TEST(PageMessage, EventsHaveTheTextFormOfInject) {
  PagePilot pilot;
  EXPECT_THAT(sent(pilot, R"({"event": "pb 13"})"), ElementsAre("pb 13"));
  EXPECT_THAT(sent(pilot, R"({"event": "cursor 0.25 0.5"})"), ElementsAre("cursor 0.25 0.5"));
}

TEST(PageMessage, KeysActAsThoseOfTheWindow) {
  PagePilot pilot;
  EXPECT_THAT(sent(pilot, R"({"key": "d", "down": true})"), ElementsAre("pb 13"));
  EXPECT_THAT(sent(pilot, R"({"key": "d", "down": true})"), IsEmpty()) << "auto-repeat";
  EXPECT_THAT(sent(pilot, R"({"key": "D", "down": false})"), IsEmpty());
  EXPECT_THAT(sent(pilot, R"({"key": " ", "down": true})"), ElementsAre("freeze"));
  EXPECT_THAT(sent(pilot, R"({"key": "PageUp", "down": true})"), ElementsAre("acq fwd"));
  EXPECT_THAT(sent(pilot, R"({"key": "Dead", "down": true})"), IsEmpty());
}

TEST(PageMessage, APageThatGoesReleasesTheCursor) {
  PagePilot pilot;
  EXPECT_THAT(sent(pilot, R"({"key": "ArrowRight", "down": true})"), ElementsAre("tdc 1 0"));
  EXPECT_THAT(sent(pilot, R"({"release": true})"), ElementsAre("tdc 0 0"));
  EXPECT_THAT(sent(pilot, R"({"event": "tdc 0.5 0"})"), ElementsAre("tdc 0.5 0"));
  EXPECT_THAT(texts_of(pilot.release_all()), ElementsAre("tdc 0 0"));
  EXPECT_THAT(pilot.release_all(), IsEmpty());
}

TEST(PageMessage, OthersAreRefused) {
  PagePilot pilot;
  for (const char* message : {"", "{", "[]", "null", "12", "{}", R"({"event": 5})", R"({"event": "pb 99"})",
                              R"({"key": "a"})", R"({"key": 1, "down": true})", R"({"key": "a", "down": 1})", "\xff"}) {
    EXPECT_FALSE(pilot.events_of(message).has_value()) << message;
  }
  EXPECT_FALSE(
      pilot.events_of("{\"event\": \"pb 2\", \"x\": \"" + std::string(kMaxMessageBytes, 'x') + "\"}").has_value());
  EXPECT_FALSE(pilot.events_of(std::string(1000, '[')).has_value());
  EXPECT_THAT(sent(pilot, "{}").front(), HasSubstr("expected {\"event\": TEXT}"));
}

}  // namespace
}  // namespace yars::station

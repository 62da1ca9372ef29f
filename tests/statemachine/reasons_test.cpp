// Reasons of events that were sent together, and the press of the TDC.
// Source: docs/commands.md#inject.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "statemachine/advice.hpp"
#include "tests/statemachine/pilot.hpp"

namespace yars::statemachine::testing {
namespace {

// One line for each event that is not done: "sp 99: NO POINT 99". "?": the reason is not certain.
std::string reasons_of(Pilot& pilot, const std::vector<std::string>& texts) {
  const databuffer::RadarState before = pilot.state;
  std::vector<databuffer::InputEvent> events;
  std::vector<std::uint32_t> effects;
  for (const std::string& text : texts) {
    events.push_back(*databuffer::event_from_text(text));
    effects.push_back(static_cast<std::uint32_t>(apply(pilot.state, events.back(), pilot.around, pilot.configuration)));
  }
  std::string lines;
  for (std::size_t i = 0; i < events.size(); ++i) {
    if (effects[i] == databuffer::kEventDone) continue;
    const auto reason = certain_reason({events, effects, before, pilot.state, pilot.around.recorder_present}, i);
    lines += (lines.empty() ? "" : "; ") + texts[i] + ": " + (reason ? reason->words : "?");
  }
  return lines;
}

struct Case {
  std::vector<std::string> before, events;
  const char* reasons;
};

TEST(Reasons, EveryEventHasItsOwnReasonOrNone) {
  const Case cases[] = {
      {{}, {"sp 99", "pb 12"}, "sp 99: NO POINT 99; pb 12: NO RECORDER"},
      {{}, {"pb 12", "sp 99"}, "pb 12: NO RECORDER; sp 99: NO POINT 99"},
      {{}, {"sp 98", "sp 99"}, "sp 98: NO POINT 98; sp 99: NO POINT 99"},
      // The cursor beyond the gimbal's limit: a map is refused.
      {{"sp 9"}, {"tdc release", "contrast up"}, "tdc release: GIMBAL"},
      {{"sp 9"}, {"pb 12", "tdc release"}, "pb 12: NO RECORDER; tdc release: GIMBAL"},
      {{"sp 9"}, {"tdc release", "pb 12"}, "tdc release: ?; pb 12: NO RECORDER"},
      // PB 7 four times: MARK, whose message replaces that of the map.
      {{"sp 9"}, {"tdc release", "pb 7", "pb 7", "pb 7", "pb 7", "tdc release"}, "tdc release: ?"},
      {{}, {"freeze", "pb 6"}, "pb 6: dead while frozen"},
      {{"freeze"}, {"pb 6", "freeze"}, "pb 6: dead while frozen"},
      {{}, {"freeze", "pb 6", "freeze"}, "pb 6: ?"},
      {{}, {"sp 99", "pb 8", "freeze"}, "sp 99: NO POINT 99; pb 8: dead in RBM"},
  };
  for (const Case& one : cases) {
    Pilot pilot;
    pilot.configuration.route.push_back(route_point("9", radar::PointKind::steer, position(100.0, 10.0)));
    pilot.press("power opr");
    for (const std::string& event : one.before) pilot.press(event);
    EXPECT_EQ(reasons_of(pilot, one.events), one.reasons) << one.events.front();
  }
}

TEST(Reasons, APressOfTheTdcIsDoneWhereItsReleaseActsAndElseHasItsReason) {
  const Case cases[] = {{{}, {"sp 1.1", "tdc press", "tdc release"}, ""},
                        {{}, {"tdc press"}, ""},
                        {{"pb 18"}, {"tdc press"}, "tdc press: dead while SNIFF is on"},
                        {{"power stby"}, {"tdc press"}, "tdc press: dead in STBY"},
                        {{"power off"}, {"tdc press"}, "tdc press: dead while the power is OFF"},
                        {{"radar bcn"}, {"tdc press"}, "tdc press: dead in BCN with this cursor function"}};
  for (const Case& one : cases) {
    Pilot pilot;
    pilot.press("power opr");
    for (const std::string& event : one.before) pilot.press(event);
    EXPECT_EQ(reasons_of(pilot, one.events), one.reasons);
  }
}

}  // namespace
}  // namespace yars::statemachine::testing

// Scripts of input events: syntax, errors, and the sim time at which each event is sent.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "databuffer/messages/input_event.hpp"
#include "inputmonitor/event_source.hpp"
#include "lib/file/text_file.hpp"

namespace yars::inputmonitor {
namespace {

using ::testing::HasSubstr;

constexpr std::int64_t kTick_ns = 5'000'000;
constexpr std::int64_t kSecond_ns = 1'000'000'000;

std::string refusal_of(const std::string& text) {
  const auto script = parse_script(text, "x.script");
  return script ? "accepted" : script.error().message();
}

ScriptSource source_of(const std::string& text) {
  return {parse_script(text, "x.script").value(), "x.script"};
}

std::string taken(ScriptSource& source, std::int64_t sim_time_ns) {
  std::string texts;
  for (const auto& event : source.take({0, sim_time_ns}))
    texts += (texts.empty() ? "" : ", ") + databuffer::text_of(event);
  return texts;
}

TEST(Script, TimesAreAbsoluteOrRelativeToTheLineAbove) {
  const auto script = parse_script("# power\n0.5 power opr\n+1.25 pb 13  # range\n\n3 tdc 0.5 0\n+0 tdc press\n", "x");
  ASSERT_TRUE(script) << script.error().message();
  ASSERT_EQ(script->events.size(), 4U);
  EXPECT_EQ(script->events[0].time_ns, 500'000'000);
  EXPECT_EQ(script->events[1].time_ns, 1'750'000'000);
  EXPECT_EQ(script->events[2].time_ns, 3'000'000'000);
  EXPECT_EQ(script->events[3].time_ns, 3'000'000'000);
  EXPECT_EQ(databuffer::text_of(script->events[1].event), "pb 13");
  EXPECT_EQ(script->end_ns, std::nullopt);
}

TEST(Script, EndMayHaveATime) {
  EXPECT_EQ(parse_script("2 freeze\nend\n", "x")->end_ns, 2 * kSecond_ns);
  EXPECT_EQ(parse_script("2 freeze\n+3 end\n", "x")->end_ns, 5 * kSecond_ns);
  EXPECT_EQ(parse_script("7 end", "x")->end_ns, 7 * kSecond_ns);
}

TEST(Script, ErrorsCarryTheLineAndWhatWasExpected) {
  EXPECT_THAT(refusal_of("0 power opr\n1 pb 33\n"), HasSubstr("x.script:2: expected pb 1..20, found \"pb 33\""));
  EXPECT_THAT(refusal_of("2 freeze\n1 freeze\n"), HasSubstr("x.script:2: expected a time not earlier than"));
  EXPECT_THAT(refusal_of("freeze\n"), HasSubstr("x.script:1: expected TIME_S EVENT"));
  EXPECT_THAT(refusal_of("-1 freeze\n"), HasSubstr("TIME_S EVENT"));
  EXPECT_THAT(refusal_of("+-1 freeze\n"), HasSubstr("TIME_S EVENT"));
  EXPECT_THAT(refusal_of("nan freeze\n"), HasSubstr("TIME_S EVENT"));
  EXPECT_THAT(refusal_of("1e300 freeze\n"), HasSubstr("TIME_S EVENT"));
  EXPECT_THAT(refusal_of("1\n"), HasSubstr("x.script:1"));
  EXPECT_THAT(refusal_of("1 end\n2 freeze\n"), HasSubstr("x.script:2: expected no line after end"));
}

TEST(Script, AnEmptyScriptHasNoEvents) {
  const auto script = parse_script("", "x");
  ASSERT_TRUE(script);
  EXPECT_TRUE(script->events.empty());
}

TEST(ScriptSource, AnEventIsDueAtTheFirstTickAtOrAfterItsTime) {
  auto source = source_of("0.010 pb 2\n0.011 pb 3\n0.015 pb 4\n");
  EXPECT_EQ(taken(source, kTick_ns), "");
  EXPECT_EQ(taken(source, 2 * kTick_ns), "pb 2");
  EXPECT_EQ(taken(source, 3 * kTick_ns), "pb 3, pb 4");
  EXPECT_EQ(taken(source, 4 * kTick_ns), "");
}

TEST(ScriptSource, OverdueEventsAreSentAtOnceAndInOrder) {
  auto source = source_of("0 power opr\n1 pb 2\n9 pb 3\n");
  EXPECT_EQ(taken(source, 5 * kSecond_ns), "power opr, pb 2");
  EXPECT_EQ(taken(source, 9 * kSecond_ns), "pb 3");
}

TEST(ScriptSource, EndsAtTheTimeOfItsEndLine) {
  auto source = source_of("1 pb 2\n+1 end\n");
  taken(source, kSecond_ns);
  EXPECT_FALSE(source.ended());
  taken(source, 2 * kSecond_ns);
  EXPECT_TRUE(source.ended());
  auto without_end = source_of("1 pb 2\n");
  taken(without_end, 100 * kSecond_ns);
  EXPECT_FALSE(without_end.ended());
}

TEST(ScriptSource, WhenSimTimeGoesBackItPlaysAgainFromThatTime) {
  auto source = source_of("0 pb 2\n1 pb 3\n2 pb 4\n");
  EXPECT_EQ(taken(source, 2 * kSecond_ns), "pb 2, pb 3, pb 4");
  EXPECT_EQ(taken(source, kSecond_ns / 2), "");
  EXPECT_EQ(taken(source, kSecond_ns), "pb 3");
  EXPECT_EQ(taken(source, 0), "pb 2");
}

TEST(ScriptSource, TimesOfAScriptThatBeginsWithPlusCountFromItsFirstTick) {
  auto source = source_of("+0 pb 2\n+1 pb 3\n5 pb 4\n+1 end\n");
  EXPECT_EQ(taken(source, 100 * kSecond_ns), "pb 2");
  EXPECT_EQ(taken(source, 101 * kSecond_ns), "pb 3");
  EXPECT_EQ(taken(source, 105 * kSecond_ns), "pb 4");
  EXPECT_FALSE(source.ended());
  EXPECT_EQ(taken(source, 7 * kSecond_ns), "pb 2");
  EXPECT_EQ(taken(source, 8 * kSecond_ns), "pb 3");
  taken(source, 13 * kSecond_ns);
  EXPECT_TRUE(source.ended());
}

TEST(ScriptSource, TheShippedScriptSwitchesTheRadarOn) {
  const auto text = file::read_text_file(YARS_SOURCE_DIR "/config/scripts/power_on.script");
  ASSERT_TRUE(text) << text.error().message();
  const auto script = parse_script(*text, "power_on.script");
  ASSERT_TRUE(script) << script.error().message();
  ScriptSource source(*script, "power_on.script");
  EXPECT_THAT(taken(source, 10 * kSecond_ns), HasSubstr("power opr"));
}

}  // namespace
}  // namespace yars::inputmonitor

// Commands of the instructor's page: each with its arguments; anything else is refused with what was expected.
#include "station/instructor_message.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "lib/radar/world.hpp"
#include "world/world_edit.hpp"
#include "world/world_values.hpp"

namespace yars::station {
namespace {

using ::testing::HasSubstr;

error::Expected<InstructorMessage> read(const char* text) {
  return instructor_message(nlohmann::json::parse(text));
}
std::string refusal(const char* text) {
  const auto message = read(text);
  return message ? "taken" : message.error().message();
}
template <class Command>
Command taken(const char* text) {
  const auto message = read(text);
  EXPECT_TRUE(message) << message.error().message();
  return std::get<Command>(message->command);
}

// A world after the command of a text; the world stays as it was if the command is refused.
databuffer::WorldState after(databuffer::WorldState world, const char* text, std::string* problem = nullptr) {
  const auto changed = taken<EditWorld>(text).edit(world, 10'000'000'000);
  if (!changed && problem != nullptr) *problem = changed.error().message();
  return changed.value_or(world);
}
databuffer::WorldState configured() {
  return world::world_state_from(radar::WorldConfiguration());
}

TEST(InstructorMessage, CommandsOfTheClockHaveTheirNumbers) {
  EXPECT_TRUE(taken<SetRunning>(R"({"do": "run", "id": 1})").running);
  EXPECT_FALSE(taken<SetRunning>(R"({"do": "freeze", "id": 1})").running);
  EXPECT_EQ(taken<SetRate>(R"({"do": "rate", "id": 1, "rate": 2.5})").rate, 2.5);
  EXPECT_EQ(taken<Step>(R"({"do": "step", "id": 1, "ticks": 20})").ticks, 20);
  EXPECT_EQ(taken<Reset>(R"({"do": "reset", "id": 1, "time": 12.5})").time_s, 12.5);
  EXPECT_EQ(read(R"({"do": "run", "id": 77})")->id, 77);
}

TEST(InstructorMessage, ARepositioningMayHaveASpeed) {
  const auto with = taken<Reposition>(
      R"({"do": "reposition", "id": 1, "lat": 37, "lon": -122.5, "alt_ft": 12000, "heading": 90, "speed_kt": 400})");
  EXPECT_EQ(with.position.latitude_deg, 37.0);
  EXPECT_EQ(with.position.longitude_deg, -122.5);
  EXPECT_EQ(with.altitude_ft, 12000.0);
  EXPECT_EQ(with.heading_deg, 90.0);
  EXPECT_EQ(with.speed_kt, 400.0);
  for (const char* text :
       {R"({"do": "reposition", "id": 1, "lat": 37, "lon": -122.5, "alt_ft": 12000, "heading": 90})",
        R"({"do": "reposition", "id": 1, "lat": 37, "lon": -122.5, "alt_ft": 12000, "heading": 90, "speed_kt": null})"})
    EXPECT_EQ(taken<Reposition>(text).speed_kt, std::nullopt);
}

TEST(InstructorMessage, WhatIsNoCommandIsRefusedWithWhatIsExpected) {
  EXPECT_THAT(refusal(R"({"id": 1})"), HasSubstr("one of run, freeze"));
  EXPECT_THAT(refusal(R"({"do": "dance", "id": 1})"), HasSubstr("found dance"));
  EXPECT_THAT(refusal(R"({"do": "run"})"), HasSubstr("id: expected a whole number"));
  EXPECT_THAT(refusal(R"({"do": "run", "id": "x"})"), HasSubstr("id: expected a whole number"));
  EXPECT_THAT(refusal(R"({"do": "rate", "id": 1})"),
              HasSubstr("rate: rate: expected a number from 0 to 10, found nothing"));
  EXPECT_THAT(refusal(R"({"do": "rate", "id": 1, "rate": 11})"), HasSubstr("found 11"));
  EXPECT_THAT(refusal(R"({"do": "rate", "id": 1, "rate": "fast"})"), HasSubstr("found \"fast\""));
  EXPECT_THAT(refusal(R"({"do": "step", "id": 1, "ticks": 0})"), HasSubstr("from 1 to 2000"));
  EXPECT_THAT(refusal(R"({"do": "reposition", "id": 1, "lat": 91, "lon": 0, "alt_ft": 0, "heading": 0})"),
              HasSubstr("lat: expected a number from -90 to 90"));
  EXPECT_THAT(refusal(R"({"do": "play", "id": 1, "file": "", "at": 0})"), HasSubstr("file: expected a text"));
  EXPECT_THAT(world_lists(), HasSubstr("rain, jammers"));
  EXPECT_THAT(refusal(R"({"do": "add", "id": 1, "list": "trees", "lat": 1, "lon": 1})"), HasSubstr(world_lists()));
  EXPECT_THAT(refusal(R"({"do": "add", "id": 1, "list": "rain", "lat": 1})"), HasSubstr("two numbers"));
  EXPECT_THAT(refusal(R"({"do": "sea", "id": 1})"), HasSubstr("null: from the wind"));
}

TEST(InstructorMessage, EntriesOfTheWorldAreAddedMovedChangedAndRemoved) {
  auto world = after(configured(), R"({"do": "add", "id": 1, "list": "rain", "lat": 37, "lon": -122})");
  ASSERT_EQ(world.rain_count, 1U);
  EXPECT_EQ(world.rain[0].latitude_deg, 37.0);
  const std::string item = std::to_string(world.rain[0].id);
  world = after(
      world, (R"({"do": "move", "id": 1, "list": "rain", "item": )" + item + R"(, "lat": 38, "lon": -121})").c_str());
  EXPECT_EQ(world.rain[0].latitude_deg, 38.0);
  EXPECT_EQ(world.rain[0].longitude_deg, -121.0);
  world = after(world, (R"({"do": "change", "id": 1, "list": "rain", "item": )" + item +
                        R"(, "radius_nm": 2, "rate_mmh": 50, "top_ft": 20000})")
                           .c_str());
  EXPECT_DOUBLE_EQ(world.rain[0].radius_m, 3704.0);
  EXPECT_EQ(world.rain[0].rate_mmh, 50.0);
  EXPECT_EQ(world.rain[0].latitude_deg, 38.0) << "what is not named stays";
  world = after(world, (R"({"do": "remove", "id": 1, "list": "rain", "item": )" + item + "}").c_str());
  EXPECT_EQ(world.rain_count, 0U);

  world = after(world, R"({"do": "add", "id": 1, "list": "jammers", "lat": 37, "lon": -122})");
  world = after(world, R"({"do": "add", "id": 1, "list": "movers", "lat": 36, "lon": -122})");
  ASSERT_EQ(world.jammer_count + world.mover_count, 2U);
  const std::string mover = std::to_string(world.movers[0].id);
  world = after(world, (R"({"do": "change", "id": 1, "list": "movers", "item": )" + mover +
                        R"(, "speed_kt": 20, "heading_deg": 45})")
                           .c_str());
  EXPECT_NEAR(world.movers[0].speed_mps, 10.2889, 1e-3);
  EXPECT_EQ(world.movers[0].heading_deg, 45.0);
  EXPECT_EQ(world.movers[0].since_ns, 10'000'000'000) << "it turns where it is at the time of the command";

  world = after(world, R"({"do": "add", "id": 1, "list": "points", "lat": 35, "lon": -122})");
  ASSERT_EQ(world.point_count, 1U);
  EXPECT_STREQ(world.points[0].name, "1");
  const std::string change_point =
      R"({"do": "change", "id": 1, "list": "points", "item": )" + std::to_string(world.points[0].id);
  world = after(world, (change_point + R"(, "name": "4.", "elevation_ft": 1000})").c_str());
  EXPECT_STREQ(world.points[0].name, "4.");
  EXPECT_NEAR(world.points[0].elevation_m, 304.8, 1e-9);
  world = after(world, (change_point + R"(, "name": "4.", "elevation_ft": null})").c_str());
  EXPECT_TRUE(std::isnan(world.points[0].elevation_m));
  std::string problem;
  world = after(world, (change_point + R"(, "name": "four", "elevation_ft": null})").c_str(), &problem);
  EXPECT_STREQ(world.points[0].name, "4.");
  EXPECT_NE(problem.find("2.01"), std::string::npos) << problem;
}

TEST(InstructorMessage, AnEntryThatIsRestoredIsNamedByListAndId) {
  const auto restored = taken<RestoreEntry>(R"({"do": "restore", "id": 1, "list": "movers", "item": 7})");
  EXPECT_EQ(restored.list, world::WorldList::movers);
  EXPECT_EQ(restored.item, 7U);
  EXPECT_THAT(refusal(R"({"do": "restore", "id": 1, "list": "trees", "item": 7})"),
              HasSubstr("restore: list: expected " + world_lists() + ", found \"trees\""));
  EXPECT_THAT(refusal(R"({"do": "restore", "id": 1, "list": "rain"})"), HasSubstr("item: expected a whole number"));
  EXPECT_TRUE(read(R"({"do": "undo reset", "id": 1})"));
}

TEST(InstructorMessage, SeaWindAndFidelityAreSet) {
  auto world = after(configured(), R"({"do": "sea", "id": 1, "state": 5})");
  EXPECT_EQ(world.sea_state, 5.0);
  world = after(world, R"({"do": "sea", "id": 1, "state": null})");
  EXPECT_TRUE(std::isnan(world.sea_state));
  world = after(world, R"({"do": "wind", "id": 1, "speed_kt": 20, "from": 180})");
  EXPECT_NEAR(world.wind_speed_mps, 10.2889, 1e-3);
  EXPECT_EQ(world.wind_from_deg, 180.0);
  world = after(world, R"({"do": "fidelity", "id": 1, "preset": "draft"})");
  EXPECT_STREQ(world.fidelity, "draft");
  world = after(world, R"({"do": "fidelity", "id": 1, "preset": ""})");
  EXPECT_STREQ(world.fidelity, "");
}

TEST(InstructorMessage, AnEditThatCannotBeMadeSaysWhy) {
  std::string problem;
  after(configured(), R"({"do": "remove", "id": 1, "list": "rain", "item": 9})", &problem);
  EXPECT_THAT(problem, HasSubstr("9"));
  after(configured(), R"({"do": "sea", "id": 1, "state": 7})", &problem);
  EXPECT_THAT(problem, HasSubstr("6"));
  after(configured(), R"({"do": "fidelity", "id": 1, "preset": "finest"})", &problem);
  EXPECT_THAT(problem, HasSubstr("standard"));
  after(configured(), R"({"do": "wind", "id": 1, "speed_kt": 500, "from": 0})", &problem);
  EXPECT_THAT(problem, HasSubstr("120"));
}

// A part of a number names no entry and no tick.
TEST(InstructorMessage, IdsAndTicksAreWholeNumbers) {
  const auto world = after(configured(), R"({"do": "add", "id": 1, "list": "rain", "lat": 37, "lon": -122})");
  const std::string item = std::to_string(world.rain[0].id);
  for (const char* part : {".25", ".000001"}) {
    std::string problem;
    EXPECT_EQ(
        after(world, (R"({"do": "remove", "id": 1, "list": "rain", "item": )" + item + part + "}").c_str(), &problem)
            .rain_count,
        1U);
    EXPECT_THAT(problem, HasSubstr("expected one of the ids"));
    EXPECT_THAT(refusal((R"({"do": "restore", "id": 1, "list": "rain", "item": )" + item + part + "}").c_str()),
                HasSubstr("restore: item: expected a whole number from 1 to 4294967295, found " + item + part));
    EXPECT_THAT(refusal((std::string(R"({"do": "step", "id": 1, "ticks": 3)") + part + "}").c_str()),
                HasSubstr("step: ticks: expected a whole number from 1 to 2000"));
  }
  EXPECT_EQ(after(world, (R"({"do": "remove", "id": 1, "list": "rain", "item": )" + item + ".0}").c_str()).rain_count,
            0U);
  EXPECT_THAT(refusal(R"({"do": "run", "id": 18446744073709551615})"), HasSubstr("id: expected a whole number"));
  EXPECT_EQ(read(R"({"do": "run", "id": 9223372036854775807})")->id, std::numeric_limits<std::int64_t>::max());
}

TEST(InstructorMessage, AFidelityNeedsItsName) {
  for (const char* text : {R"({"do": "fidelity", "id": 1})", R"({"do": "fidelity", "id": 1, "preset": null})",
                           R"({"do": "fidelity", "id": 1, "preset": 5})"})
    EXPECT_THAT(refusal(text), HasSubstr("preset: expected a text; empty: the configured one"));
}

TEST(InstructorMessage, AnswersBearTheIdAndTheProblem) {
  EXPECT_EQ(answer_to(3, std::nullopt), R"({"answer":3,"problem":null})");
  EXPECT_EQ(answer_to(4, "no"), R"({"answer":4,"problem":"no"})");
}

}  // namespace
}  // namespace yars::station

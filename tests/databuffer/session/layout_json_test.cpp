// Tests of layout_json(), the description of the segment's layout for programs in other languages.
#include "databuffer/session/layout_json.hpp"

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "databuffer/session/session.hpp"
#include "databuffer/session/session_layout.hpp"
#include "tests/databuffer/session/session_name.hpp"

namespace yars::databuffer {
namespace {

using nlohmann::json;

TEST(LayoutJson, HasVersionSizeHashAndLockBytes) {
  const json layout = json::parse(layout_json());
  EXPECT_EQ(layout["version"], kLayoutVersion);
  EXPECT_EQ(layout["size"], sizeof(SessionLayout));
  EXPECT_EQ(std::stoull(layout["hash"].get<std::string>(), nullptr, 16), kLayoutIdentity.hash);
  EXPECT_EQ(layout["lock_bytes"]["state-machine"], 2);
  EXPECT_EQ(layout["lock_bytes"]["first_input_lane"], 16);
}

// Reads records with offsets from the JSON alone, as a program in another language does.
class LayoutJsonTest : public testing::SessionTest {};

TEST_F(LayoutJsonTest, LeadsAReaderToAPublishedValue) {
  auto session = Session::open(name_, "tester");
  ASSERT_TRUE(session);
  for (int n = 1; n <= 6; ++n) {
    Ownship ownship{};
    ownship.altitude_msl_m = 1000.0 * n;
    session->layout().ownship[2].publish(ownship);
  }
  const json layout = json::parse(layout_json());
  const json part = layout["containers"]["ownship"];
  const auto* memory = reinterpret_cast<const char*>(&session->layout());
  const auto word_at = [&](std::size_t at) {
    std::uint64_t word;
    std::memcpy(&word, memory + at, sizeof word);
    return word;
  };
  const std::size_t lane = layout["offsets"]["ownship"].get<std::size_t>() + 2 * part["stride"].get<std::size_t>();
  const std::uint64_t version = word_at(lane + part["state"].get<std::size_t>()) >> 1;
  EXPECT_EQ(version, 6u);
  const std::size_t slot = lane + part["slots"].get<std::size_t>() +
                           version % part["slot_count"].get<std::size_t>() * part["slot_stride"].get<std::size_t>();
  EXPECT_EQ(word_at(slot + part["slot_version"].get<std::size_t>()), version);
  EXPECT_EQ(word_at(slot) % 2, 0u);
  const json field = layout["records"]["Ownship"]["fields"]["altitude_msl_m"];
  double altitude;
  std::memcpy(&altitude, memory + slot + part["slot_words"].get<std::size_t>() + field[0].get<std::size_t>(), 8);
  EXPECT_EQ(altitude, 6000.0);
}

TEST_F(LayoutJsonTest, LeadsAReaderToAnEventAndANote) {
  auto session = Session::open(name_, "tester");
  ASSERT_TRUE(session);
  const json layout = json::parse(layout_json());
  const auto* memory = reinterpret_cast<const char*>(&session->layout());
  InputEvent event{};
  event.argument = 13;
  ASSERT_TRUE(session->layout().input.push(3, event));
  const json input = layout["containers"]["input"];
  const std::size_t lane = layout["offsets"]["input"].get<std::size_t>() + 3 * input["stride"].get<std::size_t>();
  std::int16_t argument;
  const std::size_t record = lane + input["records"].get<std::size_t>();
  const json field = layout["records"]["InputEvent"]["fields"]["argument"];
  std::memcpy(&argument, memory + record + field[0].get<std::size_t>(), sizeof argument);
  EXPECT_EQ(argument, 13);
  EXPECT_EQ(memory[lane + input["pushed"].get<std::size_t>()], 1);

  session->note(NoteKind::loss, "hello");
  const json notes = layout["containers"]["notes"];
  const std::size_t line = layout["offsets"]["notes"].get<std::size_t>() + notes["slots"].get<std::size_t>() +
                           notes["slot_words"].get<std::size_t>();
  EXPECT_STREQ(memory + line + layout["records"]["Note"]["fields"]["text"][0].get<std::size_t>(), "hello");
}

}  // namespace
}  // namespace yars::databuffer

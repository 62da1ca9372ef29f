// Writer and reader of recordings: all items are read back in order. Of damaged or truncated files, all whole blocks
// are read.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "flightmodel/route_flight.hpp"
#include "radar/recording/block.hpp"
#include "radar/recording/recorded_kinds.hpp"
#include "tests/radar/recording/made_recording.hpp"

namespace yars::recording {
namespace {

using databuffer::ModelTick;
using test::expect_same;
using test::is_begin_of;
using test::items_of_every_kind;
using test::reader_of;
using test::recorded;
using test::rest_of;
using test::same;

// End of a block.
struct BlockEnd {
  std::size_t bytes;  // offset in the file
  std::size_t items;  // number of items up to this end
};
std::vector<BlockEnd> block_ends(const std::string& file) {
  const auto reader = reader_of(file);
  std::vector<BlockEnd> ends;
  std::size_t items = 0;
  for (const IndexEntry& block : reader->blocks()) {
    BlockHead head{};
    std::memcpy(&head, file.data() + block.offset, sizeof head);
    items += head.items;
    ends.push_back({block.offset + sizeof head + head.body_bytes, items});
  }
  return ends;
}

TEST(Recording, ReadsBackEveryItemInOrder) {
  const auto items = items_of_every_kind(1500);
  auto reader = reader_of(recorded(items));
  ASSERT_TRUE(reader.has_value()) << reader.error().message();
  EXPECT_EQ(reader->header().configuration, "made.guf");
  EXPECT_EQ(reader->header().terrain, "hills");
  EXPECT_GE(reader->blocks().size(), 7U) << "one second a block";
  expect_same(rest_of(*reader), items);
  EXPECT_FALSE(reader->cut_short());
}

// Format version 3, of releases up to 0.4, has no model number.
TEST(Recording, OfAnOlderModelIsReadAndIsNotComparable) {
  std::vector<std::byte> bytes = bytes_of(RecordingHeader{"made.guf", "hills"});
  constexpr std::size_t kVersion = 8, kModel = 24, kModelBytes = 8, kChecksumBytes = 4;
  bytes[kVersion] = std::byte{3};
  bytes.erase(bytes.begin() + kModel, bytes.begin() + kModel + kModelBytes);
  bytes.resize(bytes.size() - kChecksumBytes);
  const std::uint32_t checksum = checksum_of(bytes);
  std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  text.append(reinterpret_cast<const char*>(&checksum), sizeof checksum);
  std::istringstream file(text);
  const auto header = read_header(file, "old.yars");
  ASSERT_TRUE(header) << header.error().message();
  EXPECT_EQ(header->configuration, "made.guf");
  EXPECT_EQ(header->model, 1U);
  const auto same = check_model(*header, "old.yars");
  ASSERT_FALSE(same);
  EXPECT_THAT(same.error().message(), ::testing::HasSubstr("one made by model 1"));
  EXPECT_TRUE(check_model(RecordingHeader{}, "new.yars"));
}

TEST(Recording, WithoutItemsIsComplete) {
  auto reader = reader_of(recorded({}));
  ASSERT_TRUE(reader.has_value());
  EXPECT_FALSE(reader->next().has_value());
  EXPECT_FALSE(reader->cut_short());
  reader->seek_block(reader->block_of(5));
  EXPECT_FALSE(reader->next().has_value());
}

TEST(Recording, CutAtAnyLengthIsReadableToItsLastWholeBlock) {
  const auto items = items_of_every_kind(24, 25);
  const std::string whole = recorded(items);
  const auto ends = block_ends(whole);
  ASSERT_GE(ends.size(), 3U);
  const std::size_t header = reader_of(whole)->blocks()[0].offset;
  for (std::size_t length = 0; length < whole.size(); ++length) {
    SCOPED_TRACE(length);
    auto reader = reader_of(whole.substr(0, length));
    ASSERT_EQ(reader.has_value(), length >= header);
    if (!reader) continue;
    std::size_t expected = 0;
    for (const auto& end : ends)
      if (end.bytes <= length) expected = end.items;
    const auto found = rest_of(*reader);
    ASSERT_EQ(found.size(), expected);
    EXPECT_TRUE(is_begin_of(found, items));
    EXPECT_TRUE(reader->cut_short());
    EXPECT_TRUE(reader->missing().empty()) << "cut, not damaged";
  }
}

TEST(Recording, AnyChangedByteLosesAtMostItsBlock) {
  const auto items = items_of_every_kind(24, 25);
  const std::string whole = recorded(items);
  const auto ends = block_ends(whole);
  const std::size_t step = std::getenv("YARS_TEST_FULL") != nullptr ? 1 : 5;  // 5: bytes with every kind of change
  for (std::size_t at = 0; at < whole.size(); at += step) {
    const unsigned flip = at % 3 == 0 ? 0xffU : 1U << at % 8;
    SCOPED_TRACE(std::to_string(at) + " by " + std::to_string(flip));
    std::string changed = whole;
    changed[at] = static_cast<char>(static_cast<unsigned char>(changed[at]) ^ flip);
    auto reader = reader_of(changed);
    if (!reader) continue;
    const auto found = rest_of(*reader);
    EXPECT_TRUE(reader->cut_short());
    // The items of the block with the changed byte are lost. No item is lost if the byte lies in the index.
    const auto hit = std::ranges::find_if(ends, [at](const auto& end) { return at < end.bytes; });
    auto expected = items;
    if (hit != ends.end()) {
      const std::size_t begin = hit == ends.begin() ? 0 : (hit - 1)->items;
      expected.erase(expected.begin() + static_cast<std::ptrdiff_t>(begin),
                     expected.begin() + static_cast<std::ptrdiff_t>(hit->items));
    }
    expect_same(found, expected);
    EXPECT_EQ(reader->missing().size(), hit == ends.end() ? 0U : 1U);
  }
}

// A killed recorder leaves no index. The reader then finds the block after the damage by its head.
TEST(Recording, WithoutAnIndexADamagedBlockLosesThatBlockAndItsTicksAreReported) {
  const auto items = items_of_every_kind(1000);
  const std::string whole = recorded(items);
  const auto blocks = test::blocks_of(whole);
  const auto ends = block_ends(whole);
  ASSERT_GE(blocks.size(), 4U);
  for (const std::size_t where : {std::size_t{0}, std::size_t{30}, sizeof(BlockHead) + 20}) {
    SCOPED_TRACE(where);
    std::string bytes = whole.substr(0, ends.back().bytes);
    bytes[blocks[2].offset + where] ^= 1;
    auto reader = reader_of(bytes);
    auto expected = items;
    expected.erase(expected.begin() + static_cast<std::ptrdiff_t>(ends[1].items),
                   expected.begin() + static_cast<std::ptrdiff_t>(ends[2].items));
    expect_same(rest_of(*reader), expected);
    ASSERT_EQ(reader->missing().size(), 1U);
    EXPECT_LE(std::abs(reader->missing()[0].first_tick - blocks[2].first_tick), 1);
    EXPECT_LE(std::abs(reader->missing()[0].last_tick - blocks[2].last_tick), 1);
  }
}

TEST(Recording, SeveralDamagedBlocksAreEachSkippedAndReported) {
  const auto items = items_of_every_kind(2000);
  std::string bytes = recorded(items);
  const auto blocks = test::blocks_of(bytes);
  const std::vector<std::uint64_t> hit{blocks[0].offset, blocks[3].offset, blocks[4].offset};
  for (const std::uint64_t offset : hit) bytes[offset + sizeof(BlockHead) + 9] ^= 4;
  auto reader = reader_of(bytes);
  bool hole_reported = false;
  std::size_t found = 0;
  while (reader->next()) {
    hole_reported = reader->take_damage_flag() || hole_reported;
    ++found;
  }
  EXPECT_TRUE(hole_reported);
  EXPECT_GT(found, items.size() / 2);
  ASSERT_EQ(reader->missing().size(), 3U);
  for (std::size_t i = 0; i < hit.size(); ++i) EXPECT_EQ(reader->missing()[i].offset, hit[i]);
  EXPECT_TRUE(reader->last_before<StateChange>()) << "from a whole block before a damaged block";
}

TEST(Recording, ReportsTheOffsetOfADamagedBlock) {
  std::string bytes = recorded(items_of_every_kind(1000));
  const std::uint64_t third = reader_of(bytes)->blocks()[2].offset;
  bytes[third + sizeof(BlockHead) + 20] ^= 1;
  auto reader = reader_of(bytes);
  rest_of(*reader);
  ASSERT_EQ(reader->missing().size(), 1U);
  EXPECT_EQ(reader->missing()[0].offset, third);
  reader->seek_block(reader->block_of(900));
  EXPECT_TRUE(reader->next().has_value()) << "a block after the damaged block can be sought";
  EXPECT_TRUE(reader->cut_short());
}

TEST(Recording, SeeksTheBlockThatHoldsATick) {
  const auto items = items_of_every_kind(2000);
  auto reader = reader_of(recorded(items));
  for (const int tick : {1999, 100, 1234, 700, 299, 300, 301}) {
    SCOPED_TRACE(tick);
    reader->seek_block(reader->block_of(tick));
    const auto rest = rest_of(*reader);
    const auto found = std::find_if(rest.begin(), rest.end(), [tick](const auto& item) {
      const auto* record = std::get_if<ModelTick>(&item);
      return record != nullptr && record->tick == tick;
    });
    ASSERT_NE(found, rest.end());
    EXPECT_LT(found - rest.begin(), 1000) << "in the first block that is read";
    EXPECT_TRUE(std::equal(rest.rbegin(), rest.rend(), items.rbegin(), same));
  }
  reader->seek_block(reader->block_of(0));
  expect_same(rest_of(*reader), items);
  reader->seek_block(reader->block_of(720'000));
  EXPECT_LT(rest_of(*reader).size(), 1000U) << "a tick beyond the end leads to the last block";
}

TEST(Recording, LastBeforeGivesTheLastRecordOfAKindBeforeTheCurrentBlock) {
  const auto items = items_of_every_kind(2000);
  auto reader = reader_of(recorded(items));
  EXPECT_FALSE(reader->last_before<StateChange>().has_value());
  EXPECT_FALSE(reader->last_before<StartingPoint>().has_value());
  reader->seek_block(reader->block_of(1000));
  const auto rest = rest_of(*reader);
  reader->seek_block(reader->block_of(1000));
  const auto begin = items.end() - static_cast<std::ptrdiff_t>(rest.size());
  const auto is_state = [](const auto& item) { return std::holds_alternative<StateChange>(item); };
  const auto last = std::find_if(std::make_reverse_iterator(begin), items.rend(), is_state);
  const auto state = reader->last_before<StateChange>();
  ASSERT_TRUE(state.has_value());
  EXPECT_TRUE(same(*state, *last));
  ASSERT_TRUE(reader->last_before<StartingPoint>().has_value()) << "from a block far before";
  EXPECT_TRUE(same(*reader->last_before<StartingPoint>(), items[0]));
  // After some items of the block are read, the result is still the last record before the block.
  ASSERT_TRUE(reader->next().has_value());
  EXPECT_TRUE(same(*reader->last_before<StateChange>(), *last));
}

TEST(Recording, BeginsABlockWhenTicksGoBackwards) {
  std::vector<RecordingItem> items;
  for (int tick = 5000; tick < 5050; ++tick) items.emplace_back(test::tick_at(tick));
  for (int tick = 0; tick < 50; ++tick) items.emplace_back(test::tick_at(tick));
  auto reader = reader_of(recorded(items));
  ASSERT_EQ(reader->blocks().size(), 2U);
  EXPECT_EQ(reader->blocks()[0].first_tick, 5000);
  EXPECT_EQ(reader->blocks()[0].last_tick, 5049);
  EXPECT_EQ(reader->blocks()[1].last_tick, 49);
  expect_same(rest_of(*reader), items);
  reader->seek_block(reader->block_of(20));
  EXPECT_EQ(rest_of(*reader).size(), 50U);
}

TEST(Recording, AcceptsAnyTickNumbers) {
  constexpr auto kLowest = std::numeric_limits<std::int64_t>::min(),
                 kHighest = std::numeric_limits<std::int64_t>::max();
  std::vector<RecordingItem> items;
  for (const std::int64_t tick : {std::int64_t{0}, kHighest, kLowest, kHighest - 1, kLowest + 1}) {
    ModelTick record = test::tick_at(0);
    record.tick = tick;
    items.emplace_back(record);
  }
  auto reader = reader_of(recorded(items));
  expect_same(rest_of(*reader), items);
}

TEST(Recording, WritesABlockEarlyWhenItsItemsExceedTheBlockLimits) {
  std::mt19937_64 random(3);
  std::vector<RecordingItem> items;
  for (int i = 0; i < 12; ++i) items.emplace_back(test::patch_at(7, databuffer::kMaxPatchPixels, random));
  for (int i = 0; i < 20'000; ++i) items.emplace_back(Gap{1, 2, 3});
  auto reader = reader_of(recorded(items));
  EXPECT_GE(reader->blocks().size(), 5U);
  expect_same(rest_of(*reader), items);
}

TEST(Recording, OfIncompressibleSweepsIsSmallerThanTheSweepRecords) {
  std::mt19937_64 random(11);
  std::vector<RecordingItem> items;
  std::size_t raw = 0;
  for (int tick = 0; tick < 400; ++tick) {
    auto sweep = test::sweep_at(tick, 512, random);  // random video, which cannot be compressed
    raw += used_bytes(sweep);
    items.emplace_back(sweep);
  }
  EXPECT_LT(recorded(items).size(), raw);
}

// Extrapolated from one minute of flight, with a cursor whose bearing and range change each tick.
TEST(Recording, OfAnHourTakesAtMost50Megabytes) {
  const auto route = flightmodel::parse_route(
      "37.5 -122 15000 420\n37.6 -122 18000 480\n37.6 -121.9 16000 450\n37.5 -121.9 15000 480\nloop\n", "made");
  flightmodel::RouteFlight flight(*route);
  std::vector<RecordingItem> items;
  StatePace pace;
  databuffer::RadarState state{};
  for (int tick = 0; tick < 60 * 200; ++tick) {
    ModelTick record = test::tick_at(tick);
    record.ownship = flight.step(geo::Duration::seconds(radar::kTickSeconds)).ownship;
    record.ownship.source_time_ns = record.sim_time_ns;
    items.emplace_back(record);
    state.tick = tick;
    state.cursor_bearing_deg = 100.0 * record.ownship.latitude_deg;
    state.cursor_range_nm = 20.0 - 100.0 * (record.ownship.longitude_deg + 122.0);
    if (pace.takes(state, tick)) items.emplace_back(StateChange{state});
    if (tick % 20 == 0) items.emplace_back(databuffer::AppliedEvent{tick, tick, {}, 0, 1});
  }
  const std::size_t bytes = recorded(items).size();
  RecordProperty("megabytes_an_hour", std::to_string(static_cast<double>(bytes) * 60e-6));
  EXPECT_LT(bytes * 60, 50'000'000U);
}

TEST(Recording, RefusesFilesOfAnotherKindOrVersion) {
  const auto message_of = [](const std::string& bytes) {
    const auto reader = reader_of(bytes);
    return reader ? std::string("read") : reader.error().message();
  };
  EXPECT_NE(message_of("").find("another kind of file"), std::string::npos);
  EXPECT_NE(message_of("a letter of some length, by a person").find("another kind of file"), std::string::npos);
  std::string other = recorded({});
  other[8] = 2;
  EXPECT_NE(message_of(other).find("version 4"), std::string::npos) << message_of(other);
  EXPECT_FALSE(RecordingReader::open("/nowhere/run.yars").has_value());
}

TEST(Recording, WithRecordsOfAnotherSizeIsRefusedByTheirName) {
  std::string bytes = recorded({});
  // Changes the size of the first kind, and corrects the header's checksum.
  constexpr std::size_t kKinds = 24 + 8;  // after preamble and model
  constexpr std::size_t kFirstKindBytes = kKinds + 4;
  bytes[kFirstKindBytes] ^= 8;
  const std::size_t header = kKinds + 8 * recorded_kinds().size() + std::string("made.gufhills").size();
  const std::uint32_t checksum = checksum_of(std::as_bytes(std::span(bytes).first(header)));
  std::memcpy(bytes.data() + header, &checksum, sizeof checksum);
  const auto reader = reader_of(bytes);
  ASSERT_FALSE(reader.has_value());
  EXPECT_NE(reader.error().message().find("ModelTick version 1 with records of " + std::to_string(sizeof(ModelTick))),
            std::string::npos)
      << reader.error().message();
}

TEST(Recording, SkipsABlockWhoseHeadDoesNotMatchItsBody) {
  const std::string whole = recorded(items_of_every_kind(100));
  const std::uint64_t offset = reader_of(whole)->blocks()[0].offset;
  BlockHead head{};
  std::memcpy(&head, whole.data() + offset, sizeof head);
  const auto body = std::as_bytes(std::span(whole)).subspan(offset + sizeof head, head.body_bytes);
  const auto items_read_with = [&](BlockHead claimed) {
    std::string bytes = whole;
    const auto block = block_bytes(claimed, body);
    std::memcpy(bytes.data() + offset, block.data(), block.size());
    auto reader = reader_of(bytes);
    const std::size_t items = rest_of(*reader).size();
    EXPECT_EQ(!reader->missing().empty(), items == 0);
    return items;
  };
  EXPECT_GT(items_read_with(head), 0U);
  for (std::uint32_t BlockHead::* claim : {&BlockHead::items, &BlockHead::raw_bytes})
    for (const std::uint32_t value : {0U, head.*claim - 1, head.*claim + 1, 0x7fffffU, 0xffffffffU}) {
      BlockHead claimed = head;
      claimed.*claim = value;
      EXPECT_EQ(items_read_with(claimed), 0U) << value;
    }
}

}  // namespace
}  // namespace yars::recording

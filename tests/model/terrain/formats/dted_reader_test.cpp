// Reader of DTED files: known deviations of producers, contradictory files, damaged files. The files are built byte by
// byte.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include "model/terrain/formats/dted.hpp"
#include "tests/model/terrain/formats/dted_builder.hpp"

namespace yars::model::terrain {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr CellCorner kDtedCorner{50, 10};

error::Expected<CellReading> parse(const test::DtedFile& file) {
  return parse_dted(file.bytes(), "small.dt0", kDtedCorner);
}

TEST(DtedReader, ColumnsRunFromSouthToNorthAndFromWestToEast) {
  const auto reading = parse(test::small_dted());
  ASSERT_TRUE(reading.has_value()) << reading.error().message();
  EXPECT_THAT(reading->warnings, IsEmpty());
  for (int row = 0; row < 5; ++row)
    for (int column = 0; column < 5; ++column) EXPECT_EQ(reading->cell.post(row, column), 100 * column + row);
  EXPECT_EQ(reading->cell.corner(), kDtedCorner);
  EXPECT_EQ(reading->cell.sea_posts(), 1U);
}

TEST(DtedReader, NegativeHeightsAreSignMagnitude) {
  test::DtedFile file = test::small_dted();
  file.columns[1].words[2] = 0x8000 | 42;
  const auto reading = parse(file);
  ASSERT_TRUE(reading.has_value());
  EXPECT_EQ(reading->cell.post(2, 1), -42);
  EXPECT_EQ(reading->cell.lowest_m(), -42);
}

TEST(DtedReader, OnlyWgs84AndHeightsAboveMeanSeaLevelAreRead) {
  test::DtedFile file = test::small_dted();
  for (const char* vertical : {"MSL", "E96", "E08", "   "}) {
    file.vertical_datum = vertical;
    EXPECT_TRUE(parse(file).has_value()) << vertical;
  }
  file.vertical_datum = "ELL";
  EXPECT_THAT(parse(file).error().message(), HasSubstr("vertical datum"));
  file.vertical_datum = "MSL";
  file.horizontal_datum = "     ";
  EXPECT_TRUE(parse(file).has_value());
  file.horizontal_datum = "WGS72";
  ASSERT_FALSE(parse(file).has_value());
  EXPECT_THAT(parse(file).error().message(), HasSubstr("expected horizontal datum WGS84, found 'WGS72'"));
  file.horizontal_datum = "\x1b[31m";
  EXPECT_THAT(parse(file).error().message(), ::testing::Not(HasSubstr("\x1b")));
}

TEST(DtedReader, MinusZeroIsZero) {
  test::DtedFile file = test::small_dted();
  file.columns[1].words[2] = 0x8000;
  const auto reading = parse(file);
  ASSERT_TRUE(reading.has_value());
  EXPECT_EQ(reading->cell.post(2, 1), 0);
}

TEST(DtedReader, AllOnesIsAVoid) {
  test::DtedFile file = test::small_dted();
  file.columns[3].words[4] = 0xFFFF;
  const auto reading = parse(file);
  ASSERT_TRUE(reading.has_value());
  EXPECT_EQ(reading->cell.post(4, 3), kVoidPost);
  EXPECT_EQ(reading->cell.voids(), 1U);
}

TEST(DtedReader, AFileInTwosComplementIsReadAndReported) {
  test::DtedFile file = test::small_dted();
  file.columns[0].words[1] = static_cast<std::uint16_t>(-42);
  file.columns[0].words[2] = 0x8001;  // -32767: void in two's complement, -1 in sign-magnitude
  file.columns[0].words[3] = 0xFFFF;
  const auto reading = parse(file);
  ASSERT_TRUE(reading.has_value());
  EXPECT_EQ(reading->cell.post(1, 0), -42);
  EXPECT_EQ(reading->cell.post(2, 0), kVoidPost);
  EXPECT_EQ(reading->cell.post(3, 0), kVoidPost);
  EXPECT_THAT(reading->warnings, IsEmpty()) << "no data are left out";
  EXPECT_THAT(reading->notes, ElementsAre(HasSubstr("two's complement")));
}

TEST(DtedReader, AWrongChecksumIsCountedAndTheHeightsAreKept) {
  test::DtedFile file = test::small_dted();
  file.columns[1].sum_error = 1;
  file.columns[4].sum_error = -3;
  const auto reading = parse(file);
  ASSERT_TRUE(reading.has_value());
  EXPECT_THAT(reading->warnings, ElementsAre("columns with a wrong checksum: 2; their heights are kept"));
  EXPECT_EQ(reading->cell.post(3, 4), 403);
}

TEST(DtedReader, AbsentColumnsAreVoid) {
  test::DtedFile file = test::small_dted();
  file.columns.erase(file.columns.begin() + 1, file.columns.begin() + 3);
  const auto reading = parse(file);
  ASSERT_TRUE(reading.has_value());
  EXPECT_EQ(reading->cell.post(0, 0), 0);
  EXPECT_EQ(reading->cell.post(0, 1), kVoidPost);
  EXPECT_EQ(reading->cell.post(4, 2), kVoidPost);
  EXPECT_EQ(reading->cell.post(0, 3), 300);
  EXPECT_THAT(reading->warnings, ElementsAre(HasSubstr("absent columns: 2")));
}

TEST(DtedReader, ColumnsMayHaveAnyOrderAndTheLaterOfTwoIsUsed) {
  test::DtedFile file = test::small_dted();
  std::rotate(file.columns.begin(), file.columns.begin() + 3, file.columns.end());  // 3, 4, 0, 1, 2
  file.columns.push_back(file.columns[1]);
  file.columns.back().words = {9, 8, 7, 6, 5};
  const auto reading = parse(file);
  ASSERT_TRUE(reading.has_value()) << reading.error().message();
  EXPECT_THAT(reading->warnings, IsEmpty());
  for (int row = 0; row < 5; ++row) {
    for (int column = 0; column < 4; ++column) EXPECT_EQ(reading->cell.post(row, column), 100 * column + row);
    EXPECT_EQ(reading->cell.post(row, 4), 9 - row);
  }
}

// The reader decodes in memory that it uses again for the next cell.
TEST(DtedReader, NothingOfALargerCellIsLeftInASmallerOne) {
  const std::vector<std::int16_t> heights(std::size_t{121} * 121, 77);
  const std::vector<std::byte> large = dted_bytes(Cell({0, 10}, 121, 121, heights), 0);
  ASSERT_TRUE(parse_dted(large, "large.dt0", {0, 10}).has_value());
  test::DtedFile file = test::small_dted();
  file.columns.pop_back();
  const auto reading = parse(file);
  ASSERT_TRUE(reading.has_value());
  EXPECT_EQ(reading->cell.voids(), 5U);
  EXPECT_EQ(reading->cell.highest_m(), 304);
}

TEST(DtedReader, EveryWordIsDecoded) {
  const auto heights_of = [](std::uint16_t word, std::uint16_t other) {
    test::DtedFile file = test::small_dted();
    file.columns[1].words[2] = word;
    file.columns[4].words[4] = other;
    return parse(file)->cell.post(2, 1);
  };
  for (int word = 0; word <= 0xFFFF; word += 7) {
    const auto code = static_cast<std::uint16_t>(word);
    const int magnitude = word & 0x7FFF;
    if (word <= 0x8000 + 16000) {
      const int height_m = word < 0x8000 ? magnitude : -magnitude;
      const bool possible = height_m >= -12000 && height_m <= 10000 && height_m != -9999;
      EXPECT_EQ(heights_of(code, 0), possible ? height_m : kVoidPost) << word;
    }
    const auto height_m = static_cast<std::int16_t>(code);
    const bool possible = height_m >= -12000 && height_m <= 10000 && height_m != -9999 && word != 0xFFFF;
    EXPECT_EQ(heights_of(code, 0x8000 + 16001), possible ? height_m : kVoidPost) << word << " in two's complement";
  }
}

TEST(DtedReader, APartialColumnOfFullLengthBeginsAtItsLatitudeIndex) {
  test::DtedFile file = test::small_dted();
  file.columns[2].latitude_index = 3;
  file.columns[2].words = {7, 8, 0xFFFF, 0xFFFF, 0xFFFF};
  const auto reading = parse(file);
  ASSERT_TRUE(reading.has_value());
  EXPECT_EQ(reading->cell.post(2, 2), kVoidPost);
  EXPECT_EQ(reading->cell.post(3, 2), 7);
  EXPECT_EQ(reading->cell.post(4, 2), 8);
  EXPECT_EQ(reading->cell.post(4, 3), 304);
  EXPECT_THAT(reading->notes, ElementsAre(HasSubstr("partial columns: 1")));
  EXPECT_FALSE(reading->has_problem());
}

TEST(DtedReader, APartialColumnMayEndWithTheCell) {
  test::DtedFile file = test::small_dted();
  for (const int column : {1, 4}) {
    file.columns[static_cast<std::size_t>(column)].latitude_index = 3;
    file.columns[static_cast<std::size_t>(column)].words = {7, 8};
  }
  const auto reading = parse(file);
  ASSERT_TRUE(reading.has_value()) << reading.error().message();
  for (const int column : {1, 4}) {
    EXPECT_EQ(reading->cell.post(2, column), kVoidPost);
    EXPECT_EQ(reading->cell.post(3, column), 7);
    EXPECT_EQ(reading->cell.post(4, column), 8);
  }
  EXPECT_EQ(reading->cell.post(4, 3), 304);
}

TEST(DtedReader, FewerColumnsThanRowsAreRead) {
  test::DtedFile file = test::small_dted();
  file.latitude_interval = "4500";
  file.latitude_count = "0009";
  for (test::DtedColumn& column : file.columns) column.words.resize(9, 12);
  const auto reading = parse(file);
  ASSERT_TRUE(reading.has_value()) << reading.error().message();
  EXPECT_EQ(reading->cell.rows(), 9);
  EXPECT_EQ(reading->cell.columns(), 5);
  EXPECT_EQ(reading->cell.post(8, 4), 12);
}

TEST(DtedReader, TapeLabelsBeforeTheHeaderAreSkipped) {
  test::DtedFile file = test::small_dted();
  file.labels = "VOL1" + std::string(76, ' ') + "HDR1" + std::string(76, ' ');
  const auto reading = parse(file);
  ASSERT_TRUE(reading.has_value()) << reading.error().message();
  EXPECT_EQ(reading->cell.post(1, 4), 401);
}

struct BrokenField {
  const char* what;
  void (*spoil)(test::DtedFile&);
  const char* message;
};

class BrokenDted : public ::testing::TestWithParam<BrokenField> {};

TEST_P(BrokenDted, IsRefusedWithTheReason) {
  test::DtedFile file = test::small_dted();
  GetParam().spoil(file);
  const auto reading = parse(file);
  ASSERT_FALSE(reading.has_value());
  EXPECT_THAT(reading.error().message(), HasSubstr(GetParam().message));
  EXPECT_THAT(reading.error().message(), HasSubstr("small.dt0"));
}

INSTANTIATE_TEST_SUITE_P(
    DtedReader, BrokenDted,
    ::testing::Values(
        BrokenField{"Magic", [](test::DtedFile& file) { file.magic = "UHL9"; }, "UHL1"},
        BrokenField{"Digits", [](test::DtedFile& file) { file.latitude_count = "00x5"; }, "digits"},
        BrokenField{"HalfDegree", [](test::DtedFile& file) { file.latitude = "0503000N"; }, "whole degrees"},
        BrokenField{"Hemisphere", [](test::DtedFile& file) { file.longitude = "0100000X"; }, "whole degrees"},
        BrokenField{"OtherPlace", [](test::DtedFile& file) { file.longitude = "0100000W"; }, "as the name says"},
        BrokenField{"NoPosts", [](test::DtedFile& file) { file.latitude_count = "0000"; }, "span one degree"},
        BrokenField{"HugeCounts", [](test::DtedFile& file) { file.latitude_count = file.longitude_count = "9999"; },
                    "span one degree"},
        BrokenField{"HalfACell", [](test::DtedFile& file) { file.longitude_interval = "4500"; }, "span one degree"},
        BrokenField{"CountBeyondTheFile",
                    [](test::DtedFile& file) { file.latitude_count = "3601", file.latitude_interval = "0010"; },
                    "truncated"},
        BrokenField{"HeaderAlone", [](test::DtedFile& file) { file.columns.clear(); }, "truncated"},
        BrokenField{"TornColumn", [](test::DtedFile& file) { file.columns.back().words.resize(2); }, "truncated"},
        BrokenField{"Sentinel", [](test::DtedFile& file) { file.columns[2].sentinel = 0; }, "begins with AA"},
        BrokenField{"LongitudeIndex", [](test::DtedFile& file) { file.columns[2].longitude_index = 5; },
                    "inside the cell"},
        BrokenField{"LatitudeIndex", [](test::DtedFile& file) { file.columns[2].latitude_index = 5; },
                    "inside the cell"}),
    [](const auto& information) { return std::string(information.param.what); });

TEST(DtedReader, EveryTruncationIsRefusedOrLacksCompleteColumns) {
  const std::vector<std::byte> complete = test::small_dted().bytes();
  const std::size_t record = 12 + 2 * test::kSmallSide;
  for (std::size_t length = 0; length < complete.size(); ++length) {
    const auto reading = parse_dted(std::span(complete).first(length), "cut.dt0", kDtedCorner);
    const bool at_boundary = length > 3428 && (length - 3428) % record == 0;
    EXPECT_EQ(reading.has_value(), at_boundary) << "cut at " << length;
  }
}

TEST(DtedReader, BytesAfterTheLastColumnAreANoteUnlessTheyBeginARecord) {
  const std::vector<std::byte> complete = test::small_dted().bytes();
  for (const std::size_t count : {1, 3, 500}) {
    std::vector<std::byte> longer = complete;
    longer.resize(complete.size() + count);
    const auto reading = parse_dted(longer, "longer.dt0", kDtedCorner);
    ASSERT_TRUE(reading) << reading.error().message();
    EXPECT_THAT(reading->notes, testing::Contains(HasSubstr("after the last column record: " + std::to_string(count))));
    EXPECT_FALSE(reading->has_problem());
  }
  std::vector<std::byte> piece = complete;
  piece.push_back(std::byte{0xAA});
  const auto reading = parse_dted(piece, "longer.dt0", kDtedCorner);
  ASSERT_FALSE(reading);
  EXPECT_THAT(reading.error().message(), HasSubstr("nothing after the last column record, found 1 byte;"));
}

TEST(DtedReader, RandomDamageNeverReadsBeyondTheFile) {
  constexpr unsigned kSeed = 20;
  std::mt19937 random(kSeed);
  const std::vector<std::byte> complete = test::small_dted().bytes();
  // Offsets of the bytes that the reader interprets: the header UHL and the columns from byte 3428 on.
  std::vector<std::size_t> interpreted;
  for (std::size_t at = 0; at < complete.size(); ++at)
    if (at < 60 || at >= 3428) interpreted.push_back(at);
  int refused = 0;
  for (int round = 0; round < 4000; ++round) {
    std::vector<std::byte> damaged = complete;
    for (int change = 0; change < 3; ++change)
      damaged[interpreted[random() % interpreted.size()]] = static_cast<std::byte>(random());
    if (random() % 2 == 0) damaged.resize(random() % (damaged.size() + 1));
    const auto reading = parse_dted(damaged, "damaged.dt0", kDtedCorner);
    if (!reading)
      ++refused;
    else
      EXPECT_EQ(reading->cell.post_count(), 25U) << "seed " << kSeed << ", round " << round;
  }
  EXPECT_GT(refused, 1000) << "seed " << kSeed;
  EXPECT_LT(refused, 4000) << "seed " << kSeed;
}

}  // namespace
}  // namespace yars::model::terrain

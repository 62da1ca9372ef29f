// Reader of HGT (SRTM) files: order and encoding of posts, impossible heights, wrong lengths.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/terrain/formats/hgt.hpp"

namespace yars::model::terrain {
namespace {

using ::testing::HasSubstr;

// Sets a post. Row 0 is the northern row of the file.
void put(std::vector<std::byte>& bytes, std::size_t row, std::size_t column, std::size_t side, int height) {
  const std::size_t at = 2 * (row * side + column);
  bytes[at] = static_cast<std::byte>(static_cast<unsigned>(height) >> 8U & 0xFFU);
  bytes[at + 1] = static_cast<std::byte>(static_cast<unsigned>(height) & 0xFFU);
}

class HgtOfSide : public ::testing::TestWithParam<int> {};

TEST_P(HgtOfSide, RowsRunFromNorthToSouthInTwosComplement) {
  const auto side = static_cast<std::size_t>(GetParam());
  std::vector<std::byte> bytes(2 * side * side);
  put(bytes, 0, 0, side, 111);                   // north-west
  put(bytes, 0, side - 1, side, -42);            // north-east
  put(bytes, side - 1, 0, side, 333);            // south-west
  put(bytes, side - 1, side - 1, side, -32768);  // south-east: void
  const auto reading = parse_hgt(bytes, "N36W122.hgt", {36, -122});
  ASSERT_TRUE(reading.has_value()) << reading.error().message();
  const Cell& cell = reading->cell;
  const int last = GetParam() - 1;
  EXPECT_EQ(cell.post(last, 0), 111);
  EXPECT_EQ(cell.post(last, last), -42);
  EXPECT_EQ(cell.post(0, 0), 333);
  EXPECT_EQ(cell.post(0, last), kVoidPost);
  EXPECT_EQ(cell.voids(), 1U);
  EXPECT_EQ(cell.rows(), GetParam());
  EXPECT_EQ(cell.columns(), GetParam());
}

INSTANTIATE_TEST_SUITE_P(HgtReader, HgtOfSide, ::testing::Values(1201, 3601));

// From 50 degrees of latitude on, some producers write every second column.
TEST(HgtReader, AFileWithHalfOfTheColumnsIsRead) {
  constexpr std::size_t kRows = 3601, kColumns = 1801;
  std::vector<std::byte> bytes(2 * kRows * kColumns);
  put(bytes, 0, 0, kColumns, 111);                     // north-west
  put(bytes, kRows - 1, kColumns - 1, kColumns, -42);  // south-east
  const auto reading = parse_hgt(bytes, "N52E005.hgt", {52, 5});
  ASSERT_TRUE(reading.has_value()) << reading.error().message();
  EXPECT_EQ(reading->cell.rows(), 3601);
  EXPECT_EQ(reading->cell.columns(), 1801);
  EXPECT_EQ(reading->cell.post(3600, 0), 111);
  EXPECT_EQ(reading->cell.post(0, 1800), -42);
}

TEST(HgtReader, TheNameStatesTheCellBetweenOtherLetters) {
  for (const char* name : {"N31E036.hgt", "n31e036.SRTMGL3.hgt", "N31E036hgt.zip", "N31E036 (1).hgt", "N31_E036.hgt",
                           "ASTGTMV003_N31E036_dem.hgt", "n31_e036_3arc_v2.dt1", "N31E036-N31E036.hgt"})
    EXPECT_EQ(corner_in_name(name), (CellCorner{31, 36})) << name;
  EXPECT_EQ(corner_in_name("S01W180.hgt"), (CellCorner{-1, -180}));
  for (const char* name : {"", "N31.hgt", "sun31e036.hgt", "N31E0361.hgt", "N31E036_N32E036.hgt", "N90E000.hgt",
                           "N00E180.hgt", "S91E000.hgt", "N3xE036.hgt", "N31E03"})
    EXPECT_EQ(corner_in_name(name), std::nullopt) << name;
}

// Heights outside -12,000 to 10,000 m are damage. A mountain of 20 km must not appear on a radar map.
TEST(HgtReader, ImpossibleHeightsAreVoidAndCounted) {
  constexpr std::size_t kSide = 1201;
  std::vector<std::byte> bytes(2 * kSide * kSide);
  put(bytes, 0, 0, kSide, 10'001);
  put(bytes, 0, 1, kSide, -12'001);
  put(bytes, 0, 2, kSide, 10'000);
  put(bytes, 0, 3, kSide, -12'000);
  put(bytes, 0, 4, kSide, -32768);
  put(bytes, 0, 5, kSide, -9999);
  const auto reading = parse_hgt(bytes, "N36W122.hgt", {36, -122});
  ASSERT_TRUE(reading.has_value()) << reading.error().message();
  const int last = static_cast<int>(kSide) - 1;
  EXPECT_EQ(reading->cell.post(last, 0), kVoidPost);
  EXPECT_EQ(reading->cell.post(last, 1), kVoidPost);
  EXPECT_EQ(reading->cell.post(last, 2), 10'000);
  EXPECT_EQ(reading->cell.post(last, 3), -12'000);
  EXPECT_EQ(reading->cell.post(last, 5), kVoidPost) << "-9999 is a common value for no data";
  EXPECT_EQ(reading->cell.voids(), 4U);
  ASSERT_EQ(reading->warnings.size(), 1U) << "-32768 is a void and no damage";
  EXPECT_THAT(reading->warnings.front(), HasSubstr("3 posts"));
}

TEST(HgtReader, AnyOtherLengthIsRefused) {
  for (const std::size_t length :
       {std::size_t{0}, std::size_t{1}, std::size_t{2 * 1201 * 1201 - 1}, std::size_t{2 * 1201 * 1201 + 2}}) {
    const auto reading = parse_hgt(std::vector<std::byte>(length), "N36W122.hgt", {36, -122});
    ASSERT_FALSE(reading.has_value()) << length;
    EXPECT_THAT(reading.error().message(),
                HasSubstr("found " + std::to_string(length) + (length == 1 ? " byte;" : " bytes;")));
  }
}

}  // namespace
}  // namespace yars::model::terrain

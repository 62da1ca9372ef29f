// The note about a floor of the sea that would be drawn as land.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "model/terrain/formats/cell_reading.hpp"

namespace yars::model::terrain {
namespace {

using ::testing::HasSubstr;

constexpr int kSide = 121;

Cell cell_of(const std::function<int(int, int)>& height_m) {
  std::vector<std::int16_t> posts;
  for (int row = 0; row < kSide; ++row)
    for (int column = 0; column < kSide; ++column) posts.push_back(static_cast<std::int16_t>(height_m(row, column)));
  return {{45, 5}, kSide, kSide, posts};
}

TEST(SeaFloor, PostsBesideTheCoastBelowTheSeaAreNoted) {
  const auto note = sea_floor_note(cell_of([](int, int column) { return 10 * (column - 60); }));
  ASSERT_TRUE(note.has_value());
  EXPECT_THAT(*note, HasSubstr("down to -600 m"));
  EXPECT_THAT(*note, HasSubstr("gdal_calc.py"));
  EXPECT_TRUE(sea_floor_note(cell_of([](int row, int) { return 10 * (row - 60); }))) << "a coast from west to east";
}

TEST(SeaFloor, SeaAtZeroIsNotNoted) {
  EXPECT_FALSE(sea_floor_note(cell_of([](int, int column) { return std::max(0, 10 * (column - 60)); })));
  EXPECT_FALSE(sea_floor_note(cell_of([](int, int) { return 0; })));
  EXPECT_FALSE(sea_floor_note(cell_of([](int, int) { return kVoidPost; })));
}

TEST(SeaFloor, LowLandBehindDikesAndASingleErrorAreNotNoted) {
  EXPECT_FALSE(sea_floor_note(cell_of([](int row, int column) { return column < 60 ? 0 : row < 60 ? -6 : 5; })));
  EXPECT_FALSE(sea_floor_note(cell_of([](int row, int column) {
    if (row == 50 && column == 90) return -42;
    return column < 60 ? 0 : 5;
  })));
}

// A mine beside the sea: the sea at 0 m meets the land.
TEST(SeaFloor, ADeepHoleInLandWithACoastIsNotNoted) {
  EXPECT_FALSE(sea_floor_note(cell_of([](int row, int column) {
    if (column < 40) return 0;
    return row > 90 && row < 110 && column > 80 && column < 100 ? -200 : 50;
  })));
}

TEST(SeaFloor, OnlyTheFloorWithoutLandIsNotNoted) {
  EXPECT_FALSE(sea_floor_note(cell_of([](int, int) { return -500; }))) << "no coast";
}

}  // namespace
}  // namespace yars::model::terrain

// Writer of HGT (SRTM) files: the written cell is read back unchanged; file names.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/terrain/formats/hgt.hpp"
#include "tests/model/terrain/formats/dted_builder.hpp"
#include "tests/model/terrain/sampling/rough_cell.hpp"

namespace yars::model::terrain {
namespace {

TEST(HgtWriter, AWrittenCellIsReadBackUnchanged) {
  const test::TemporaryFolder folder;
  const Cell cell = test::rough_cell({-46, -66}, 1201, 1201, 1);
  const auto path = write_hgt(folder.path(), cell);
  ASSERT_TRUE(path.has_value()) << path.error().message();
  EXPECT_EQ(path->filename(), "S46W066.hgt");
  const auto reading = read_hgt(*path, cell.corner());
  ASSERT_TRUE(reading.has_value()) << reading.error().message();
  EXPECT_TRUE(test::same_posts(reading->cell, cell));
}

TEST(HgtWriter, FileNamesAreTheSouthWestCorner) {
  EXPECT_EQ(hgt_name({36, -122}), "N36W122.hgt");
  EXPECT_EQ(hgt_name({0, 7}), "N00E007.hgt");
}

}  // namespace
}  // namespace yars::model::terrain

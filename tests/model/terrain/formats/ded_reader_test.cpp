// Reader of MultiGen DED files: order of posts, several cells in a file, contradictory and damaged files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "model/terrain/formats/ded.hpp"
#include "model/terrain/store/directory_store.hpp"
#include "tests/model/terrain/formats/ded_builder.hpp"
#include "tests/model/terrain/formats/dted_builder.hpp"

namespace yars::model::terrain {
namespace {

using ::testing::HasSubstr;

class Ded : public ::testing::Test {
 protected:
  // Writes a file and returns its path.
  std::filesystem::path file_of(const std::vector<std::byte>& bytes) const {
    folder_.write("AREA.DED", bytes);
    return folder_.path() / "AREA.DED";
  }
  const test::TemporaryFolder folder_;
};

test::DedFile three_cells() {
  test::DedFile file;
  file.cells = {test::ded_cell(36, -122, 5, 4), test::ded_cell(36, -121, 7, 7), test::ded_cell(-1, 10, 3, 2)};
  return file;
}

TEST_F(Ded, ReadsColumnsFromSouthToNorthFromAFileOfSeveralCells) {
  test::DedFile file = three_cells();
  file.cells[0].posts[1] = -250;
  file.cells[0].posts[2] = -32767;
  const auto path = file_of(file.bytes());
  const auto reading = read_ded(path, {36, -122});
  ASSERT_TRUE(reading.has_value()) << reading.error().message();
  EXPECT_EQ(reading->cell.rows(), 5);
  EXPECT_EQ(reading->cell.columns(), 4);
  EXPECT_EQ(reading->cell.post(4, 3), 304);
  EXPECT_EQ(reading->cell.post(1, 0), -250);
  EXPECT_EQ(reading->cell.post(2, 0), kVoidPost);
  EXPECT_EQ(read_ded(path, {-1, 10})->cell.post(2, 1), 102);
  EXPECT_THAT(read_ded(path, {50, 50}).error().message(), HasSubstr("south-west corner 50, 50"));
}

TEST_F(Ded, FindsEachCellAtItsOffset) {
  const auto path = file_of(three_cells().bytes());
  const auto cells = ded_cells(path);
  ASSERT_TRUE(cells.has_value()) << cells.error().message();
  ASSERT_EQ(cells->size(), 3U);
  EXPECT_EQ(read_ded(path, {36, -121})->cell.post(6, 6), 606);
  auto store = DirectoryTerrainStore::open(folder_.path(), {});
  ASSERT_TRUE(store.has_value()) << store.error().message();
  EXPECT_NEAR((*store)->prepare({{36.5, -121.5}, 1000})->elevation_m({36.5, -121.0 - 1e-12}), 302, 1e-6)
      << "middle of the eastern column of the first cell";
}

struct Broken {
  const char* what;
  void (*spoil)(test::DedFile&);
  const char* message;
};
class BrokenDed : public Ded, public ::testing::WithParamInterface<Broken> {};

TEST_P(BrokenDed, IsRefusedWithTheReason) {
  test::DedFile file = three_cells();
  GetParam().spoil(file);
  const auto cells = ded_cells(file_of(file.bytes()));
  ASSERT_FALSE(cells.has_value());
  EXPECT_THAT(cells.error().message(), HasSubstr(GetParam().message));
  EXPECT_THAT(cells.error().message(), HasSubstr("AREA.DED"));
}

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kHuge = std::numeric_limits<float>::max();

INSTANTIATE_TEST_SUITE_P(
    DedReader, BrokenDed,
    ::testing::Values(
        Broken{"Magic", [](test::DedFile& file) { file.magic = "SSYT"; }, "SSYS"},
        Broken{"Part", [](test::DedFile& file) { file.part = "DFAD"; }, "DED1"},
        Broken{"HeaderLength", [](test::DedFile& file) { file.header_length = 129; }, "SSYS"},
        Broken{"NoCells", [](test::DedFile& file) { file.cell_count = 0; }, "1 to 64800 cells"},
        Broken{"HugeCount", [](test::DedFile& file) { file.cell_count = 0xFFFFFFFF; }, "1 to 64800 cells"},
        Broken{"CountBeyondTheFile", [](test::DedFile& file) { file.cell_count = 60000; }, "truncated"},
        Broken{"HalfADegree", [](test::DedFile& file) { file.cells[1].north = 36.5F; },
               "cell 2 from one whole degree to the next"},
        Broken{"OffTheGrid", [](test::DedFile& file) { file.cells[0].west = -121.9F, file.cells[0].east = -120.9F; },
               "whole degrees"},
        Broken{"NanCorner", [](test::DedFile& file) { file.cells[0].south = kNan; }, "whole degrees"},
        Broken{"HugeCorner", [](test::DedFile& file) { file.cells[0].south = kHuge; }, "whole degrees"},
        Broken{"NanSpacing", [](test::DedFile& file) { file.cells[2].spacing_north = kNan; }, "span one degree"},
        Broken{"ZeroSpacing", [](test::DedFile& file) { file.cells[2].spacing_east = 0; }, "span one degree"},
        Broken{"NanPosts", [](test::DedFile& file) { file.cells[2].posts_east = kNan; }, "span one degree"},
        Broken{"HugePosts", [](test::DedFile& file) { file.cells[2].posts_east = kHuge; }, "span one degree"},
        Broken{"HalfAPost", [](test::DedFile& file) { file.cells[2].posts_east = 2.5F; }, "span one degree"},
        Broken{"MorePostsThanBytes",
               [](test::DedFile& file) { file.cells[2].posts_north = 1201, file.cells[2].spacing_north = 30; },
               "truncated or damaged"},
        Broken{"BytesLeftOver", [](test::DedFile& file) { file.cells[1].posts.push_back(0); }, "damaged"}),
    [](const auto& information) { return std::string(information.param.what); });

TEST_F(Ded, RefusesEveryTruncation) {
  const std::vector<std::byte> complete = three_cells().bytes();
  for (std::ptrdiff_t length = 0; length < std::ssize(complete); ++length)
    EXPECT_FALSE(ded_cells(file_of({complete.begin(), complete.begin() + length})).has_value()) << "cut at " << length;
  EXPECT_TRUE(ded_cells(file_of(complete)).has_value());
}

TEST_F(Ded, NeverReadsBeyondARandomlyDamagedFile) {
  constexpr unsigned kSeed = 31;
  std::mt19937 random(kSeed);
  const std::vector<std::byte> complete = three_cells().bytes();
  for (int round = 0; round < 1000; ++round) {
    std::vector<std::byte> damaged = complete;
    for (int change = 0; change < 3; ++change) damaged[random() % 280] = static_cast<std::byte>(random());
    if (random() % 2 == 0) damaged.resize(random() % (damaged.size() + 1));
    const auto reading = read_ded(file_of(damaged), {36, -122});
    if (reading) {
      EXPECT_LE(reading->cell.rows(), 7201) << "seed " << kSeed << ", round " << round;
    }
  }
}

}  // namespace
}  // namespace yars::model::terrain

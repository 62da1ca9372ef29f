// Reader of HGT files in zip and gzip archives: names of entries, archive bombs, damaged archives, index.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zip.h>
#include <zlib.h>

#include "model/terrain/formats/hgt.hpp"
#include "model/terrain/store/cell_files.hpp"
#include "tests/model/terrain/formats/dted_builder.hpp"

namespace yars::model::terrain {
namespace {

using ::testing::HasSubstr;

constexpr std::size_t kSide = 1201;
constexpr CellCorner kPackedCorner{43, 7};

// The north-west post is 111 m, the rest 5 m.
std::vector<std::byte> hgt(std::size_t bytes = 2 * kSide * kSide) {
  std::vector<std::byte> file(bytes);
  for (std::size_t at = 1; at < file.size(); at += 2) file[at] = std::byte{5};
  if (bytes > 1) file[1] = std::byte{111};
  return file;
}

std::filesystem::path zipped(const test::TemporaryFolder& folder, const std::string& entry,
                             const std::vector<std::byte>& bytes) {
  const std::filesystem::path path = folder.path() / "N43E007.hgt.zip";
  int code = 0;
  zip_t* archive = zip_open(path.c_str(), ZIP_CREATE, &code);
  zip_file_add(archive, "readme.txt", zip_source_buffer(archive, "x", 1, 0), 0);
  zip_file_add(archive, entry.c_str(), zip_source_buffer(archive, bytes.data(), bytes.size(), 0), 0);
  EXPECT_EQ(zip_close(archive), 0);
  return path;
}

std::filesystem::path gzipped(const test::TemporaryFolder& folder, const std::vector<std::byte>& bytes) {
  const std::filesystem::path path = folder.path() / "N43E007.hgt.gz";
  gzFile file = gzopen(path.c_str(), "wb6");
  EXPECT_EQ(gzwrite(file, bytes.data(), static_cast<unsigned>(bytes.size())), static_cast<int>(bytes.size()));
  gzclose(file);
  return path;
}

// Error message of the reader, or "none".
std::string reason(const std::filesystem::path& path) {
  const auto reading = read_compressed_hgt(path, kPackedCorner);
  return reading ? "none" : reading.error().message();
}

void cut(const std::filesystem::path& path, std::uintmax_t bytes) {
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - bytes);
}

void flip_byte(const std::filesystem::path& path, std::size_t at) {
  std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
  file.seekg(static_cast<std::streamoff>(at));
  const char byte = static_cast<char>(file.get() ^ 0x55);
  file.seekp(static_cast<std::streamoff>(at));
  file.put(byte);
}

TEST(PackedHgt, ZipAndGzipAreRead) {
  const test::TemporaryFolder folder;
  for (const auto& path : {zipped(folder, "N43E007.hgt", hgt()), gzipped(folder, hgt())}) {
    EXPECT_EQ(compressed_hgt_grid(path, kPackedCorner).rows, 1201);
    const auto reading = read_compressed_hgt(path, kPackedCorner);
    ASSERT_TRUE(reading.has_value()) << reading.error().message();
    EXPECT_EQ(reading->cell.post(1200, 0), 111);
    EXPECT_EQ(reading->cell.post(0, 0), 5);
    EXPECT_EQ(reading->cell.rows(), 1201);
  }
}

TEST(PackedHgt, TheEntryMayLieInAFolder) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(reason(zipped(folder, "eurasia/n43e007.HGT", hgt())), "none");
}

TEST(PackedHgt, AnEntryOfAnotherNameIsRefused) {
  for (const char* name : {"N43E008.hgt", "cell.hgt", "\x1b[31mN43E008.hgt"}) {
    const test::TemporaryFolder folder;
    const auto zip = zipped(folder, name, hgt());
    EXPECT_THAT(reason(zip), ::testing::AllOf(HasSubstr("expected an entry N43E007.hgt"), HasSubstr(".hgt'")));
    EXPECT_THAT(reason(zip), ::testing::Not(HasSubstr("\x1b")));
    EXPECT_EQ(compressed_hgt_grid(zip, kPackedCorner).rows, 0);
  }
}

TEST(PackedHgt, AGzipWithTheNameOfAnotherCellIsRefused) {
  for (const auto& [name, expected] : {std::pair("N43E008.hgt", false), std::pair("n43e007.hgt", true)}) {
    const test::TemporaryFolder folder;
    const auto path = gzipped(folder, hgt());
    std::ifstream in(path, std::ios::binary);
    std::string bytes((std::istreambuf_iterator<char>(in)), {});
    bytes[3] = 8;  // RFC 1952, flag FNAME: a name follows the header
    bytes.insert(10, std::string(name) + '\0');
    std::ofstream(path, std::ios::binary) << bytes;
    EXPECT_EQ(reason(path) == "none", expected) << reason(path);
  }
}

TEST(PackedHgt, AnArchiveWithoutACellIsRefused) {
  const test::TemporaryFolder folder;
  EXPECT_THAT(reason(zipped(folder, "picture.jpg", hgt())), HasSubstr("an entry N43E007.hgt"));
}

TEST(PackedHgt, AnArchiveBombIsRefusedBeforeItIsUnpacked) {
  const test::TemporaryFolder folder;
  const auto big = hgt(60UL << 20U);
  const auto zip = zipped(folder, "N43E007.hgt", big);
  const auto gzip = gzipped(folder, big);
  EXPECT_LT(std::filesystem::file_size(zip), 1UL << 20U);
  EXPECT_THAT(reason(zip), HasSubstr("no HGT cell"));
  EXPECT_THAT(reason(gzip), HasSubstr("no HGT cell"));
  EXPECT_EQ(compressed_hgt_grid(zip, kPackedCorner).rows, 0);
  EXPECT_EQ(compressed_hgt_grid(gzip, kPackedCorner).rows, 0);
}

TEST(PackedHgt, TruncatedAndDamagedFilesAreRefused) {
  const test::TemporaryFolder folder;
  const auto zip = zipped(folder, "N43E007.hgt", hgt());
  const auto gzip = gzipped(folder, hgt());
  flip_byte(gzip, std::filesystem::file_size(gzip) - 6);
  EXPECT_THAT(reason(gzip), HasSubstr("gzip stream")) << "damaged checksum";
  cut(gzip, 100);
  EXPECT_THAT(reason(gzip), HasSubstr("gzip stream"));
  cut(zip, 30);
  EXPECT_THAT(reason(zip), HasSubstr("zip archive"));
  folder.write("N43E007.hgt.gz", {});
  EXPECT_NE(reason(folder.path() / "N43E007.hgt.gz"), "none");
  EXPECT_THAT(reason(folder.path() / "gone.hgt.zip"), HasSubstr("expected"));
}

// Archives of other names, and with several cells, as some producers pack a whole region.
TEST(PackedHgt, AnArchiveOfAnyNameGivesTheCellsOfItsEntries) {
  const test::TemporaryFolder folder;
  std::filesystem::rename(zipped(folder, "N43E007.SRTMGL3.hgt", hgt()), folder.path() / "N43E007hgt.zip");
  std::filesystem::rename(zipped(folder, "L32/N43E008.hgt", hgt()), folder.path() / "L32.zip");
  int code = 0;
  zip_t* archive = zip_open((folder.path() / "L32.zip").c_str(), 0, &code);
  const auto more = hgt();
  zip_file_add(archive, "L32/N44E008.hgt", zip_source_buffer(archive, more.data(), more.size(), 0), 0);
  zip_file_add(archive, "__MACOSX/._N45E008.hgt", zip_source_buffer(archive, "x", 1, 0), 0);
  ASSERT_EQ(zip_close(archive), 0);
  FileSentences found;
  const auto index = index_directory(folder.path(), &found);
  ASSERT_TRUE(index.has_value()) << index.error().message();
  EXPECT_THAT(found.problems, ::testing::IsEmpty());
  EXPECT_EQ(index->size(), 3U);
  for (const CellCorner corner : {CellCorner{43, 7}, CellCorner{43, 8}, CellCorner{44, 8}}) {
    ASSERT_TRUE(index->contains(slot_of(corner)));
    const auto reading = read_cell(index->at(slot_of(corner)), corner);
    ASSERT_TRUE(reading.has_value()) << reading.error().message();
    EXPECT_EQ(reading->cell.post(1200, 0), 111);
  }
}

TEST(PackedHgt, AnArchiveWithElevationOfAnotherFormIsReported) {
  const test::TemporaryFolder folder;
  folder.write("w122/n36.dt0", test::level_dted(36, -122, 5).bytes());
  std::filesystem::rename(zipped(folder, "n43_e007_1arc_v3.tif", hgt()), folder.path() / "tile.zip");
  std::filesystem::rename(zipped(folder, "cell.hgt", hgt()), folder.path() / "unplaced.zip");
  std::filesystem::rename(zipped(folder, "manual.pdf", hgt()), folder.path() / "x.zip");
  FileSentences found;
  ASSERT_TRUE(index_directory(folder.path(), &found).has_value());
  EXPECT_THAT(found.problems, ::testing::ElementsAre(HasSubstr("unpack the archive"), HasSubstr("'cell.hgt'")));
}

TEST(PackedHgt, TheIndexPrefersTheFinerSpacing) {
  const test::TemporaryFolder folder;
  zipped(folder, "N43E007.hgt", hgt());
  folder.write("e007/n43.dt0", test::level_dted(43, 7, 9).bytes());
  const auto index = index_directory(folder.path());
  ASSERT_TRUE(index.has_value());
  const CellFile& file = index->at(slot_of(kPackedCorner));
  EXPECT_EQ(file.format, CellFormat::compressed_hgt);
  const auto reading = read_cell(file, kPackedCorner, 2);
  ASSERT_TRUE(reading.has_value()) << reading.error().message();
  EXPECT_EQ(reading->cell.rows(), 301);
  ASSERT_TRUE(reading->peaks.has_value());
  EXPECT_EQ(reading->peaks->post(300, 0), 111);
  EXPECT_EQ(reading->cell.post(299, 1), 5);
}

}  // namespace
}  // namespace yars::model::terrain

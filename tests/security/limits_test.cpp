// The limits of docs/security.md: a file, text or packet just beyond a limit is an error. The reader reports the error
// before it allocates the memory.
#include <gmock/gmock.h>
#include <zip.h>
#include <zlib.h>

#include <cstring>
#include <sstream>
#include <vector>

#include "config/schema/load.hpp"
#include "config/schema/slot_text.hpp"
#include "flightmodel/bridges/bridge.hpp"
#include "flightmodel/bridges/bridge_source.hpp"
#include "lib/file/text_file.hpp"
#include "lib/imageio/png.hpp"
#include "model/scene/openflight/reader.hpp"
#include "model/terrain/formats/culture.hpp"
#include "model/terrain/formats/ded.hpp"
#include "model/terrain/formats/dted.hpp"
#include "model/terrain/formats/hgt.hpp"
#include "model/terrain/formats/pack.hpp"
#include "radar/recording/block.hpp"
#include "radar/recording/recording_io.hpp"
#include "tests/model/terrain/sampling/rough_cell.hpp"
#include "tests/security/folder.hpp"
#include "worldgen/scene/openflight_writer.hpp"

namespace yars {
namespace {

using namespace model;
using test::refusal_of;
using ::testing::HasSubstr;

constexpr terrain::CellCorner kCorner{36, -122};
constexpr std::uintmax_t kMebibyte = 1U << 20U;

class Limits : public test::SecureFolder {};

std::string repeated(const std::string& text, std::size_t times) {
  std::string all;
  all.reserve(text.size() * times);
  for (std::size_t i = 0; i < times; ++i) all += text;
  return all;
}

// ---- Texts ----

TEST_F(Limits, AConfigurationFileIsAtMostAMebibyteLong) {
  EXPECT_THAT(refusal_of(config::load_configuration(sparse("a.guf", kMebibyte + 1))),
              HasSubstr("at most 1048576 bytes"));
}

TEST_F(Limits, AConfigurationOfMessagesHasLimitsOfNestingAndWords) {
  EXPECT_THAT(refusal_of(config::load_configuration_text("Radar: " + repeated("{ ", 65), "a")), HasSubstr("64"));
  EXPECT_THAT(refusal_of(config::load_configuration_text("Radar: {" + repeated("1 ", 200'001) + "}", "a")),
              HasSubstr("200000"));
}

TEST_F(Limits, AConfigurationDefinesAtMostAThousandForms) {
  std::string forms;
  for (int i = 0; i < 1000; ++i) forms += "( def-form Mine" + std::to_string(i) + " is= Terrain )\n";
  EXPECT_TRUE(config::load_configuration_text(forms, "a"));
  forms += "( def-form Last is= Terrain )";
  EXPECT_THAT(refusal_of(config::load_configuration_text(forms, "a")), HasSubstr("at most 1000 forms defined"));
}

TEST_F(Limits, AConfigurationHasAtMost64Devices) {
  const std::string device = "( Device \"x\" :buttons `( ( Button \"button 1\" \"tdc press\" ) ) )";
  EXPECT_TRUE(config::load_configuration_text("( Devices `( " + repeated(device, 64) + " ) )", "a"));
  EXPECT_THAT(refusal_of(config::load_configuration_text("( Devices `( " + repeated(device, 65) + " ) )", "a")),
              HasSubstr("64"));
}

TEST_F(Limits, ATextIsAtMost256MebibytesLong) {
  EXPECT_THAT(refusal_of(file::read_text_file(sparse("long.csv", 256 * kMebibyte + 1))), HasSubstr("at most 256 MiB"));
}

TEST_F(Limits, ATextHasAtMostTenMillionLines) {
  std::string lines;
  lines.resize(10'000'000, '\n');
  EXPECT_TRUE(file::read_text_file(write("most.csv", lines)));
  lines.push_back('\n');
  EXPECT_THAT(refusal_of(file::read_text_file(write("more.csv", lines))), HasSubstr("at most 10 million lines"));
}

// The kernel writes /proc/self/maps while it is read, and states its size as 0. Opening a pipe does not wait for a
// writer.
TEST_F(Limits, ARegularFileIsReadUpToTheLimitWhateverItsStatedSize) {
  const auto grown = file::read_regular_file("/proc/self/maps", 1000);
  ASSERT_TRUE(grown);
  EXPECT_EQ(grown->size(), 1000U);
  EXPECT_EQ(file::read_regular_file(write("text", "12345"), 5), "12345");
  EXPECT_EQ(file::read_regular_file(write("text", "123456"), 5), "12345");
  EXPECT_FALSE(file::read_regular_file(fifo("pipe"), 1000));
  EXPECT_FALSE(file::read_regular_file(folder_, 1000));
}

// ---- Terrain ----

TEST_F(Limits, ADtedFileIsAtMostAsLongAsACellOfLevelTwo) {
  // [bytes] headers UHL, DSI and ACC; 3601 columns of 3601 posts; 8 labels of 80 bytes.
  constexpr std::uintmax_t kLongest = 80 + 648 + 2700 + 3601 * (12 + 2 * 3601) + 8 * 80;
  EXPECT_THAT(refusal_of(terrain::read_dted(sparse("n36.dt2", kLongest + 1), kCorner)), HasSubstr("at most"));
  EXPECT_THAT(refusal_of(terrain::read_dted(sparse("n37.dt2", kLongest), kCorner)),
              ::testing::Not(HasSubstr("at most")));
}

TEST_F(Limits, AnHgtFileIsAtMostAsLongAsACellOfOneArcSecond) {
  EXPECT_THAT(refusal_of(terrain::read_hgt(sparse("N36W122.hgt", 2UL * 3601 * 3601 + 1), kCorner)),
              HasSubstr("at most"));
}

TEST_F(Limits, ACompressedHgtFileIsAtMost64MebibytesLong) {
  for (const char* name : {"N36W122.hgt.zip", "N36W122.hgt.gz"})
    EXPECT_THAT(refusal_of(terrain::read_compressed_hgt(sparse(name, 64 * kMebibyte + 1), kCorner)),
                HasSubstr("at most 67108864 bytes"))
        << name;
}

// A file of less than 1 MiB unpacks to 64 MiB; the largest cell has 25,934,402 bytes.
TEST_F(Limits, AGzipThatUnpacksToMoreThanACellIsRefused) {
  const auto path = folder_ / "N36W122.hgt.gz";
  gzFile file = gzopen(path.c_str(), "wb9");
  const std::vector<char> zeros(kMebibyte);
  for (int i = 0; i < 64; ++i) ASSERT_GT(gzwrite(file, zeros.data(), static_cast<unsigned>(zeros.size())), 0);
  gzclose(file);
  ASSERT_LT(std::filesystem::file_size(path), kMebibyte);
  EXPECT_THAT(refusal_of(terrain::read_compressed_hgt(path, kCorner)), HasSubstr("at most 25934402 bytes unpacked"));
}

TEST_F(Limits, AZipThatStatesMoreThanACellIsRefused) {
  const auto path = folder_ / "N36W122.hgt.zip";
  const std::vector<char> zeros(64 * kMebibyte);
  int code = 0;
  zip_t* archive = zip_open(path.c_str(), ZIP_CREATE, &code);
  zip_file_add(archive, "N36W122.hgt", zip_source_buffer(archive, zeros.data(), zeros.size(), 0), 0);
  ASSERT_EQ(zip_close(archive), 0);
  EXPECT_THAT(refusal_of(terrain::read_compressed_hgt(path, kCorner)), HasSubstr("3601 x 3601 posts (25934402 bytes)"));
}

TEST_F(Limits, EachOfTheTwoFilesOfAPackIsAtMost256MebibytesLong) {
  write("w122/n36.jp2", "x");
  sparse("w122/n36.side", 256 * kMebibyte + 1);
  EXPECT_THAT(refusal_of(terrain::read_pack(folder_ / "w122/n36.jp2", kCorner, 0)), HasSubstr("at most 268435456"));
  sparse("w122/n37.jp2", 256 * kMebibyte + 1);
  EXPECT_THAT(refusal_of(terrain::read_pack(folder_ / "w122/n37.jp2", kCorner, 0)), HasSubstr("at most 268435456"));
}

// The side file states rows and columns at offsets 12 and 16, as big-endian 32-bit numbers.
TEST_F(Limits, APackHasAtMost7201PostsASide) {
  const auto packed = terrain::pack_cell(test::rough_cell(kCorner, 121, 121, 1));
  ASSERT_TRUE(packed) << packed.error().message();
  for (const std::size_t offset : {12U, 16U}) {
    const auto refusal_with = [&](unsigned posts) {
      std::vector<std::byte> side = packed->side;
      side[offset + 2] = static_cast<std::byte>(posts >> 8U);
      side[offset + 3] = static_cast<std::byte>(posts & 255U);
      return refusal_of(terrain::parse_pack(packed->jp2, side, "n36.jp2", kCorner, 0));
    };
    EXPECT_THAT(refusal_with(7202), HasSubstr("posts a side and 1 to 17 levels, found ")) << offset;
    EXPECT_THAT(refusal_with(7202), HasSubstr("7202"));
    EXPECT_THAT(refusal_with(7201), ::testing::Not(HasSubstr("posts a side and"))) << offset;
  }
}

std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (const unsigned shift : {24U, 16U, 8U, 0U}) bytes += static_cast<char>(value >> shift & 255U);
  return bytes;
}

TEST_F(Limits, ADedFileStatesAtMostTheNumberOfCellsOfTheEarth) {
  std::string front = big_endian(128) + "SSYSDED1V1.0";  // header record of 128 bytes
  front.resize(128, ' ');
  EXPECT_THAT(refusal_of(terrain::ded_cells(sparse("a.ded", kMebibyte, front + big_endian(0xffffffffU)))),
              HasSubstr("cells, found 4294967295"));
}

TEST_F(Limits, ACultureMapIsAtMost10801PostsASide) {
  // The reader takes the size from the header of the PNG file and stops there.
  const auto path = folder_ / "n36.smc.png";
  ASSERT_TRUE(imageio::write_indexed_png(path, {2, 10'802, std::vector<std::uint8_t>(2UL * 10'802), {{0, 0, 0}}}));
  EXPECT_THAT(refusal_of(terrain::read_culture(path, kCorner)), HasSubstr("at most 10801 pixels a side"));
}

// ---- Scenes ----

TEST_F(Limits, ASceneFileIsAtMostAGibibyteLong) {
  EXPECT_THAT(refusal_of(scene::read_openflight(sparse("a.flt", 1024 * kMebibyte + 1))),
              HasSubstr("at most 1073741824"));
}

std::string external_file(const std::string& name) {
  worldgen::OpenFlightWriter writer(std::nullopt);
  writer.external(name, {});
  const auto bytes = writer.take();
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST_F(Limits, ExternalReferencesOfAnOpenFlightFileAreAtMostSixteenDeep) {
  for (int i = 0; i < 20; ++i) write(std::to_string(i) + ".flt", external_file(std::to_string(i + 1) + ".flt"));
  EXPECT_THAT(refusal_of(scene::read_openflight(folder_ / "0.flt")), HasSubstr("at most 16 deep"));
  EXPECT_TRUE(scene::read_openflight(folder_ / "6.flt"));
}

TEST_F(Limits, ASceneHasAtMost4096Files) {
  worldgen::OpenFlightWriter writer(std::nullopt);
  for (int i = 0; i < 4097; ++i) {
    const std::string name = "part" + std::to_string(i) + ".flt";
    writer.external(name, {});
    write(name, external_file(""));
  }
  const auto bytes = writer.take();
  const auto path = write("all.flt", {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  EXPECT_THAT(refusal_of(scene::read_openflight(path)), HasSubstr("at most 4096 files"));
}

// ---- Recordings ----

// Begin of a recording whose header states `configuration_bytes` of text.
std::string recording_with(std::uint32_t configuration_bytes) {
  std::string bytes = "YARSTLOG";
  for (const std::uint32_t word : {3U, 0U, configuration_bytes, 0U})
    bytes.append(reinterpret_cast<const char*>(&word), sizeof word);
  return bytes;
}

TEST_F(Limits, ARecordingsHeaderHoldsAtMost64KibibytesOfText) {
  EXPECT_THAT(refusal_of(recording::RecordingReader::open(write("a.yars", recording_with(65'537)))),
              HasSubstr("longer paths"));
  EXPECT_THAT(refusal_of(recording::RecordingReader::open(write("b.yars", recording_with(65'536)))),
              HasSubstr("cut short"));
}

TEST_F(Limits, ABlockOfARecordingIsAtMostEightMebibytesAnd16384Items) {
  using namespace recording;
  BlockHead head{};
  head.content = BlockContent::items;
  const auto sound = [](const BlockHead& claimed) {
    const auto bytes = block_bytes(claimed, {});
    BlockHead written{};
    std::memcpy(&written, bytes.data(), sizeof written);
    return is_sound(written);
  };
  head.raw_bytes = kMaxBlockBytes;
  head.items = kMaxBlockItems;
  EXPECT_TRUE(sound(head));
  ++head.raw_bytes;
  EXPECT_FALSE(sound(head));
  head.raw_bytes = 0;
  ++head.items;
  EXPECT_FALSE(sound(head));
}

// ---- Packets ----

TEST_F(Limits, DatagramsLongerThan16384BytesAreRefused) {
  const std::vector<std::byte> longest(16'385);
  EXPECT_FALSE(flightmodel::bridges::decode_flightgear(longest));
  flightmodel::bridges::JsbsimBridge jsbsim;
  EXPECT_FALSE(jsbsim.receive(longest, {}));
}

}  // namespace
}  // namespace yars

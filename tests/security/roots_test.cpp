// No reader opens a file outside of the folder that a user names. Pipes, devices and folders in the place of a file are
// errors and do not hang a reader.
#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <array>
#include <functional>

#include "config/schema/load.hpp"
#include "lib/file/text_file.hpp"
#include "lib/imageio/png.hpp"
#include "model/scene/index/scene_index.hpp"
#include "model/scene/openflight/reader.hpp"
#include "model/terrain/formats/culture.hpp"
#include "model/terrain/formats/ded.hpp"
#include "model/terrain/formats/dted.hpp"
#include "model/terrain/formats/hgt.hpp"
#include "model/terrain/formats/pack.hpp"
#include "model/terrain/gdal/raster.hpp"
#include "model/terrain/store/cell_files.hpp"
#include "radar/recording/recording_io.hpp"
#include "tests/security/folder.hpp"
#include "worldgen/scene/openflight_writer.hpp"

namespace yars {
namespace {

using namespace model;
using test::refusal_of;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr terrain::CellCorner kRootCorner{36, -122};

struct PathReader {
  const char* name;  // file name that the reader accepts
  std::string (*refusal)(const std::filesystem::path&);
};

// The functions that open a file by its path.
const std::vector<PathReader>& readers() {
  static const std::vector<PathReader> all{
      {"radar.guf", [](const auto& path) { return refusal_of(config::load_configuration(path)); }},
      {"flight.route", [](const auto& path) { return refusal_of(file::read_text_file(path)); }},
      {"flight.yars", [](const auto& path) { return refusal_of(recording::RecordingReader::open(path)); }},
      {"picture.png", [](const auto& path) { return refusal_of(imageio::read_indexed_png(path, 100)); }},
      {"n36.smc.png", [](const auto& path) { return refusal_of(terrain::read_culture(path, kRootCorner)); }},
      {"w122/n36.dt1", [](const auto& path) { return refusal_of(terrain::read_dted(path, kRootCorner)); }},
      {"N36W122.hgt", [](const auto& path) { return refusal_of(terrain::read_hgt(path, kRootCorner)); }},
      {"N36W122.hgt.zip", [](const auto& path) { return refusal_of(terrain::read_compressed_hgt(path, kRootCorner)); }},
      {"N36W122.hgt.gz", [](const auto& path) { return refusal_of(terrain::read_compressed_hgt(path, kRootCorner)); }},
      {"w122/n36.jp2", [](const auto& path) { return refusal_of(terrain::read_pack(path, kRootCorner, 0)); }},
      {"N36W122.ded", [](const auto& path) { return refusal_of(terrain::read_ded(path, kRootCorner)); }},
      {"heights.tif", [](const auto& path) { return refusal_of(terrain::gdal::describe_raster(path)); }},
      {"scene.flt", [](const auto& path) { return refusal_of(scene::read_openflight(path)); }},
      {"scene.flt", [](const auto& path) { return refusal_of(scene::read_openflight_header(path)); }},
  };
  return all;
}

class Roots : public test::SecureFolder {};

TEST_F(Roots, APipeHangsNoReader) {
  int number = 0;
  for (const PathReader& reader : readers()) {
    const auto pipe = fifo(std::to_string(number++) + "/" + reader.name);
    EXPECT_THAT(reader.refusal(pipe), HasSubstr(": expected ")) << reader.name;
  }
}

TEST_F(Roots, AnEndlessDeviceIsRefused) {
  for (const PathReader& reader : readers())
    EXPECT_THAT(reader.refusal(
                    link("zero/" + std::string(reader.name) + std::to_string(&reader - readers().data()), "/dev/zero")),
                HasSubstr(": expected "))
        << reader.name;
}

TEST_F(Roots, AFolderInThePlaceOfAFileIsRefused) {
  for (const PathReader& reader : readers()) {
    const auto folder = folder_ / reader.name;
    std::filesystem::create_directories(folder);
    EXPECT_THAT(reader.refusal(folder), HasSubstr(": expected ")) << reader.name;
  }
}

TEST_F(Roots, APipeAsTheSideFileOfAPackIsRefused) {
  write("w122/n36.jp2", "any");
  fifo("w122/n36.side");
  EXPECT_THAT(refusal_of(terrain::read_pack(folder_ / "w122/n36.jp2", kRootCorner, 0)),
              HasSubstr("not a regular file"));
}

// ---- Files that a configuration includes ----

TEST_F(Roots, AnIncludeByAnAbsolutePathIsRefused) {
  const auto secret = write("secret.guf", "( Apg70 )");
  const auto path = write("inside/a.guf", "( include \"" + secret.string() + "\" )");
  EXPECT_THAT(refusal_of(config::load_configuration(path)), HasSubstr("expected an include inside "));
}

TEST_F(Roots, AnIncludeOfAPipeIsRefused) {
  fifo("pipe.guf");
  const auto path = write("a.guf", "( include \"pipe.guf\" )");
  EXPECT_THAT(refusal_of(config::load_configuration(path)), HasSubstr("found something else"));
}

// ---- Files that a scene refers to ----

std::string bytes_of(worldgen::OpenFlightWriter writer) {
  const std::vector<std::byte> bytes = writer.take();
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string scene_that_refers_to(const std::string& file) {
  worldgen::OpenFlightWriter writer(std::nullopt);
  writer.external(file, {});
  return bytes_of(std::move(writer));
}

class SceneRoots : public Roots {
 protected:
  // Reads a scene with one external reference, which must not be read; returns what is left out.
  std::vector<std::string> left_out_of(const std::string& reference) const {
    const auto model = scene::read_openflight(write(kScene + "first.flt", scene_that_refers_to(reference)));
    EXPECT_TRUE(model) << model.error().message();
    if (!model) return {};
    EXPECT_THAT(model->files, IsEmpty());
    return model->left_out;
  }
  const std::string kScene = "root/a/b/scene/";  // scene::external_root() is root
  const std::filesystem::path outside_ = write("outside.flt", scene_that_refers_to("nowhere.flt"));
};

TEST_F(SceneRoots, AReferenceByAnAbsolutePathIsLeftOut) {
  EXPECT_THAT(left_out_of(outside_.string()), ElementsAre(HasSubstr("outside the folder")));
}

TEST_F(SceneRoots, AReferenceUpwardsOutOfTheRootIsLeftOut) {
  EXPECT_THAT(left_out_of("../../../../outside.flt"), ElementsAre(HasSubstr("outside the folder")));
  EXPECT_THAT(left_out_of("..\\..\\..\\..\\outside.flt"), ElementsAre(HasSubstr("outside the folder")));
}

TEST_F(SceneRoots, AReferenceThroughALinkOutOfTheRootIsLeftOut) {
  link(kScene + "inner.flt", outside_);
  EXPECT_THAT(left_out_of("inner.flt"), ElementsAre(HasSubstr("outside the folder")));
  link(kScene + "folder", folder_);
  EXPECT_THAT(left_out_of("folder/outside.flt"), ElementsAre(HasSubstr("outside the folder")));
}

TEST_F(SceneRoots, AReferenceToAPipeOrADeviceIsLeftOut) {
  fifo(kScene + "pipe.flt");
  EXPECT_THAT(left_out_of("pipe.flt"), ElementsAre(HasSubstr("is not there")));
  EXPECT_THAT(left_out_of("/dev/zero"), ElementsAre(HasSubstr("outside the folder")));
}

TEST_F(SceneRoots, ALinkOutOfAFolderOfScenesIsReportedAndOtherScenesAreUsed) {
  write("scenes/N36_0_0W122_0_0.flt", scene_that_refers_to("nowhere.flt"));
  link("scenes/N37_0_0W122_0_0.flt", outside_);
  std::vector<std::string> problems;
  radar::Scene folder;
  folder.file = (folder_ / "scenes").string();
  const auto index = scene::index_scenes({folder}, problems);
  ASSERT_TRUE(index) << index.error().message();
  EXPECT_EQ(index->size(), 1U);
  EXPECT_THAT(problems, ElementsAre(HasSubstr("a link that leads out")));
}

// ---- Files in a directory of terrain ----

class TerrainRoots : public Roots {
 protected:
  terrain::DirectoryIndex index() {
    auto found = terrain::index_directory(folder_ / "terrain", &sentences_);
    EXPECT_TRUE(found) << found.error().message();
    return found ? *found : terrain::DirectoryIndex{};
  }
  terrain::FileSentences sentences_;
  const std::vector<std::string>& problems_ = sentences_.problems;
};

TEST_F(TerrainRoots, ACellThatIsALinkOutOfTheDirectoryIsReportedAndOtherCellsAreUsed) {
  write("terrain/w122/n36.dt1", "a cell");
  link("terrain/w122/n37.dt1", write("elsewhere.dt1", "secret"));
  link("terrain/N38W122.hgt", "/etc/passwd");
  link("terrain/any.ded", "/etc/passwd");
  EXPECT_EQ(index().size(), 1U);
  EXPECT_EQ(problems_.size(), 3U);
  EXPECT_THAT(problems_, ::testing::Each(HasSubstr("a link that leads out")));
}

TEST_F(TerrainRoots, ALinkToAnotherCellOfTheDirectoryIsFollowed) {
  const auto cell = write("terrain/w122/n36.dt1", "a cell");
  link("terrain/w123/n36.dt1", cell);
  EXPECT_EQ(index().size(), 2U);
  EXPECT_THAT(problems_, IsEmpty());
}

TEST_F(TerrainRoots, AFolderThatIsALinkIsNotEntered) {
  write("terrain/w122/n36.dt1", "a cell");
  write("elsewhere/w123/n36.dt1", "secret");
  std::filesystem::create_directory_symlink(folder_ / "elsewhere", folder_ / "terrain/elsewhere");
  EXPECT_EQ(index().size(), 1U);
}

TEST_F(TerrainRoots, ALinkOutAsASideFileOrAsCultureIsReported) {
  write("terrain/w122/n36.dt1", "a cell");
  write("terrain/w122/n37.jp2", "a pack");
  write("terrain/w122/n38.dt1", "a cell");
  write("terrain/w122/n39.dt1", "a cell");
  link("terrain/w122/n37.side", "/etc/passwd");
  link("terrain/w122/n38.smc.png", "/etc/passwd");
  link("terrain/w122/N39.SMC.PNG", "/etc/passwd");
  EXPECT_EQ(index().size(), 1U);
  EXPECT_EQ(problems_.size(), 3U);
}

TEST_F(TerrainRoots, PipesUnderTheNamesOfCellsDoNotHangTheIndex) {
  write("terrain/w122/n36.dt1", "a cell");
  for (const char* name : {"w122/n37.dt1", "w122/n38.jp2", "N39W122.hgt", "N40W122.hgt.gz", "N41W122.hgt.zip",
                           "any.ded", "any.dt1", "any.zip", "any.gz", "N42W122.7z", "w122/n43.smc.png"})
    fifo(std::string("terrain/") + name);
  EXPECT_THAT(index(), ::testing::SizeIs(::testing::Ge(1U)));
}

}  // namespace
}  // namespace yars

// The reader: external files of a scene, how they are found, and their nodes.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "model/scene/openflight/model.hpp"
#include "model/scene/openflight/reader.hpp"
#include "tests/model/scene/openflight/every_record.hpp"
#include "tests/model/scene/openflight/read_bytes.hpp"

namespace yars::model::scene {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
namespace fs = std::filesystem;

TEST(ExternalFiles, AreReadInTheirOwnUnitsAndTransformed) {
  const Folder folder;
  ByteFile child(1600, 4);  // feet
  child.palette(kSquare);
  child.push();
  child.polygon({0, 1, 2, 3}, 9);
  child.pop();
  folder.write("parts/child.flt", child.bytes());
  worldgen::OpenFlightWriter parent(std::nullopt);
  parent.external("parts\\child.flt", translation({100, 0, 0}));
  parent.external("./parts/../parts/child.flt", translation({200, 0, 0}));
  const auto model = read_openflight(folder.write("parent.flt", parent.take()));
  ASSERT_TRUE(model) << model.error().message();
  EXPECT_EQ(model->polygons, 2U);
  EXPECT_EQ(model->files.size(), 1U);
  EXPECT_EQ(model->counts.external_references, 2U);
  EXPECT_NEAR(position_of(*model, 1).x, 103.048, 1e-4);
  EXPECT_NEAR(position_of(*model, 4).x, 200, 1e-4);
}

TEST(ExternalFiles, ThatReferToTheirParentAreLeftOut) {
  const Folder folder;
  worldgen::OpenFlightWriter a(std::nullopt), b(std::nullopt);
  a.face(square(0, 0, 1), kTestKind);
  a.external("b.flt", {});
  b.face(square(0, 0, 1), kTestKind);
  b.external("a.flt", {});
  const auto first = folder.write("a.flt", a.take());
  folder.write("b.flt", b.take());
  const auto model = read_openflight(first);
  ASSERT_TRUE(model);
  EXPECT_EQ(model->polygons, 2U);
  EXPECT_THAT(model->left_out, ElementsAre(HasSubstr("leads back to itself")));
}

// A square with this surface material, by which it is known again.
std::vector<std::byte> leaf(std::int16_t material = 1) {
  ByteFile file;
  file.palette(kSquare);
  file.push();
  file.polygon({0, 1, 2, 3}, material);
  file.pop();
  return file.bytes();
}

std::vector<std::byte> master(const std::string& reference) {
  ByteFile file;
  file.push();
  file.external(reference);
  file.pop();
  return file.bytes();
}

// A folder for the scene, deep enough that files above it are outside of its root.
class External : public testing::Test {
 protected:
  fs::path scene(const std::string& reference) const { return folder_.write(kScene + "master.flt", master(reference)); }
  // The model of a scene with this reference.
  Model model_of(const std::string& reference) const {
    const auto model = read_openflight(scene(reference));
    EXPECT_TRUE(model) << model.error().message();
    return model ? *model : Model{};
  }
  std::string left_out_of(const std::string& reference) const {
    const Model model = model_of(reference);
    EXPECT_THAT(model.triangles, IsEmpty()) << reference;
    EXPECT_EQ(model.left_out.size(), 1U) << reference;
    return model.left_out.empty() ? "" : model.left_out.front();
  }
  const std::string kRoot = "user/", kScene = "user/a/b/master/";
  const Folder folder_;
};

TEST_F(External, AFileInAnotherFolderUpToThreeLevelsAboveIsRead) {
  for (const char* place : {"a/b/common/x.flt", "a/x.flt", "lib/deep/x.flt"}) {
    const fs::path file = folder_.write(kRoot + place, leaf());
    const std::string reference = fs::relative(file, folder_.path() / kScene).string();
    const Model model = model_of(reference);
    EXPECT_EQ(model.polygons, 1U) << reference;
    EXPECT_THAT(model.files, ElementsAre(fs::canonical(file).string()));
    EXPECT_THAT(model.warnings, IsEmpty());
    EXPECT_THAT(model.left_out, IsEmpty());
  }
}

TEST_F(External, AFileOutsideTheRootIsLeftOut) {
  folder_.write("secret/x.flt", leaf());
  folder_.write(kRoot + "x.flt", leaf());
  EXPECT_THAT(left_out_of("../../../../secret/x.flt"),
              HasSubstr("lies outside the folder " + fs::canonical(folder_.path() / "user").string()));
  EXPECT_THAT(left_out_of((folder_.path() / "secret/x.flt").string()), HasSubstr("lies outside the folder"));
  fs::create_symlink(folder_.path() / "secret/x.flt", folder_.path() / kScene / "link.flt");
  EXPECT_THAT(left_out_of("link.flt"), HasSubstr("lies outside the folder"));
  fs::create_directory_symlink(folder_.path() / "secret", folder_.path() / kRoot / "link");
  EXPECT_THAT(left_out_of("../../../link/x.flt"), HasSubstr("lies outside the folder"));
}

TEST_F(External, OutsideTheFolderOfTheSceneOnlyFilesOfOpenFlightAreRead) {
  folder_.write(kRoot + "a/private.txt", leaf());
  EXPECT_THAT(left_out_of("../../private.txt"), HasSubstr("is not there"));
  folder_.write(kScene + "part.of", leaf());
  EXPECT_EQ(model_of("part.of").polygons, 1U);
}

TEST_F(External, AMissingFileIsLeftOut) {
  EXPECT_THAT(left_out_of("nowhere.flt"), HasSubstr("external file nowhere.flt is not there; it is left out"));
  EXPECT_THAT(left_out_of(""), HasSubstr("has no usable name"));
  EXPECT_THAT(left_out_of("parts/"), HasSubstr("has no usable name"));
}

// A message has the path that the user gave, and that of the external file behind it.
TEST_F(External, AMessageNamesTheSceneAndTheExternalFile) {
  folder_.write(kScene + "broken.flt", std::vector<std::byte>(10));
  const fs::path link = folder_.path() / kScene / "link.flt";
  fs::create_symlink(scene("broken.flt"), link);
  const auto broken = read_openflight(link);
  ASSERT_FALSE(broken);
  EXPECT_THAT(broken.error().message(), testing::StartsWith(link.string() + ": external file "));
  EXPECT_THAT(broken.error().message(), HasSubstr("broken.flt: expected"));
  const fs::path circle = folder_.path() / kScene / "circle.flt";
  fs::create_symlink("circle.flt", circle);
  const auto circular = read_openflight(circle);
  ASSERT_FALSE(circular);
  EXPECT_THAT(circular.error().message(), testing::StartsWith(circle.string() + ": expected"));
}

// Paths of the machine on which the scene was made.
TEST_F(External, APathOfAnotherMachineIsFoundByItsLastFoldersAndName) {
  const std::vector<std::string> references{"C:\\models\\town\\x.flt",   "c:x.flt",
                                            "/srv/maker/town/x.flt",     "\\\\server\\share\\town\\x.flt",
                                            "../../../../../town/x.flt", "old/town/x.flt"};
  const auto beside = folder_.write(kScene + "x.flt", leaf());
  for (const std::string& reference : references) {
    const Model model = model_of(reference);
    EXPECT_EQ(model.polygons, 1U) << reference;
    EXPECT_THAT(model.files, ElementsAre(fs::canonical(beside).string()));
    EXPECT_THAT(model.warnings, ElementsAre(HasSubstr("x.flt is not there; " + fs::canonical(beside).string())));
    EXPECT_THAT(model.left_out, IsEmpty());
  }
  // The longest part of the path counts: town/x.flt before x.flt, in folders above too.
  const auto above = folder_.write(kRoot + "a/town/x.flt", leaf());
  for (const std::string& reference : references)
    if (reference != "c:x.flt") {
      EXPECT_THAT(model_of(reference).files, ElementsAre(fs::canonical(above).string())) << reference;
    }
  // A bare name is not looked for above.
  fs::remove(beside);
  EXPECT_THAT(left_out_of("c:a.flt"), HasSubstr("is not there"));
}

TEST_F(External, AnAbsolutePathInsideTheRootIsRead) {
  const auto file = folder_.write(kRoot + "lib/x.flt", leaf());
  const Model model = model_of(file.string());
  EXPECT_EQ(model.polygons, 1U);
  EXPECT_THAT(model.warnings, IsEmpty());
}

TEST_F(External, NamesDifferByCaseOnlyIfNothingElseIsThere) {
  folder_.write(kScene + "Parts/House.FLT", leaf(1));
  for (const char* reference : {"PARTS\\house.flt", ".\\parts\\..\\Parts\\HOUSE.flt", "../MASTER/parts/house.flt"})
    EXPECT_EQ(model_of(reference).polygons, 1U) << reference;
  folder_.write(kScene + "Parts/house.flt", leaf(2));
  const Model model = model_of("Parts/house.flt");
  ASSERT_EQ(model.kinds.size(), 1U);
  EXPECT_EQ(model.kinds[0].material, 2);
}

TEST_F(External, ANameBeyondAsciiIsRead) {
  folder_.write(kScene + "Häuser.flt", leaf());
  EXPECT_EQ(model_of("Häuser.flt").polygons, 1U);
}

TEST_F(External, AReferenceOfAReferenceBeginsAtItsOwnFolderThenAtThatOfTheFirstFile) {
  folder_.write(kRoot + "a/b/common/middle.flt", master("own.flt"));
  folder_.write(kRoot + "a/b/common/own.flt", leaf());
  EXPECT_EQ(model_of("../common/middle.flt").polygons, 1U);
  folder_.write(kScene + "models/middle.flt", master("models/leaf.flt"));
  folder_.write(kScene + "models/leaf.flt", leaf());
  const Model model = model_of("models/middle.flt");
  EXPECT_EQ(model.polygons, 1U);
  EXPECT_THAT(model.warnings, IsEmpty());
}

// Two groups under one that is moved: a house of one square that is moved itself, and a tower of two squares.
std::vector<std::byte> library() {
  ByteFile file;
  file.palette(kSquare);
  file.push();
  file.group("show");
  file.matrix(translation({1000, 0, 0}));
  file.push();
  file.group("house");
  file.matrix(translation({5, 0, 0}));
  file.square_below();
  file.group("tower");
  file.push();
  file.polygon({0, 1, 2, 3}, 2);
  file.polygon({0, 1, 2, 3}, 3);
  file.pop();
  file.pop();
  file.pop();
  return file.bytes();
}

TEST_F(External, ANodeOfAFileIsShownAloneWithItsOwnTransform) {
  folder_.write(kScene + "lib.flt", library());
  EXPECT_EQ(model_of("lib.flt").polygons, 3U);
  const Model house = model_of("lib.flt<house>");
  EXPECT_EQ(house.polygons, 1U);
  EXPECT_NEAR(position_of(house, 0).x, 5, 1e-5);
  EXPECT_EQ(model_of("C:\\lib\\lib.flt<tower>").polygons, 2U);
  EXPECT_EQ(model_of("lib.flt<>").polygons, 3U);
  EXPECT_THAT(left_out_of("lib.flt<barn>"), HasSubstr("names a node that "));
}

TEST_F(External, NodesOfOneFileCountAsOneFile) {
  folder_.write(kScene + "lib.flt", library());
  ByteFile file;
  file.push();
  for (const char* reference : {"lib.flt<house>", "lib.flt<tower>", "lib.flt<house>", "lib.flt"})
    file.external(reference);
  file.pop();
  const auto model = read_openflight(folder_.write(kScene + "master.flt", file.bytes()));
  ASSERT_TRUE(model) << model.error().message();
  EXPECT_EQ(model->polygons, 1U + 2U + 1U + 3U);
  EXPECT_EQ(model->counts.faces, 3U);
  EXPECT_EQ(model->files.size(), 1U);
}

TEST_F(External, RemarksOnAnExternalFileAreThoseOfTheScene) {
  ByteFile file;
  file.palette(kSquare);
  file.push();
  file.polygon({0, 1, 2, 3}, 99);
  file.pop();
  file.bytes().resize(file.bytes().size() + 9);
  const auto part = folder_.write(kScene + "part.flt", file.bytes());
  const Model model = model_of("part.flt");
  EXPECT_THAT(model.left_out, ElementsAre(HasSubstr(fs::canonical(part).string() + ": faces with a surface material")));
  EXPECT_THAT(model.warnings, ElementsAre(HasSubstr("bytes after the last record: 9")));
}

TEST_F(External, TooManyNamesAreRefused) {
  ByteFile file;
  file.push();
  for (std::size_t i = 0; i <= kMaxNames; ++i) file.external(std::to_string(i));
  file.pop();
  const auto model = read_openflight(folder_.write(kScene + "master.flt", file.bytes()));
  ASSERT_FALSE(model);
  EXPECT_THAT(model.error().message(), HasSubstr("at most 65536 different external references"));
}

TEST(ExternalRoot, IsThreeFoldersAboveButNotTheRootOfTheFileSystem) {
  EXPECT_EQ(external_root("/a/b/c/d/e"), "/a/b");
  EXPECT_EQ(external_root("/a/b"), "/a");
  EXPECT_EQ(external_root("/a"), "/a");
  EXPECT_EQ(external_root("/"), "/");
}

}  // namespace
}  // namespace yars::model::scene

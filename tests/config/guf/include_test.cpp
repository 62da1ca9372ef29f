// Tests of ( include "file" ) in GUF: where it may stand, which files it may name, its limits and its errors.
#include <gmock/gmock.h>

#include "lib/file/text_file.hpp"
#include "tests/config/support.hpp"

namespace yars::config {
namespace {

using ::testing::ElementsAre;
using testing::Folder;
using ::testing::HasSubstr;

std::string refusal_of(const std::filesystem::path& path) {
  const auto configuration = load_configuration(path);
  EXPECT_FALSE(configuration);
  return configuration ? std::string() : configuration.error().message();
}

std::vector<double> ranges_of(const std::filesystem::path& path) {
  const auto configuration = load_configuration(path);
  EXPECT_TRUE(configuration) << configuration.error().message();
  return configuration ? configuration->radar.ranges_nm : std::vector<double>{};
}

TEST(Include, InsertsFormsAtTheTopLevel) {
  const Folder folder;
  folder.write("part.guf", "( Apg70 :ranges `( 1 2 ) )");
  EXPECT_THAT(ranges_of(folder.write("a.guf", "( include \"part.guf\" )")), ElementsAre(1, 2));
}

TEST(Include, LaterSlotsOverrideIncludedSlots) {
  const Folder folder;
  folder.write("part.guf", "( Apg70 :ranges `( 1 2 ) :name \"part\" )");
  const auto path = folder.write("a.guf", "( include \"part.guf\" )\n( Apg70 :ranges `( 3 4 ) )");
  const auto configuration = load_configuration(path);
  ASSERT_TRUE(configuration) << configuration.error().message();
  EXPECT_THAT(configuration->radar.ranges_nm, ElementsAre(3, 4));
  EXPECT_EQ(configuration->radar.name, "part");
}

TEST(Include, InsertsSlotsIntoAForm) {
  const Folder folder;
  folder.write("slots.guf", ":ranges `( 5 6 )\n:name \"included\"");
  EXPECT_THAT(ranges_of(folder.write("a.guf", "( Apg70 ( include \"slots.guf\" ) )")), ElementsAre(5, 6));
}

TEST(Include, InsertsTheValueOfASlot) {
  const Folder folder;
  folder.write("list.guf", "`( 7 8 )");
  EXPECT_THAT(ranges_of(folder.write("a.guf", "( Apg70 :ranges ( include \"list.guf\" ) )")), ElementsAre(7, 8));
}

TEST(Include, InsertsItemsIntoAList) {
  const Folder folder;
  folder.write("items.guf", "8 9");
  EXPECT_THAT(ranges_of(folder.write("a.guf", "( Apg70 :ranges `( 7 ( include \"items.guf\" ) 10 ) )")),
              ElementsAre(7, 8, 9, 10));
}

TEST(Include, PathsAreRelativeToTheIncludingFile) {
  const Folder folder;
  folder.write("parts/ranges.guf", "`( 1 2 )");
  folder.write("parts/radar.guf", "( Apg70 :ranges ( include \"ranges.guf\" ) )");
  EXPECT_THAT(ranges_of(folder.write("a.guf", "( include \"parts/radar.guf\" )")), ElementsAre(1, 2));
}

TEST(Include, MayNameAParentFolderWithinTheFolderOfTheFirstFile) {
  const Folder folder;
  folder.write("ranges.guf", "`( 1 2 )");
  folder.write("parts/radar.guf", "( Apg70 :ranges ( include \"../ranges.guf\" ) )");
  EXPECT_THAT(ranges_of(folder.write("a.guf", "( include \"parts/radar.guf\" )")), ElementsAre(1, 2));
}

TEST(Include, NeverLeavesTheFolderOfTheFirstFile) {
  const Folder folder;
  folder.write("secret.guf", "1");
  const auto path = folder.write("inside/a.guf", "\n ( include \"../secret.guf\" )");
  EXPECT_THAT(refusal_of(path), HasSubstr("a.guf:2:2: expected an include inside "));
}

TEST(Include, FollowsNoSymbolicLinkOutOfTheFolder) {
  const Folder folder;
  const auto target = folder.write("secret.guf", "1");
  const auto path = folder.write("inside/a.guf", "( include \"link.guf\" )");
  std::filesystem::create_symlink(target, folder.path() / "inside/link.guf");
  EXPECT_THAT(refusal_of(path), HasSubstr("expected an include inside "));
}

TEST(Include, ByANameAloneMeansTheFileThatCameWithYarsWhereNoneIsBeside) {
  const auto shipped = load_configuration(file::installed_folder() / "apg68.guf");
  ASSERT_TRUE(shipped) << shipped.error().message();
  const Folder folder;
  const auto path = folder.write("deep/a.guf", "( include \"apg68.guf\" )\n( Apg70 :name \"my own\" )");
  const auto own = load_configuration(path);
  ASSERT_TRUE(own) << own.error().message();
  EXPECT_EQ(own->radar.name, "my own");
  EXPECT_EQ(own->radar.ranges_nm, shipped->radar.ranges_nm);
  folder.write("deep/apg68.guf", "( Apg70 :ranges `( 1 2 ) )");
  EXPECT_THAT(ranges_of(path), ElementsAre(1, 2));
}

TEST(Include, OfAMissingFileIsAnsweredWithTheNearestName) {
  const Folder folder;
  const auto path = folder.write("a.guf", "( include \"apg86.guf\" )");
  EXPECT_THAT(refusal_of(path), HasSubstr("found none at "));
  EXPECT_THAT(refusal_of(path), HasSubstr("did you mean 'apg68.guf'?"));
  // A path relative to the current folder leads to the same answer.
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  EXPECT_THAT(refusal_of("a.guf"), HasSubstr("did you mean 'apg68.guf'?"));
  std::filesystem::current_path(before);
}

TEST(Include, WithAFolderNeverMeansAFileThatCameWithYars) {
  const Folder folder;
  EXPECT_THAT(refusal_of(folder.write("a.guf", "( include \"./apg68.guf\" )")),
              HasSubstr("a.guf:1:1: expected a GUF file"));
}

TEST(Include, RefusesACycleOfFiles) {
  const Folder folder;
  folder.write("b.guf", "( include \"a.guf\" )");
  const auto path = folder.write("a.guf", "( include \"b.guf\" )");
  EXPECT_THAT(refusal_of(path), HasSubstr("b.guf:1:1: expected an include that does not lead back to its own file"));
}

TEST(Include, RefusesMoreThanEightNestedFiles) {
  const Folder folder;
  for (int i = 1; i < 9; ++i) {
    folder.write(std::to_string(i) + ".guf", "( include \"" + std::to_string(i + 1) + ".guf\" )");
  }
  folder.write("9.guf", "");
  EXPECT_TRUE(load_configuration(folder.path() / "2.guf"));
  EXPECT_THAT(refusal_of(folder.path() / "1.guf"), HasSubstr("8.guf:1:1: expected at most 8 files deep"));
}

TEST(Include, RefusesMoreThanSixtyFourIncludes) {
  const Folder folder;
  folder.write("empty.guf", "");
  std::string text;
  for (int i = 0; i < 64; ++i) text += "( include \"empty.guf\" )\n";
  EXPECT_TRUE(load_configuration(folder.write("a.guf", text)));
  EXPECT_THAT(refusal_of(folder.write("b.guf", text + "( include \"empty.guf\" )")),
              HasSubstr("b.guf:65:1: expected at most 64 includes, found one more"));
}

TEST(Include, LimitsTheWordsOfAllFilesTogether) {
  const Folder folder;
  std::string many;
  for (int i = 0; i < 50'000; ++i) many += "1 ";
  folder.write("many.guf", many);
  EXPECT_THAT(refusal_of(folder.write("a.guf",
                                      "`( ( include \"many.guf\" ) ( include \"many.guf\" )"
                                      " ( include \"many.guf\" ) ( include \"many.guf\" ) )")),
              HasSubstr("expected at most 200000 words with all includes"));
}

TEST(Include, NamesThePositionOfAnIncludeOfAMissingFile) {
  const Folder folder;
  EXPECT_THAT(refusal_of(folder.write("a.guf", "( Apg70\n  :ranges ( include \"none.guf\" ) )")),
              HasSubstr("a.guf:2:11: expected a GUF file, found "));
}

TEST(Include, NamesTheIncludedFileInItsErrors) {
  const Folder folder;
  folder.write("part.guf", "\n\n  )");
  EXPECT_THAT(refusal_of(folder.write("a.guf", "( include \"part.guf\" )")),
              HasSubstr("part.guf:3:3: expected a form"));
}

TEST(Include, RequiresExactlyOneString) {
  const Folder folder;
  EXPECT_THAT(refusal_of(folder.write("a.guf", "( include part )")),
              HasSubstr("a.guf:1:1: expected ( include \"file\" )"));
}

TEST(Include, RefusesSeveralValuesForOneSlot) {
  const Folder folder;
  folder.write("two.guf", "1 2");
  EXPECT_THAT(refusal_of(folder.write("a.guf", "( Apg70 :rate ( include \"two.guf\" ) )")),
              HasSubstr("a.guf:1:15: expected a file with one value for the slot, found 2 arguments in it"));
}

TEST(Files, AFolderOrAMissingFileIsRefused) {
  const Folder folder;
  EXPECT_THAT(refusal_of(folder.path()), HasSubstr("expected a GUF file"));
  EXPECT_THAT(refusal_of(folder.path() / "none.guf"), HasSubstr("expected a GUF file"));
}

TEST(Files, APathInAFileIsRelativeToThatFile) {
  const Folder folder;
  const auto path = folder.write("deep/a.guf", "( Terrain :directory \"../dted\" )");
  const auto configuration = load_configuration(path);
  ASSERT_TRUE(configuration) << configuration.error().message();
  EXPECT_EQ(configuration->radar.terrain.directory, (folder.path() / "dted").string());
}

}  // namespace
}  // namespace yars::config

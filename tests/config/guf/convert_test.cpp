// Tests of `yars config convert`: its output gives the same configuration as its input, in the current spelling of GUF.
#include <gmock/gmock.h>

#include "config/schema/load.hpp"
#include "tests/config/support.hpp"

namespace yars::config {
namespace {

using testing::fields;
using testing::Folder;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::loaded;
using ::testing::Not;

std::string converted(const std::string& text) {
  const auto conversion = convert_configuration_text(text, "text.guf");
  EXPECT_TRUE(conversion) << conversion.error().message();
  return conversion ? conversion->text : std::string();
}

TEST(Convert, OfTheReportSampleReadsBackEqualWithoutOldSpellings) {
  const std::string path = std::string(YARS_SOURCE_DIR) + "/tests/config/guf/messages/radar.cf";
  const auto sample = load_configuration(path);
  const auto conversion = convert_configuration(path, {});
  ASSERT_TRUE(sample && conversion);
  const auto again = loaded(conversion->text);
  EXPECT_EQ(fields(again.radar), fields(sample->radar));
  EXPECT_NE(fields(again.radar), fields(radar::RadarConfiguration{}));
  EXPECT_FALSE(again.warnings.empty());  // about slots that are read but not used
  for (const std::string& warning : again.warnings) EXPECT_THAT(warning, HasSubstr("read, not used"));
  EXPECT_EQ(conversion->warnings.size(), sample->warnings.size());
}

TEST(Convert, WritesOnlyTheSlotsThatTheFileSets) {
  EXPECT_EQ(converted("r := Radar: { latitude: N37@30.5 RealBeamMode: { scanWidths: {90, 45, 20} } }"),
            "( System\n"
            "  :latitude ( lat-long N 37 30.5 )\n"
            "  :modes `( ( RealBeamMode :scanWidths `( 90 45 20 ) ) )\n"
            "  :name \"r\"\n"
            ")\n");
}

TEST(Convert, ReplacesOldSpellingsOfGuf) {
  EXPECT_EQ(converted("( Radar :DISPLAY ( Window width: 300, height: 300 mode: \"double\" ) :ranges { 1, 2 } )"),
            "( System :display ( Window :width 300 :height 300 :bmode \"double\" ) :ranges `( 1 2 ) )\n");
}

TEST(Convert, KeepsDefinitionsOfForms) {
  const std::string text = "( def-form Mine is= Terrain 'depth )\n( Mine :directory \"d\" :depth 3 )\n";
  const std::string modern = converted(text);
  EXPECT_EQ(modern, "( def-form Mine is= Terrain depth )\n( Mine :directory \"d\" :depth 3 )\n");
  EXPECT_EQ(fields(loaded(modern).radar), fields(loaded(text).radar));
}

TEST(Convert, InsertsTheContentsOfIncludes) {
  const Folder folder;
  folder.write("part.guf", ":ranges `( 5 6 ) :pulseWidths `( 1 2 )");
  const auto conversion = convert_configuration(folder.write("a.guf", "( Apg70 ( include \"part.guf\" ) )"), {});
  ASSERT_TRUE(conversion);
  EXPECT_EQ(conversion->text, "( Apg70 :ranges `( 5 6 ) :pulseWidths `( 1 2 ) )\n");
  EXPECT_THAT(conversion->warnings, IsEmpty());
}

TEST(Convert, WritesPathsRelativeToTheFolderOfTheNewFile) {
  const Folder folder;
  folder.write("parts/terrain.cf", "directory: \"../dted\"");
  const auto path = folder.write("a.cf", "Terrain: {\n#include \"parts/terrain.cf\"\n}");
  const auto conversion = convert_configuration(path, folder.path() / "deep/new");
  ASSERT_TRUE(conversion) << conversion.error().message();
  EXPECT_THAT(conversion->text, HasSubstr("\"../../dted\""));
  const auto again = load_configuration(folder.write("deep/new/a.guf", conversion->text));
  ASSERT_TRUE(again) << again.error().message();
  EXPECT_EQ(again->radar.terrain.directory, (folder.path() / "dted").string());
  const auto absolute = convert_configuration(folder.write("b.guf", "( Terrain \"/dted\" )"), folder.path() / "deep");
  ASSERT_TRUE(absolute);
  EXPECT_THAT(absolute->text, HasSubstr("\"/dted\""));
}

TEST(Convert, BreaksLongLines) {
  std::string ranges;
  for (int i = 1; i <= 16; ++i) ranges += std::to_string(i) + ".000976562 ";
  const std::string modern = converted("( Apg70 :ranges `( " + ranges + " ) )");
  EXPECT_THAT(modern, HasSubstr("( Apg70\n  :ranges `(\n    1.000976562\n"));
  EXPECT_EQ(converted(modern), modern);
}

TEST(Convert, RefusesAnInvalidOrMissingConfiguration) {
  const auto conversion = convert_configuration_text("Radar: { ranges: { 0 } }", "text.guf");
  ASSERT_FALSE(conversion);
  EXPECT_THAT(conversion.error().message(), HasSubstr("text.guf:1:20: expected a list of 1 to 16 ascending numbers"));
  EXPECT_THAT(convert_configuration("none.guf", {}).error().message(),
              HasSubstr("none.guf: expected a GUF file, found none; check the path"));
}

TEST(Convert, RefusesAResultThatIsTooLongForOneFile) {
  std::string text = "Radar: { ";
  for (int i = 0; i < 66'000; ++i) text += "longKeyword:1 ";
  const auto conversion = convert_configuration_text(text + "}", "text.guf");
  ASSERT_FALSE(conversion);
  EXPECT_THAT(conversion.error().message(),
              HasSubstr("expected what fits into one file of GUF: at most 1048576 bytes in a file, found 11"));
}

}  // namespace
}  // namespace yars::config

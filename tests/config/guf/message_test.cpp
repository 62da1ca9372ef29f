// Tests of messages, the configuration syntax of 1996: `name := Keyword: { ... }`. They give the same configuration as
// the equivalent GUF forms.
#include <gmock/gmock.h>

#include "config/guf/messages.hpp"
#include "tests/config/support.hpp"

namespace yars::config {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using testing::fields;
using testing::Folder;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::loaded;
using ::testing::Not;
using testing::refusal;

// Expects that both texts give the same configuration, and that it differs from the defaults.
void expect_equal(const std::string& messages, const std::string& guf) {
  const auto configured = fields(loaded(messages).radar);
  EXPECT_EQ(configured, fields(loaded(guf).radar)) << messages;
  EXPECT_NE(configured, fields(radar::RadarConfiguration{})) << messages;
}

constexpr const char* kReportSampleAsGuf = R"(
( System
  :latitude ( lat-long N 37 0 )
  :longitude ( lat-long W 122 0 )
  :altitude 4000
  :heading 0
  :rate 20
  :name "myRadarSystem"
  :display ( Window :width 480 :height 480 :bmode "doublebuffer" :colorIndex 512
    :colors `( ( rgb 0 0 0 ) ( rgb :red 0.2 :green 1 :blue 0.3 ) ) )
  :antenna ( AntennaServo :elevationLimits `( -60 60 ) :maxRates `( 60 60 ) :beamWidth `( 2.5 2.5 ) )
  :databases `( ( DedDbase :latitude 37 :longitude -122 ) )
  :modes `( ( RealBeamMode
    :scanWidths `( 100 50 25 )
    :ranges `( 4.7 10 20 40 80 160 )
    :samples 128
    :sweepsPerDegree 2
    :antenna ( RbmAntenna :scanBars `( 1 2 3 4 ) )
    :display ( RbmDisplay :width `( -0.6 0.6 ) :height `( -0.1 1.1 ) ) ) ) )
)";

TEST(Messages, TheSampleOfTheReportEqualsItsGufForms) {
  const auto sample = load_configuration(std::string(YARS_SOURCE_DIR) + "/tests/config/guf/messages/radar.cf");
  ASSERT_TRUE(sample) << sample.error().message();
  EXPECT_EQ(fields(sample->radar), fields(loaded(kReportSampleAsGuf).radar));
  EXPECT_EQ(sample->radar.name, "myRadarSystem");
  EXPECT_EQ(sample->radar.antenna.azimuth_rate_dps, 60);
  EXPECT_EQ(sample->radar.fidelity.samples, 128);
  EXPECT_EQ(sample->radar.view.colors.video.green, 1.0);
  EXPECT_THAT(sample->warnings, Contains(HasSubstr("radar.cf:1:1: messages are the syntax of 1996")));
  EXPECT_THAT(sample->warnings, Contains(HasSubstr("radar.cf:29:13: the name myRangeList is read, not used")));
  EXPECT_THAT(sample->warnings, Not(Contains(HasSubstr("no slot"))));
}

TEST(Messages, AFormKeywordFillsTheSlotThatAcceptsTheForm) {
  expect_equal("Radar: { Fidelity: { preset: draft samples: 99 } Sea: { state: 3 } }",
               "( System :fidelity ( Fidelity :preset draft :samples 99 ) :sea ( Sea :state 3 ) )");
  expect_equal("Route: { Point: { name: \"1\" latitude: N37@30 longitude: W122@15.5 } }",
               "( Route `( ( Point \"1\" ( lat-long N 37 30 ) ( lat-long W 122 15.5 ) ) ) )");
}

TEST(Messages, SeveralFormsOfOneKindBecomeAList) {
  expect_equal("Movers: { Mover: { \"a\", 37, -122, 10, 0, 100, 10 } Mover: { \"b\", 38, -122, 10, 0, 100, 10 } }",
               "( Movers `( ( Mover \"a\" 37 -122 10 0 100 10 ) ( Mover \"b\" 38 -122 10 0 100 10 ) ) )");
}

TEST(Messages, AModeMayBeInTheListOfModesOrDirectlyInTheRadar) {
  const std::string guf = "( System :modes `( ( RealBeamMode :samples 77 ) ( SarMode :windows `( 1.3 3.3 ) ) ) )";
  expect_equal("Radar: { modes: { RealBeamMode: { samples: 77 } SarMode: { windows: { 1.3, 3.3 } } } }", guf);
  expect_equal("Radar: { RealBeamMode: { samplesPerSweep: 77 } SarMode: { windows: { 1.3, 3.3 } } }", guf);
}

TEST(Messages, ScanBarsOfAModeGoIntoItsAntennaInAnyOrder) {
  const std::string guf = "( RealBeamMode :antenna ( RbmAntenna :circularScan true :scanBars `( 4 3 ) ) )";
  expect_equal("RealBeamMode: { scanBars: { 4, 3 } Antenna: { circularScan: true } }", guf);
  expect_equal("RealBeamMode: { Antenna: { circularScan: true } scanBars: { 4, 3 } }", guf);
}

TEST(Messages, TheSlotNameOverridesTheNameBeforeTheMessage) {
  EXPECT_EQ(loaded("outer := Radar: { name: \"inner\" }").radar.name, "inner");
  EXPECT_EQ(loaded("outer := Apg70: { }").radar.name, "outer");
}

TEST(Messages, CommentsCommasAndSpacesDoNotMatter) {
  expect_equal("/* a * b **/ Radar : // c\n{ ranges :{1 2,\n3}}", "( System :ranges `( 1 2 3 ) )");
}

TEST(Messages, UnknownKeywordsAreIgnoredWithAWarning) {
  EXPECT_THAT(
      loaded("Radar: { warp: { speed: 9 } ragnes: { 1 } }").warnings,
      AllOf(Contains(HasSubstr("text.guf:1:10: the form System has no slot :warp; the slot is ignored")),
            Contains(HasSubstr(
                "text.guf:1:29: the form System has no slot :ragnes; the slot is ignored; nearest name: :ranges"))));
  EXPECT_THAT(loaded("Warp: { speed: { 1 } }").warnings, Contains(HasSubstr("the form Warp is unknown and ignored")));
}

TEST(Messages, AreRecognizedByTheirFirstWord) {
  for (const char* text : {"Radar: { }", "a := Radar: { }", "#include \"x\"", "// c\n/* d */ ; e\n\n  Radar : { }",
                           "\xEF\xBB\xBFRadar: { }", "a\t:= Radar: { }"}) {
    EXPECT_TRUE(is_in_messages(text)) << text;
  }
  for (const char* text : {"", "( Radar )", "; Radar: { }", "// Radar: { }\n( Apg70 )", "/* Radar: { }", "Radar",
                           "1: 2", ":name 1", "{ 1 }", "Radar\n: { }"}) {
    EXPECT_FALSE(is_in_messages(text)) << text;
  }
}

std::string message_refusal(const std::filesystem::path& path) {
  const auto configuration = load_configuration(path);
  EXPECT_FALSE(configuration);
  return configuration ? std::string() : configuration.error().message();
}

TEST(MessageIncludes, InsertTheContentsOfTheFile) {
  const Folder folder;
  folder.write("parts/list.cf", "7 8");
  folder.write("parts/slots.cf", "samples: 77\nranges: { 6, #include \"list.cf\"\n 9 }");
  const auto configuration = load_configuration(folder.write("a.cf", "Radar: {\n  #include \"parts/slots.cf\"\n}"));
  ASSERT_TRUE(configuration) << configuration.error().message();
  EXPECT_THAT(configuration->radar.ranges_nm, ElementsAre(6, 7, 8, 9));
  EXPECT_EQ(configuration->radar.fidelity.samples, 77);
}

TEST(MessageIncludes, StayInTheFolderOfTheFirstFile) {
  const Folder folder;
  folder.write("secret.cf", "rate: 1");
  const auto path = folder.write("inside/a.cf", "Radar: {\n #include \"../secret.cf\"\n}");
  EXPECT_THAT(message_refusal(path), HasSubstr("a.cf:2:2: expected an include inside "));
}

TEST(MessageIncludes, CyclesAndMissingFilesAreRefused) {
  const Folder folder;
  EXPECT_THAT(message_refusal(folder.write("a.cf", "#include \"a.cf\"")),
              HasSubstr("a.cf:1:1: expected an include that does not lead back to its own file"));
  EXPECT_THAT(message_refusal(folder.write("b.cf", "Radar: { }\n#include \"none.cf\"")),
              HasSubstr("b.cf:2:1: expected"));
}

TEST(MessageIncludes, AreRefusedBeyondEightNestedFiles) {
  const Folder folder;
  for (int i = 1; i < 9; ++i) {
    folder.write(std::to_string(i) + ".cf", "#include \"" + std::to_string(i + 1) + ".cf\"");
  }
  folder.write("9.cf", "");
  EXPECT_TRUE(load_configuration(folder.path() / "2.cf"));
  EXPECT_THAT(message_refusal(folder.path() / "1.cf"), HasSubstr("8.cf:1:1: expected at most 8 files deep"));
}

TEST(MessageIncludes, AcceptOnlyMessages) {
  const Folder folder;
  folder.write("part.guf", "( Sea :state 3 )");
  EXPECT_THAT(message_refusal(folder.write("a.cf", "Radar: { }\n#include \"part.guf\"")),
              HasSubstr("part.guf:1:1: expected a message"));
}

struct MessageCase {
  const char* name;
  std::string text;
  std::string message;
};

class MessageError : public ::testing::TestWithParam<MessageCase> {};

TEST_P(MessageError, NamesPositionExpectationAndFinding) {
  EXPECT_EQ(refusal(GetParam().text), GetParam().message);
}

std::string repeated_message(const std::string& part, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += part;
  return text;
}

INSTANTIATE_TEST_SUITE_P(
    Messages, MessageError,
    ::testing::Values(
        MessageCase{"BracesNotClosed", "Radar: {\n rate: 1\n",
                    "text.guf:3:1: expected a message, a value or }, found the end of the file"},
        MessageCase{"BracesClosedTwice", "Radar: { } }",
                    "text.guf:1:12: expected a message, as Radar: { ... }, or the end of the file, found }"},
        MessageCase{"KeywordWithoutValue", "Radar: { rate: }",
                    "text.guf:1:16: expected a value for the keyword, found }"},
        MessageCase{"NameWithoutMessage", "Radar: { a := 1 }",
                    "text.guf:1:15: expected a keyword with its colon after :=, found 1"},
        MessageCase{"NoColon", "Sea: { }\nRadar { }",
                    "text.guf:2:1: expected Radar: { ... }, found Radar { ... }; put a colon after the keyword"},
        MessageCase{"SlotOutsideAllForms", "rate: 1",
                    "text.guf:1:1: expected a message that makes a form, as Radar: { ... }, found rate:"},
        MessageCase{"NoColonInside", "Radar: { Display { } }",
                    "text.guf:1:10: expected Display: { ... }, found Display { ... }; put a colon after the keyword"},
        MessageCase{
            "KeywordAmongValues", "Radar: { rate: 1 2 }",
            "text.guf:1:18: expected messages alone or values alone in these braces, found the number 2; give it a "
            "keyword"},
        MessageCase{"ParenthesesOfGuf", "Radar: { ( Sea ) }",
                    "text.guf:1:10: expected a message, as latitude: N37@30.0, found ("},
        MessageCase{"OtherDirective", "#define A 1",
                    "text.guf:1:1: expected #include \"file\", the one directive that is read, found #define"},
        MessageCase{"IncludeWithoutQuotes", "#include <a.cf>",
                    "text.guf:1:10: expected a message, as latitude: N37@30.0, found <"},
        MessageCase{"IncludeOfNothing", "#include Radar: { }",
                    "text.guf:1:10: expected the name of a file in quotes after #include, found Radar:"},
        MessageCase{"IncludeInAText", "#include \"a.cf\"",
                    "text.guf:1:1: expected #include in files only, found it in a text without a file"},
        MessageCase{"IncludeInATextInside", "Radar: { ranges: { 1 #include \"a.cf\" } }",
                    "text.guf:1:22: expected #include in files only, found it in a text without a file"},
        MessageCase{"CommentNotClosed", "a := /* b", "text.guf:1:6: expected */ at the end of the comment, found none"},
        MessageCase{"CoordinateWithoutMinutes", "Radar: { latitude: N37@ }",
                    "text.guf:1:20: expected degrees and minutes, as N37@30.5, found N37@"},
        MessageCase{"CoordinateWithUnknownHemisphere", "Radar: { latitude: X37@00.0 }",
                    "text.guf:1:20: expected degrees and minutes, as N37@30.5, found X37@00.0"},
        MessageCase{"LongitudeForLatitude", "Radar: { latitude: W122@00.0 }",
                    "text.guf:1:20: expected N or S for a latitude, found E or W"},
        MessageCase{
            "SixtyOneMinutes", "Radar: { latitude: N37@61 }",
            "text.guf:1:20: expected a number in [0, 60] arcmin for :minutes, found the number 61; `yars config print "
            "--defaults` explains every slot"},
        MessageCase{"FormInTheWrongPlace", "Radar: {\n RealBeamMode: { Sea: { } } }",
                    "text.guf:2:18: expected a message that is allowed in RealBeamMode, found Sea:"},
        MessageCase{"ValueForAForm", "Radar: { Display: 480 }",
                    "text.guf:1:19: expected { ... } after Display:, found the number 480"},
        MessageCase{"MessageAmongValues", "Radar: { ranges: { a: 1 } }",
                    "text.guf:1:20: expected values, as { 1, 2 }, found a:"},
        MessageCase{"NameAmongValues", "Radar: { ranges: { 1 b := a: 1 } }",
                    "text.guf:1:22: expected values, as { 1, 2 }, found a name with :="},
        MessageCase{"ValueAmongForms", "Radar: { modes: { { 1 } } }",
                    "text.guf:1:19: expected messages that make forms in modes:, found values in braces"},
        MessageCase{"OneSlotTwice", "Radar: { rate: 1\n rate: 2 }",
                    "text.guf:2:2: expected the slot :rate once in its form, found it again, first at text.guf:1:10"},
        MessageCase{
            "WordOfGuf", "include: { \"x\" }",
            "text.guf:1:1: expected a keyword of the radar, found include:; this is a reserved word of GUF; choose "
            "another keyword"},
        MessageCase{
            "WordOfGufInAnUnknownForm", "Future: { guf: { a: 1 } }",
            "text.guf:1:11: expected a keyword of the radar, found guf:; this is a reserved word of GUF; choose "
            "another keyword"},
        MessageCase{
            "TooDeep", "a: " + repeated_message("{", 65),
            "text.guf:1:68: expected at most 64 brackets open at once, found one more; close a form before this one"},
        MessageCase{"TooManyWords", "a: { " + repeated_message("1 ", 200'001),
                    "text.guf:1:400001: expected at most 200000 words in a file, found more; split the file"},
        MessageCase{"TooLarge", "a:" + std::string(1U << 20U, ' '),
                    "text.guf: expected at most 1048576 bytes in a file, found 1048578; split the file"}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(MessageTexts, WithOnlyCommentsGiveTheDefaults) {
  const Folder folder;
  const auto configuration = load_configuration(folder.write("a.cf", "// nothing\n"));
  ASSERT_TRUE(configuration) << configuration.error().message();
  EXPECT_EQ(fields(configuration->radar), fields(radar::RadarConfiguration{}));
  EXPECT_THAT(configuration->warnings, IsEmpty());
}

}  // namespace
}  // namespace yars::config

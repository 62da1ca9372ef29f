// Tests of the GUF forms that define a radar: window limits, range by height, antenna, maps, and scenes by MgDbase, a
// form of 1996.
#include <gmock/gmock.h>

#include "tests/config/support.hpp"

namespace yars::config {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::loaded;
using testing::refusal;

TEST(WindowLimits, MustIncludeEveryWindowOfSarModeInAnyOrderOfTheForms) {
  const std::string limits =
      "( WindowLimits :windows `( 1 5 ) :least `( 3 4 ) :greatest `( 20 30 ) :blankWindows `( 1 5 ) "
      ":blankUpTo `( 10 30 ) )";
  const std::string windows = "( SarMode :windows `( 1 5 ) )";
  for (const std::string& text :
       {limits + windows, windows + limits, "( Apg70 :modes `( " + windows + " ) :windowLimits " + limits + " )"}) {
    const auto configuration = loaded(text);
    EXPECT_THAT(configuration.radar.window_limits.max_range_nm, ElementsAre(20, 30));
    EXPECT_THAT(configuration.radar.windows_nm, ElementsAre(1, 5));
  }
  EXPECT_EQ(refusal("( Noise :looks 4 )\n" + windows + "\n( Noise :looks 5 )"),
            "text.guf:2:1: expected every window of SarMode among the windows of WindowLimits, with a least and a "
            "greatest range for :windows, found none for 1 NM");
  EXPECT_THAT(refusal("\n\n" + limits), HasSubstr("text.guf:3:1: expected every window of SarMode"));
}

TEST(WindowLimits, MustAgreeInNumberAndOrder) {
  EXPECT_THAT(refusal("( WindowLimits :least `( 4.7 4.7 ) )"),
              HasSubstr("text.guf:1:23: expected 8 numbers, one for each of :windows, for :least, found 2"));
  EXPECT_THAT(refusal("( WindowLimits :greatest `( 20 40 50 80 160 20 160 160 ) )"),
              HasSubstr("expected more than the least range of the window 20, 20 NM for :greatest, found 20"));
  EXPECT_THAT(refusal("( WindowLimits :blankUpTo `( 50 80 ) )"),
              HasSubstr("expected 3 numbers, one for each of :blankWindows, for :blankUpTo, found 2"));
  EXPECT_THAT(refusal("( WindowLimits :blankWindows `( 3.3 5 10 ) )"),
              HasSubstr("expected windows that :windows lists for :blankWindows, found 5"));
}

TEST(PairedLists, ADifferentNumberOfValuesIsWarnedOfWithBothSlots) {
  EXPECT_THAT(loaded("( Apg70 :ranges `( 10 20 40 )\n:pulseWidths `( 0.5 1 ) )").warnings,
              ElementsAre("text.guf:2:14: expected a value of :pulseWidths for each of :ranges, found 2 for 3; by "
                          "position 10 NM has 0.5 us, 20 NM has 1 us, 40 NM has 1 us; give :pulseWidths with 3 values "
                          "beside :ranges"));
  EXPECT_THAT(loaded("( RbmDisplay :rangeRings `( 1 2 ) )").warnings,
              ElementsAre(HasSubstr("a value of :rangeRings for each of :ranges, found 2 for 6")));
}

TEST(PairedLists, AFirstListThatChangesAloneIsWarnedOf) {
  EXPECT_THAT(loaded("( Apg70 :ranges `( 10 20 ) )").warnings,
              ElementsAre("text.guf:1:17: expected a value of :pulseWidths for each of :ranges, found :ranges changed "
                          "without :pulseWidths; by position 10 NM has 0.26 us, 20 NM has 0.5 us; give :pulseWidths "
                          "with 2 values beside :ranges"));
  EXPECT_THAT(loaded("( RealBeamMode :ranges `( 5 10 20 40 80 160 ) )").warnings,
              ElementsAre(HasSubstr("found :ranges changed without :pulseWidths")));
  EXPECT_THAT(
      loaded("( WindowLimits :windows `( 0.67 1.3 3.3 4.7 9 10 20 80 ) )( SarMode :windows `( 9 ) )").warnings,
      ElementsAre(HasSubstr(":windows changed without :least"), HasSubstr(":windows changed without :greatest")));
}

TEST(PairedLists, AFileThatChangesRangesOfAnIncludedFileIsWarnedOf) {
  const testing::Folder folder;
  folder.write("base.guf", "( Apg70 :pulseWidths `( 1 2 ) :ranges `( 10 20 ) )");
  const auto warnings = [&](const std::string& text) {
    return load_configuration(folder.write("own.guf", "( include \"base.guf\" )" + text)).value().warnings;
  };
  EXPECT_THAT(warnings(""), IsEmpty());
  EXPECT_THAT(warnings("( Apg70 :ranges `( 40 80 ) )"), ElementsAre(HasSubstr("40 NM has 1 us, 80 NM has 2 us")));
  EXPECT_THAT(warnings("( Apg70 :ranges `( 10 20 ) )"), IsEmpty());
  EXPECT_THAT(warnings("( Apg70 :pulseWidths `( 3 4 ) )"), IsEmpty());
  EXPECT_THAT(warnings("( Apg70 :ranges `( 40 80 ) ) ( Apg70 :pulseWidths `( 3 4 ) )"), IsEmpty());
  EXPECT_THAT(warnings("( Apg70 :pulseWidths `( 3 4 ) ) ( Apg70 :ranges `( 40 80 ) )"), IsEmpty());
}

TEST(PairedLists, OneValueForAllIsNoReasonForAWarning) {
  EXPECT_THAT(loaded("( Apg70 :ranges `( 10 20 40 ) :pulseWidths `( 1 ) )( RbmDisplay :rangeRings `( 5 ) )").warnings,
              IsEmpty());
}

TEST(HeightRanges, HaveOneRangeMoreThanHeights) {
  const auto table = loaded("( Apg70 :heightRanges ( HeightRanges `( 2000 ) `( 20 80 ) ) )").radar.height_ranges;
  EXPECT_THAT(table.heights_ft, ElementsAre(2000));
  EXPECT_THAT(table.ranges_nm, ElementsAre(20, 80));
  EXPECT_THAT(refusal("( HeightRanges :heights `( 500 ) )"),
              HasSubstr("text.guf:1:1: expected 2 numbers, one more than :heights for :ranges, found 3"));
}

TEST(AntennaServo, MustStartWithinTheGimbalLimits) {
  const auto antenna = loaded("( AntennaServo :position `( -20 5 ) )").radar.antenna;
  EXPECT_EQ(antenna.start_azimuth_deg, -20.0);
  EXPECT_EQ(antenna.start_elevation_deg, 5.0);
  EXPECT_THAT(
      refusal("( AntennaServo :position `( 70 5 ) )"),
      HasSubstr("text.guf:1:26: expected a position within the gimbal limits, +-60 and +-60 deg, for :position, "
                "found 70 and 5"));
}

TEST(ScanBars, AreTheFirstNumberOfAList) {
  EXPECT_EQ(loaded("( RbmAntenna :scanBars `( 1 2 3 4 ) )").radar.antenna.scan_bars, 1);
  EXPECT_EQ(loaded("( RbmAntenna :scanBars `( 4 2 ) )").radar.antenna.scan_bars, 4);
  EXPECT_EQ(loaded("( RbmAntenna :scanBars 3 )").radar.antenna.scan_bars, 3);
}

TEST(SarMode, GivesTheSizeOfSquareMaps) {
  EXPECT_EQ(loaded("( SarMode :samples 256 )").radar.fidelity.map_size, 256);
  EXPECT_EQ(loaded("( SarMode :width 320 )").radar.fidelity.map_size, 320);
  EXPECT_EQ(loaded("( SarMode :samples 320 :width 320 )").radar.fidelity.map_size, 320);
  EXPECT_EQ(loaded("( SarMode :samples 320 )( SarMode :windows `( 1.3 ) )").radar.fidelity.map_size, 320);
  EXPECT_THAT(refusal("( SarMode :samples 320 :width 480 )"),
              HasSubstr("text.guf:1:31: expected the samples, 320 (maps are square) for :width, found 480"));
}

TEST(MgDbase, IsAScene) {
  const auto placed = loaded(
      "( Apg70 :databases `( ( MgDbase ( lat-long N 37 30 ) -122.4 :files \"sf.flt\" :path \"/flt\" ) ) :modes `( ( "
      "SarMode :databases `( ( MgDbase :files \"sf.flt\" :path \"/flt\" ) ) ) ) )");
  ASSERT_EQ(placed.radar.world.scenes.size(), 1U) << "one scene, although two forms name it";
  EXPECT_EQ(placed.radar.world.scenes[0].file, "/flt/sf.flt");
  EXPECT_EQ(placed.radar.world.scenes[0].position.latitude_deg, 37.5);
  EXPECT_THAT(refusal("( MgDbase :files \"sf.flt\" )"), HasSubstr("expected the folder of the polygon file for :path"));
  EXPECT_THAT(refusal("( MgDbase :latitude 37 :path \"flt\" )"),
              HasSubstr("expected latitude and longitude together, or neither"));
}

}  // namespace
}  // namespace yars::config

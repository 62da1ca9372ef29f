// Tests of how GUF forms become a configuration: slots by name and by position, ranges of values, presets, colours, and
// def-form with its base forms.
#include <gmock/gmock.h>

#include "config/schema/schema.hpp"
#include "tests/config/support.hpp"

namespace yars::config {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using testing::fields;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::loaded;
using testing::refusal;

TEST(Slots, ByNameAndByPositionAreEqual) {
  const auto named =
      loaded("( AntennaServo :azimuthLimits `( -50 50 ) :elevationLimits `( -40 40 ) :maxRates `( 60 70 ) )");
  const auto placed = loaded("( AntennaServo `( -50 50 ) `( -40 40 ) `( 60 70 ) )");
  const auto numbered = loaded("( AntennaServo :3 `( 60 70 ) :1 `( -50 50 ) :2 `( -40 40 ) )");
  EXPECT_EQ(named.radar.antenna.azimuth_limit_deg, 50.0);
  EXPECT_EQ(named.radar.antenna.elevation_limit_deg, 40.0);
  EXPECT_EQ(named.radar.antenna.azimuth_rate_dps, 60.0);
  EXPECT_EQ(named.radar.antenna.elevation_rate_dps, 70.0);
  EXPECT_EQ(fields(named.radar), fields(placed.radar));
  EXPECT_EQ(fields(named.radar), fields(numbered.radar));
}

TEST(Slots, AnUnnamedValueFollowsThePositionOfTheNamedSlotBeforeIt) {
  const auto configuration = loaded("( AntennaServo :azimuthLimits `( -50 50 ) `( -40 40 ) )");
  EXPECT_EQ(configuration.radar.antenna.elevation_limit_deg, 40.0);
}

TEST(Slots, OfTheReportKeepTheirPositions) {
  // Positions in the report: in Apg70 (table 18) 4 is samples, 6 is ranges; in SarMode 6 is patchSizes.
  const auto configuration =
      loaded("( Apg70 :pulseWidths `( 1 2 ) :4 256 :6 `( 5 15 ) :5 `( ( SarMode :6 `( 100 3200 ) ) ) )");
  EXPECT_EQ(configuration.radar.fidelity.samples, 256);
  EXPECT_THAT(configuration.radar.ranges_nm, ElementsAre(5, 15));
  EXPECT_THAT(configuration.warnings, ElementsAre(AllOf(HasSubstr(":patchSizes of SarMode"), HasSubstr("not used"))));
}

TEST(Slots, LaterFormsWin) {
  const auto configuration = loaded("( Apg70 :name \"first\" :seed 3 )\n( Apg70 :name \"second\" )");
  EXPECT_EQ(configuration.radar.name, "second");
}

TEST(Slots, UnknownOnesWarnWithTheNearestName) {
  const auto configuration = loaded("( Apg70 :rnages `( 1 2 ) )");
  EXPECT_THAT(
      configuration.warnings,
      ElementsAre("text.guf:1:9: the form Apg70 has no slot :rnages; the slot is ignored; nearest name: :ranges"));
  EXPECT_THAT(
      loaded("( Apg70 :moreCells `() )").warnings,
      ElementsAre("text.guf:1:9: the form Apg70 has no slot :moreCells; the slot is ignored; the form Rain has it"));
  EXPECT_THAT(loaded("( Rian )").warnings,
              ElementsAre("text.guf:1:1: the form Rian is unknown and ignored; nearest name: Rain"));
  EXPECT_EQ(fields(configuration.radar), fields(radar::RadarConfiguration{}));
}

TEST(Slots, UnusedOnesWarn) {
  EXPECT_THAT(loaded("( Apg70 :rate 20 )").warnings,
              ElementsAre("text.guf:1:15: :rate of Apg70 is read, not used: all programs step by ticks of 5 ms"));
}

TEST(Slots, EachUnusedOneNamesWhatReplacesIt) {
  for (const FormSchema& form : schema())
    for (const SlotSchema& slot : form.slots)
      EXPECT_TRUE(is_used(slot) || !slot.instead.empty()) << form.name << ' ' << slot.name;
}

TEST(Slots, UnusedOnesAreCheckedToo) {
  EXPECT_EQ(
      refusal("( Window :colors `( ( rgb 0.5 1.5 0 ) ) )"),
      "text.guf:1:31: expected a number in [0, 1] for :green, found the number 1.5; `yars config print --defaults` "
      "explains every slot");
}

TEST(Slots, GivenTwiceInAFormAreRefused) {
  EXPECT_EQ(refusal("( Noise :looks 4\n :looks 5 )"),
            "text.guf:2:2: expected the slot :looks once in its form, found it again, first at text.guf:1:9");
  EXPECT_THAT(refusal("( Noise -38 :1 -40 )"), HasSubstr("text.guf:1:13: expected the slot :floor once"));
}

TEST(Slots, BeyondTheLastPositionAreRefused) {
  EXPECT_EQ(refusal("( Noise -38 4 1 9 )"), "text.guf:1:17: expected at most 3 slots in Noise, found position 4");
}

TEST(Slots, OfDifferentCaseAreReadWithAWarning) {
  const auto configuration = loaded("( apg70 :Ranges `( 1 2 ) :pulseWidths `( 1 2 ) )");
  EXPECT_THAT(configuration.radar.ranges_nm, ElementsAre(1, 2));
  EXPECT_THAT(configuration.warnings, ElementsAre("text.guf:1:1: apg70 is an old spelling; write Apg70",
                                                  "text.guf:1:9: :Ranges is an old spelling; write :ranges"));
}

struct WrongValue {
  const char* text;
  const char* message;  // its start, up to the hint or earlier
};

class Values : public ::testing::TestWithParam<WrongValue> {};

TEST_P(Values, OutsideTheirRangeOrKindAreRefusedAtTheirPosition) {
  EXPECT_THAT(refusal(GetParam().text), HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    OfEachKind, Values,
    ::testing::Values(
        WrongValue{"( Noise :floor 3 )",
                   "text.guf:1:16: expected a number in [-120, 0] dB for :floor, found the number 3"},
        WrongValue{"( Noise :floor low )",
                   "text.guf:1:16: expected a number in [-120, 0] dB for :floor, found the identifier low"},
        WrongValue{"( Noise :looks 2.5 )",
                   "text.guf:1:16: expected a whole number in [0, 16] for :looks, found the number 2.5"},
        WrongValue{"( Noise :seed -1 )", "text.guf:1:15: expected a whole number in [0, 9007199254740992] for :seed"},
        WrongValue{"( Fidelity :noise 1 )", "text.guf:1:19: expected true or false for :noise, found the number 1"},
        WrongValue{"( Fidelity :beam wide )",
                   "text.guf:1:18: expected one of hard-edge, gaussian, cosecant-squared, mapping for :beam, found the "
                   "identifier wide"},
        WrongValue{"( Apg70 :name 70 )", "text.guf:1:15: expected a string for :name, found the number 70"},
        WrongValue{"( Terrain :directory true )",
                   "text.guf:1:22: expected a string, a path relative to the file that contains it for :directory, "
                   "found true"},
        WrongValue{"( Apg70 :ranges `( 10 20 15 ) )",
                   "text.guf:1:26: expected a list of 1 to 16 ascending numbers in [0.1, 500] NM for :ranges, found 15 "
                   "after 20"},
        WrongValue{"( Apg70 :ranges `( ) )", "text.guf:1:17: expected a list of 1 to 16 ascending numbers"},
        WrongValue{"( Apg70 :ranges `( 0 ) )",
                   "text.guf:1:20: expected a list of 1 to 16 ascending numbers in [0.1, 500] NM for :ranges, found "
                   "the number 0"},
        WrongValue{"( RbmAntenna :scanWidths `( 25 50 100 ) )",
                   "text.guf:1:32: expected a list of 3 descending numbers"},
        WrongValue{"( RbmAntenna :scanWidths `( 100 50 ) )",
                   "text.guf:1:26: expected a list of 3 descending numbers in [1, 360] deg for :scanWidths, found a "
                   "list of 2"},
        WrongValue{"( RbmAntenna :scanBars `( 1 5 ) )",
                   "text.guf:1:29: expected a whole number or a list of them in [1, 4] for :scanBars"},
        WrongValue{"( AntennaServo :azimuthLimits `( -60 50 ) )", "text.guf:1:34: expected a list of -limit and limit"},
        WrongValue{"( AntennaServo :maxRates `( 60 ) )",
                   "text.guf:1:26: expected a list of 2 numbers in [1, 1000] deg/s for :maxRates, found a list of 1"},
        WrongValue{"( RbmDisplay :width `( 1 -1 ) )",
                   "text.guf:1:21: expected a list of low and high, or a number, in [-4, 4] ranges for :width, found 1 "
                   "and -1"},
        WrongValue{"( Window :height 500 )",
                   "text.guf:1:18: expected the width, 480 (the display is square) for :height, found 500"},
        WrongValue{"( Apg70 :fidelity fine )",
                   "text.guf:1:19: expected a form: Fidelity for :fidelity, found the identifier fine"},
        WrongValue{"( Apg70 :fidelity ( Noise ) )",
                   "text.guf:1:19: expected a form: Fidelity for :fidelity, found the form Noise"},
        WrongValue{"( Apg70 :antenna ( Dish ) )",
                   "text.guf:1:18: expected a form: AntennaServo, RbmAntenna for :antenna, found the form Dish, which "
                   "is unknown"},
        WrongValue{"( Apg70 :modes `( 1 ) )", "text.guf:1:19: expected a list of the forms Mode, OffMode"},
        WrongValue{"( Apg70 :antenna ( AntennaServo `( -40 40 ) ) )",
                   "text.guf:1:1: expected scan widths within the gimbal's 80 deg for :modes, found 100 deg"},
        WrongValue{
            "( rgb 1 1 1 )",
            "text.guf:1:1: expected a form that configures something, as ( Apg70 ... ), found ( rgb ... ) alone"},
        WrongValue{"480", "text.guf:1:1: expected a form, as ( Apg70 ... ), found the number 480"},
        WrongValue{":name \"x\"", "text.guf:1:1: expected a form, as ( Apg70 ... ), found a slot"},
        WrongValue{"( Apg70 is= System )", "text.guf:1:9: expected is= in a def-form only, found it in Apg70"}));

TEST(Fidelity, APresetSetsEveryKnobAndEachCanThenBeSetAlone) {
  const auto preset = loaded("( Fidelity :preset 1996 )").radar.fidelity;
  EXPECT_EQ(preset.earth, radar::EarthModel::flat);
  EXPECT_EQ(preset.earth_radius_factor, 1.0);
  EXPECT_FALSE(preset.noise);
  const auto changed = loaded("( Fidelity :noise true :samples 128 :preset 1996 )").radar.fidelity;
  EXPECT_TRUE(changed.noise);
  EXPECT_EQ(changed.samples, 128);
  EXPECT_EQ(changed.earth, radar::EarthModel::flat);
}

TEST(Fidelity, PresetAutoIsStandardWithAutomaticSelection) {
  const auto fidelity = loaded("( Fidelity :preset auto :coreShare 0.5 )").radar.fidelity;
  EXPECT_TRUE(fidelity.automatic);
  EXPECT_EQ(fidelity.name, "standard");
  EXPECT_EQ(fidelity.core_share, 0.5);
  EXPECT_FALSE(loaded("( Fidelity :preset auto )\n( Fidelity :preset fine )").radar.fidelity.automatic);
}

TEST(UnknownForms, AreIgnoredWithAWarningAtTheTopLevelAndAmongModes) {
  const auto configuration = loaded("( Weather :rain 3 )\n( Apg70 :modes `( ( GmtiMode ) ( RealBeamMode :4 256 ) ) )");
  EXPECT_THAT(configuration.warnings, ElementsAre("text.guf:1:1: the form Weather is unknown and ignored",
                                                  "text.guf:2:19: the form GmtiMode is unknown and ignored"));
  EXPECT_EQ(configuration.radar.fidelity.samples, 256);
}

TEST(DefForm, AnUnknownFormFallsBackToItsBase) {
  const auto configuration = loaded(
      "( def-form NewBeamMode is= RealBeamMode 'sidelobes )\n"
      "( Apg70 :modes `( ( NewBeamMode :scanWidths `( 90 60 30 ) :sidelobes 7 ) ) )");
  EXPECT_THAT(configuration.radar.scan_widths_deg, ElementsAre(90, 60, 30));
  EXPECT_THAT(configuration.warnings,
              ElementsAre("text.guf:2:19: the form NewBeamMode is read as its base RealBeamMode",
                          "text.guf:2:59: :sidelobes is read, not used"));
}

TEST(DefForm, FallsBackOverSeveralSteps) {
  const auto configuration = loaded(
      "( def-form A is= RbmAntenna `x )( def-form B is= A `y )\n"
      "( Apg70 :antenna ( B :scanWidths `( 90 60 30 ) :x 1 :y 2 ) )");
  EXPECT_THAT(configuration.radar.scan_widths_deg, ElementsAre(90, 60, 30));
}

TEST(DefForm, AddsItsSlotsAfterThoseOfItsBase) {
  const std::string definition = "( def-form Loud is= Noise 'volume )";
  EXPECT_THAT(loaded(definition + "( Loud -40 4 1 11 )").warnings, Contains(HasSubstr(":volume is read, not used")));
  EXPECT_THAT(refusal(definition + "( Loud -40 4 1 11 12 )"), HasSubstr("expected at most 4 slots in Loud"));
}

TEST(DefForm, WithoutABaseMakesAFormThatIsIgnored) {
  EXPECT_THAT(loaded("( def-form Weather `rain ) ( Weather 3 )").warnings,
              ElementsAre("text.guf:1:28: the form Weather is unknown and ignored"));
}

TEST(DefForm, OfABuiltInFormChangesNothing) {
  const auto configuration =
      loaded("( def-form DedDbase is= DataBase )( def-form rgb `red `green `blue )\n( Noise :floor -50 )");
  EXPECT_THAT(configuration.warnings, IsEmpty());
  EXPECT_EQ(configuration.radar.receiver.noise_floor_db, -50.0);
}

std::tuple<double, double, double> video_of(const std::string& text) {
  return fields(loaded(text).radar.view.colors.video);
}

TEST(Colors, OfASchemeAreThoseOfItsPresetWhereNotGiven) {
  const auto night = loaded("( ColorScheme :symbols ( rgb 0.5 0.6 0.7 ) :preset night )").radar.view.colors;
  EXPECT_EQ(night.preset, radar::ColorPreset::night);
  EXPECT_EQ(fields(night.video), fields(radar::color_preset(radar::ColorPreset::night).video));
  EXPECT_EQ(fields(night.symbols), std::tuple(0.5, 0.6, 0.7));
  const auto gray = loaded("( Apg70 :display ( Window :scheme ( ColorScheme gray ) ) )").radar.view.colors;
  EXPECT_EQ(fields(gray.lines), fields(radar::color_preset(radar::ColorPreset::gray).lines));
}

TEST(Colors, MayBeGivenAsRgbOrHsv) {
  EXPECT_EQ(video_of("( ColorScheme :video ( rgb :blue 0.25 ) )"), std::tuple(0.0, 0.0, 0.25));
  EXPECT_EQ(video_of("( ColorScheme :video ( hsv 120 ) )"), std::tuple(0.0, 1.0, 0.0));
  EXPECT_EQ(video_of("( ColorScheme :video ( hsv 60 0.5 0.8 ) )"), std::tuple(0.8, 0.8, 0.4));
  EXPECT_EQ(video_of("( ColorScheme :video ( hsva 300 1 0.5 1 ) )"), std::tuple(0.5, 0.0, 0.5));
  EXPECT_THAT(loaded("( ColorScheme :video ( rgba 0 1 0 0.5 ) )").warnings,
              ElementsAre("text.guf:1:35: :alpha of rgba is read, not used: all colours are opaque"));
}

TEST(Colors, OfAWindowEndWithThatOfTheVideo) {
  EXPECT_EQ(video_of("( Window :colors `( ( rgb 0 0 0 ) ( rgb 0.1 0.2 0.3 ) ) )"), std::tuple(0.1, 0.2, 0.3));
}

TEST(Colors, MayBeGivenInMessages) {
  EXPECT_EQ(video_of("Radar: { Display: { ColorScheme: { preset: night video: { rgb: { 0.1, 0.2, 0.3 } } } } }"),
            std::tuple(0.1, 0.2, 0.3));
}

TEST(DefForm, ErrorsNameTheirPosition) {
  EXPECT_EQ(refusal("( def-form A is= B )"),
            "text.guf:1:18: expected a form that is known here after is=, found B; define it before this one");
  EXPECT_THAT(refusal("( def-form )"), HasSubstr("text.guf:1:1: expected ( def-form name is= base 'slot ... )"));
  EXPECT_THAT(refusal("( def-form 3 )"),
              HasSubstr("text.guf:1:12: expected the name of the new form, found the number 3"));
  EXPECT_THAT(refusal("( def-form A 3 )"), HasSubstr("text.guf:1:14: expected the name of a slot, as 'alpha"));
  EXPECT_THAT(refusal("( Apg70 :modes `( ( def-form A is= Mode ) ( A ) ) )"),
              HasSubstr("def-form outside all other forms"));
}

TEST(DefForm, HasAtMostAThousandSlotsOfItsOwn) {
  std::string slots;
  for (int i = 0; i < 1000; ++i) slots += " 's" + std::to_string(i);
  EXPECT_TRUE(load_configuration_text("( def-form A" + slots + " )", "text.guf"));
  EXPECT_THAT(refusal("( def-form A" + slots + " 'more )"), HasSubstr("text.guf:1:1: expected at most 1000 new slots"));
}

TEST(Warnings, StopAtTwoHundred) {
  std::string slots;
  for (int i = 0; i < 300; ++i) slots += " :unknown" + std::to_string(i) + " 1";
  EXPECT_EQ(loaded("( Noise" + slots + " )").warnings.size(), 200U);
}

// The GUF sample of the 1996 report, in its original spelling.
TEST(ReportSample, IsReadWithWarnings) {
  const auto configuration = loaded(R"(( Radar
  :display ( Window
    width:      480
    height:     480
    mode: "doublebuffer"
  )
  :modes `(
    ( RealBeamMode
      :scanWidths { 100, 50, 25 }
      :ranges { 4.7, 10, 20, 40, 80, 160 }
      :Display ( RbmDisplay
        width:      `( -0.6, 0.6 )
        height:     `( -0.1, 1.1 )
      )
    )
  )
))");
  EXPECT_EQ(fields(configuration.radar), fields(radar::RadarConfiguration{}));
  EXPECT_THAT(configuration.warnings, Contains("text.guf:3:5: width: is the spelling of 1996; write :width"));
  EXPECT_THAT(configuration.warnings, Contains("text.guf:9:19: { } is the spelling of 1996; write `( 100 50 25 )"));
  EXPECT_THAT(configuration.warnings, Contains("text.guf:1:1: Radar is an old spelling; write System"));
  EXPECT_THAT(configuration.warnings, Contains("text.guf:5:5: :mode is an old spelling; write :bmode"));
}

}  // namespace
}  // namespace yars::config

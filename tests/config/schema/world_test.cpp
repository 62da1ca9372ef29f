// Tests of the GUF forms of materials, sea, rain, jammers, movers, scenes and beacons, and of the beams that measure
// velocity (PVU).
#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "config/schema/slot_text.hpp"
#include "tests/config/support.hpp"

namespace yars::config {
namespace {

using ::testing::ElementsAre;
using testing::fields;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::loaded;
using testing::refusal;

TEST(Materials, AddToTheBuiltInMaterials) {
  const auto defaults = radar::LandConfiguration{}.materials;
  const auto materials =
      loaded("( Materials `( ( Material :code 20 :name \"vineyard\" :gamma -11 ) ) )").radar.world.land.materials;
  ASSERT_EQ(materials.size(), defaults.size() + 1);
  EXPECT_EQ(fields(materials.back()), fields(radar::Material{20, "vineyard", -11.0, 0.0}));
}

TEST(Materials, ChangeOnlyTheSlotsThatAreGiven) {
  const auto materials = loaded("( Materials `( ( Material :code 13 :gamma -18 ) ( Material :cardinal 9 :code 13 ) ) )")
                             .radar.world.land.materials;
  ASSERT_EQ(materials.size(), radar::LandConfiguration{}.materials.size());
  EXPECT_EQ(fields(materials.back()), fields(radar::Material{13, "snow and ice", -18.0, 9.0}));
}

TEST(Materials, AreKeptInAscendingOrderOfCodes) {
  const auto materials =
      loaded("( Materials `( ( Material 31 ) ( Material 14 ) ( Material 20 ) ) )").radar.world.land.materials;
  for (std::size_t i = 1; i < materials.size(); ++i) EXPECT_LT(materials[i - 1].code, materials[i].code);
}

TEST(Materials, RefuseTheCodeOfWaterAndInvalidCodes) {
  EXPECT_THAT(
      refusal("( Materials `( ( Material :code 6 :gamma -30 ) ) )"),
      HasSubstr(
          "text.guf:1:33: expected a code other than 6 (water; the form Sea sets its return) for :code, found 6"));
  EXPECT_THAT(refusal("( Materials `( ( Material :gamma -30 ) ) )"), HasSubstr("expected a code of 1 to 31"));
  EXPECT_THAT(refusal("( Materials `( ( Material :code 32 ) ) )"), HasSubstr("a whole number in [1, 31] for :code"));
}

TEST(Sea, AcceptsAStateOrAWindSpeed) {
  EXPECT_TRUE(std::isnan(loaded("( Sea :windSpeed 20 )").radar.world.sea.state));
  const auto sea = loaded("( Sea :state 3 :polarization vertical :windFrom 180 )").radar.world.sea;
  EXPECT_EQ(sea.state, 3.0);
  EXPECT_EQ(sea.polarization, radar::Polarization::vertical);
  EXPECT_EQ(sea.wind_from_deg, 180.0);
  EXPECT_THAT(refusal("( Sea :state 7 )"), HasSubstr("a number in [0, 6] for :state"));
  EXPECT_THAT(refusal("( Sea :vertical `( 1 2 3 4 ) )"), HasSubstr("a list of 5 numbers"));
}

TEST(Sea, RefusesTheModelOfXBandAtOtherFrequenciesInAnyOrderOfTheForms) {
  const auto sea = loaded("( Sea :model nathanson ) ( Receiver :frequency 12 )").radar.world.sea;
  EXPECT_EQ(sea.model, radar::SeaModel::nathanson);
  EXPECT_EQ(loaded("( Receiver :frequency 7.9 )").radar.world.sea.model, radar::SeaModel::nrl);
  constexpr const char* kExpected =
      "expected a frequency of Receiver from 8 to 12 GHz for :model nathanson of Sea, found ";
  EXPECT_THAT(refusal("( Sea :model nathanson )\n( Receiver :frequency 12.1 )"),
              HasSubstr("text.guf:2:1: " + std::string(kExpected) + "12.1"));
  EXPECT_THAT(refusal("( Receiver :frequency 7.9 )\n( Sea :model nathanson )"),
              HasSubstr("text.guf:2:1: " + std::string(kExpected) + "7.9"));
}

TEST(Rain, AFormWithoutCellsKeepsTheEarlierCells) {
  const auto rain = loaded("( Rain `( ( RainCell 37.5 -123 ) ) ) ( Rain :reflectivityFactor 300 )").radar.world.rain;
  EXPECT_EQ(rain.cells.size(), 1u);
  EXPECT_EQ(rain.reflectivity_factor, 300.0);
}

TEST(Rain, HasNoFactorsOfAttenuationUnlessTheyAreGiven) {
  EXPECT_TRUE(std::isnan(loaded("( Rain )").radar.world.rain.attenuation_factor));
  const auto rain = loaded("( Rain :attenuationFactor 0.01018 :attenuationExponent 1.278 )").radar.world.rain;
  EXPECT_EQ(rain.attenuation_factor, 0.01018);
  EXPECT_EQ(rain.attenuation_exponent, 1.278);
}

TEST(ListsOfForms, AddToTheEarlierOnesWithTheirSlotMore) {
  const auto configuration = loaded(
      "( Rain `( ( RainCell 37.5 -123 ) ) ) ( Rain :moreCells `( ( RainCell 38 -122 ) ) )"
      "( Jammers `( ( Jammer \"a\" 37 -122 ) ) ) ( Jammers :moreJammers `( ( Jammer \"b\" 38 -122 ) ) )"
      "( Movers `( ( Mover \"a\" 37 -122 ) ) ) ( Movers :moreMovers ( Mover \"b\" 38 -122 ) )"
      "( Scenes `( ( Scene \"a.flt\" ) ) ) ( Scenes :moreScenes `( ( Scene \"b.flt\" ) ) )"
      "( Beacons `( ( Beacon \"a\" 37 -122 ) ) ) ( Beacons :moreBeacons `( ( Beacon \"b\" 38 -122 ) ) )");
  const auto& world = configuration.radar.world;
  ASSERT_EQ(world.rain.cells.size(), 2u);
  EXPECT_EQ(world.rain.cells[1].position.latitude_deg, 38.0);
  EXPECT_EQ(world.jamming.jammers.size(), 2u);
  EXPECT_EQ(world.movers.size(), 2u);
  EXPECT_EQ(world.scenes.size(), 2u);
  EXPECT_EQ(world.beacons.beacons.size(), 2u);
  EXPECT_THAT(configuration.warnings, IsEmpty());
  EXPECT_THAT(configuration.notes, IsEmpty());
}

TEST(ListsOfForms, ANoteSaysHowManyFormsReplaceHowMany) {
  const auto rain = loaded(
      "( Rain `( ( RainCell 37.5 -123 ) ( RainCell 38 -123 ) ) )\n"
      "( Rain `( ( RainCell 37 -122 ) ) )");
  EXPECT_THAT(rain.notes,
              ElementsAre("text.guf:2:8: note: :cells of Rain, with 1 form RainCell, replaces 2 of earlier forms; "
                          ":moreCells adds to them instead"));
  EXPECT_THAT(rain.warnings, IsEmpty());
  EXPECT_THAT(loaded("( Route `( ( Point \"1\" 37 -122 ) ) )\n( Route `( ) )").notes,
              ElementsAre("text.guf:2:9: note: :points of Route, with 0 forms Point, replaces 1 of earlier forms"));
}

TEST(Rain, ALaterListOfCellsReplacesAnEarlierList) {
  const auto cells =
      loaded(
          "( Rain :cells `( ( RainCell 10 20 ) ) )\n"
          "( Rain :cells `( ( RainCell 37.5 -123 5 20 15000 ) ( RainCell :latitude 38 :longitude 0 ) ) )")
          .radar.world.rain.cells;
  ASSERT_EQ(cells.size(), 2U);
  EXPECT_EQ(fields(cells[0]), fields(radar::RainCell{{37.5, -123.0}, 9260.0, 20.0, 4572.0}));
  EXPECT_EQ(fields(cells[1]), fields(radar::RainCell{{38.0, 0.0}, 9260.0, 10.0, 4572.0}));
}

TEST(Rain, RefusesACellWithoutPositionAndTooManyCells) {
  EXPECT_THAT(refusal("( Rain :cells `( ( RainCell :radius 5 ) ) )"), HasSubstr("expected a latitude for :latitude"));
  std::string many = "( Rain :cells `( ";
  for (int i = 0; i < 65; ++i) many += "( RainCell 10 20 ) ";
  EXPECT_THAT(refusal(many + ") )"), HasSubstr("expected at most 64 rain cells"));
}

TEST(ListsOfTheWorld, AnEntryOfEachIsReadWithItsDefaultsAndPrinted) {
  const auto check = [](const auto& kind) {
    using Entry = std::decay_t<decltype(kind)>;
    const values::List& list = Entry::Values::list;
    const std::string form(list.form);
    const auto read = loaded("( " + std::string(list.group) + " `( ( " + form + " :latitude 37 :longitude -122 ) ) )");
    const auto& entries = std::get<const std::vector<Entry>&>(radar::lists_of(read.radar.world));
    ASSERT_EQ(entries.size(), 1U) << form;
    EXPECT_EQ(entries[0].position, (geo::GeoPoint{37.0, -122.0}));
    std::size_t index = 0;
    const auto has_default = [&](double value) {
      const values::Field& field = Entry::Values::given[index++];
      EXPECT_TRUE(std::isnan(field.initial) ? std::isnan(value) : field.given(value) == field.initial) << field.name;
    };
    std::apply([&](const auto&... member) { (has_default(member(entries[0])), ...); }, Entry::Values::members);
    EXPECT_EQ(fields(loaded(print_configuration(read.radar)).radar.world), fields(read.radar.world)) << form;
  };
  const radar::WorldConfiguration world;
  std::apply([&](const auto&... list) { (check(typename std::decay_t<decltype(list)>::value_type()), ...); },
             radar::lists_of(world));
}

TEST(Jammers, HaveBandChannelsAndPower) {
  const auto jammers = loaded(
                           "( Jammers `( ( Jammer \"SA\" 37.7 -122.4 :band B :channels `( 3 4 ) :power 50 )\n"
                           "( Jammer :latitude 1 :longitude 2 :altitude 1000 ) ) )")
                           .radar.world.jamming.jammers;
  ASSERT_EQ(jammers.size(), 2U);
  EXPECT_EQ(jammers[0].band, 1);
  EXPECT_EQ(jammers[0].channels, (std::vector<double>{3, 4}));
  EXPECT_EQ(jammers[0].power_w, 50.0);
  EXPECT_TRUE(std::isnan(jammers[0].altitude_m));
  EXPECT_EQ(jammers[1].band, radar::kEveryBand);
  EXPECT_EQ(jammers[1].channels.size(), 8U);
  EXPECT_DOUBLE_EQ(jammers[1].altitude_m, 304.8);
  EXPECT_THAT(refusal("( Jammers `( ( Jammer :latitude 1 :longitude 2 :channels `( 1.5 ) ) ) )"),
              HasSubstr("expected whole numbers for :channels, found 1.5"));
}

TEST(Movers, HaveAPositionASpeedAndAHeading) {
  const auto movers = loaded("( Movers `( ( Mover \"ship\" 37.6 -122.9 15 300 5000 60 ) ) )").radar.world.movers;
  ASSERT_EQ(movers.size(), 1U);
  EXPECT_DOUBLE_EQ(movers[0].speed_mps, 15.0 * 1852.0 / 3600.0);
  EXPECT_EQ(movers[0].cross_section_m2, 5000.0);
  EXPECT_DOUBLE_EQ(movers[0].height_m, 18.288);
  EXPECT_THAT(refusal("( Movers `( ( Mover :name \"x\" ) ) )"), HasSubstr("expected a latitude"));
}

TEST(Movers, HaveTheCrossSectionOfASize) {
  const auto movers = loaded(
                          "( Movers `( ( Mover \"ship\" 37 -122 :displacement 10000 ) ( Mover \"corner\" 37 -122 "
                          ":echo trihedral :edge 0.5 :facing 40 :tilt -10 ) ( Mover \"boat\" 37 -122 :echo steady ) ) )"
                          "( Receiver :frequency 9.7 )")
                          .radar.world.movers;
  ASSERT_EQ(movers.size(), 3U);
  EXPECT_NEAR(movers[0].cross_section_m2, 161'950.0, 50.0);
  EXPECT_EQ(movers[0].echo, radar::TargetEcho::swerling1);
  EXPECT_NEAR(movers[1].cross_section_m2, 274.1, 0.1);
  EXPECT_EQ(movers[1].echo, radar::TargetEcho::trihedral);
  EXPECT_EQ(movers[1].facing_deg, 40);
  EXPECT_EQ(movers[1].tilt_deg, -10);
  EXPECT_EQ(movers[2].cross_section_m2, 1000.0);
  EXPECT_EQ(movers[2].echo, radar::TargetEcho::steady);
}

TEST(Movers, OfASizeArePrintedWithIt) {
  const auto whole = loaded(
      "( Movers `( ( Mover \"ship\" 37 -122 :displacement 10000 ) "
      "( Mover \"corner\" 37 -122 :echo dihedral :edge 0.5 :facing 40 ) ( Mover \"boat\" 37 -122 ) ) )");
  const std::string text = print_configuration(whole.radar);
  EXPECT_THAT(text, HasSubstr(":displacement 10000"));
  EXPECT_EQ(fields(loaded(text).radar), fields(whole.radar)) << text;
}

TEST(Movers, HaveOneSizeThatFitsTheirEcho) {
  const auto refused = [](const std::string& slots) {
    return refusal("( Movers `( ( Mover \"m\" 37 -122 " + slots + " ) ) )");
  };
  EXPECT_THAT(refused(":crossSection 10 :displacement 1000"), HasSubstr("one of crossSection, displacement and edge"));
  EXPECT_THAT(refused(":edge 1"), HasSubstr("the echo trihedral or dihedral"));
  EXPECT_THAT(refused(":facing 3"), HasSubstr("the echo trihedral or dihedral"));
  EXPECT_THAT(refused(":echo trihedral :displacement 1000"), HasSubstr("without a reflector's echo"));
  EXPECT_THAT(refused(":displacement 0"), HasSubstr("[1, 1000000] t"));
  EXPECT_THAT(refused(":displacement 500000"), HasSubstr("at most 10000000 m2"));
  EXPECT_THAT(refused(":echo sometimes"), HasSubstr("swerling1"));
}

TEST(Scenes, HaveAFileAndOptionalPositionHeadingAndHeights) {
  const auto scenes =
      loaded(
          "( Scenes `( ( Scene \"/data/a.flt\" ) ( Scene \"/data/b.flt\" 37.5 ( lat-long W 122 30 0 ) 45 "
          "seaLevel ) ) )")
          .radar.world.scenes;
  ASSERT_EQ(scenes.size(), 2U);
  EXPECT_EQ(scenes[0].file, "/data/a.flt");
  EXPECT_TRUE(std::isnan(scenes[0].position.latitude_deg));
  EXPECT_EQ(scenes[0].heights, radar::SceneHeights::ground);
  EXPECT_EQ(scenes[1].position.longitude_deg, -122.5);
  EXPECT_EQ(scenes[1].heading_deg, 45);
  EXPECT_EQ(scenes[1].heights, radar::SceneHeights::sea_level);
  EXPECT_THAT(refusal("( Scenes `( ( Scene :latitude 1 :longitude 2 ) ) )"), HasSubstr("expected an OpenFlight file"));
  EXPECT_THAT(refusal("( Scenes `( ( Scene \"a.flt\" :latitude 1 ) ) )"), HasSubstr("together, or neither"));
}

TEST(Beacons, HaveAPositionACodeAndATrainOfReplies) {
  const auto beacons = loaded(
                           "( Beacons `( ( Beacon \"KMM\" 37.6 -122.4 :altitude 1000 :code 7 :delay 3 :replies 4 "
                           ":spacing 8 :power 20 )\n"
                           "( Beacon :latitude 1 :longitude 2 ) ) :beaconCode 7 )")
                           .radar.world.beacons;
  EXPECT_EQ(beacons.code, 7);
  ASSERT_EQ(beacons.beacons.size(), 2U);
  EXPECT_EQ(fields(beacons.beacons[0]), fields(radar::Beacon{"KMM", {37.6, -122.4}, 304.8, 7, 3.0, 4, 8.0, 20.0}));
  radar::Beacon defaults;
  defaults.position = {1.0, 2.0};
  EXPECT_EQ(fields(beacons.beacons[1]), fields(defaults));
  EXPECT_THAT(refusal("( Beacons `( ( Beacon :latitude 1 ) ) )"), HasSubstr("expected a longitude"));
  EXPECT_THAT(refusal("( Beacons `( ( Beacon \"x\" 1 2 :replies 1 ) ) )"), HasSubstr("in [2, 6]"));
  std::string many = "( Beacons `( ";
  for (int i = 0; i < 65; ++i) many += "( Beacon \"b\" 10 20 ) ";
  EXPECT_THAT(refusal(many + ") )"), HasSubstr("expected at most 64 beacons"));
}

TEST(Navigation, TakesThreeToEightBeamsThatDoNotLieInOnePlane) {
  const auto navigation =
      loaded("( Navigation :beamAzimuths `( -20 20 0 ) :beamDepressions `( 20 20 45 ) :beamDwell 1 )").radar.navigation;
  EXPECT_EQ(navigation.beam_azimuths_deg, (std::vector<double>{-20, 20, 0}));
  EXPECT_EQ(navigation.beam_depressions_deg, (std::vector<double>{20, 20, 45}));
  EXPECT_EQ(navigation.beam_dwell_s, 1.0);
  EXPECT_THAT(refusal("( Navigation :beamAzimuths `( -20 20 0 ) )"),
              HasSubstr("expected as many as beamAzimuths, 3 for :beamDepressions, found 4"));
  EXPECT_THAT(refusal("( Navigation :beamAzimuths `( 0 0 0 ) :beamDepressions `( 10 30 50 ) )"),
              HasSubstr("expected beams that do not all lie in one plane"));
  EXPECT_THAT(refusal("( Navigation :beamAzimuths `( -20 20 ) )"), HasSubstr(":beamAzimuths"));
}

TEST(World, IsReadFromTheSlotsOfTheRadarWithoutWarning) {
  const auto configuration = loaded(
      "( Apg70 :sea ( Sea :state 1 ) :land ( Land :texture 5 ) :rain ( Rain :cells `( ( RainCell 1 2 ) ) )\n"
      ":jammers ( Jammers :sidelobes -40 ) :movers ( Movers `( ( Mover \"m\" 1 2 ) ) )\n"
      ":scenes ( Scenes `( ( Scene \"a.flt\" ) ) ) :beacons ( Beacons `( ( Beacon \"b\" 1 2 ) ) ) )");
  EXPECT_THAT(configuration.warnings, IsEmpty());
  EXPECT_EQ(configuration.radar.world.sea.state, 1.0);
  EXPECT_EQ(configuration.radar.world.land.texture, 5.0);
  EXPECT_EQ(configuration.radar.world.jamming.sidelobe_db, -40.0);
  EXPECT_EQ(configuration.radar.world.movers.size(), 1U);
  EXPECT_EQ(configuration.radar.world.scenes.size(), 1U);
  EXPECT_EQ(configuration.radar.world.beacons.beacons.size(), 1U);
}

// Writes a file of a sounding, and returns what the configuration says that reads it: its air, or the refusal.
class Sounding : public ::testing::Test {
 protected:
  std::string config_of(const std::string& csv) {
    return "( Atmosphere :profile \"" + folder_.write("sonde.csv", csv).string() + "\" )";
  }
  testing::Folder folder_;
};

TEST_F(Sounding, AnExponentialProfileIsFoundAgain) {
  std::string csv = "height_m,refractivity\n";
  for (int height_m = 10; height_m < 12000; height_m += 400)
    csv += std::to_string(height_m) + "," + std::to_string(340.0 * std::exp(-0.15e-3 * height_m)) + "\n";
  const auto air = loaded(config_of(csv)).radar.world.atmosphere;
  EXPECT_NEAR(air.refractivity, 340.0, 0.01);
  EXPECT_NEAR(air.refractivity_per_km, 0.15, 1e-5);
  EXPECT_EQ(air.profile, "");
}

// The mean annual atmosphere of ITU-R P.835. P.453 gives it 315 N-units that fall by 0.136 per km (h0 = 7.35 km).
TEST_F(Sounding, TheReferenceAtmosphereHasItsRefractivity) {
  const auto air = loaded(config_of("# P.835\nheight_m,pressure_hpa,temperature_c,dewpoint_c,remark\n"
                                    "0,1013.25,15.0,7.2,a\n1000,898.76,8.5,0.2,\n2000,795.0,2.0,,no dew point\n"
                                    "3000,701.1,-4.5,-13.4,\n5000,540.5,-17.5,-27.0,\n10000,265.0,-50.0,-60.0,\n"))
                       .radar.world.atmosphere;
  EXPECT_NEAR(air.refractivity, 315.0, 6.0);
  EXPECT_NEAR(air.refractivity_per_km, 0.136, 0.012);
}

TEST_F(Sounding, DuctsAndFilesOfAnotherKindAreRefused) {
  EXPECT_THAT(refusal(config_of("height_m,refractivity\n0,330\n100,300\n200,295\n300,290\n400,285\n")),
              HasSubstr("sonde.csv:3: expected refractivity that falls by at most 157 N-units per km, found a duct: it "
                        "falls by 300 per km"));
  EXPECT_THAT(refusal(config_of("time,height\n0,330\n")), HasSubstr("expected columns height_m"));
  EXPECT_THAT(refusal(config_of("height_m,refractivity\n0,330\n1000,300\n")), HasSubstr("expected at least 5 levels"));
  EXPECT_THAT(refusal(config_of("height_m,refractivity\n0,330\n1000,300\n900,301\n")),
              HasSubstr("heights that ascend"));
  EXPECT_THAT(refusal("( Atmosphere :profile \"/nowhere/sonde.csv\" )"), HasSubstr("/nowhere/sonde.csv"));
}

}  // namespace
}  // namespace yars::config

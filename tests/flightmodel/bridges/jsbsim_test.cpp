// Tests of the JSBSim bridge with JSBSim's text output, recorded by tests/flightmodel/bridges/jsbsim/record_jsbsim.py,
// and with invalid lines.
#include <gmock/gmock.h>

#include "flightmodel/bridges/bridge.hpp"
#include "tests/flightmodel/bridges/packets.hpp"

namespace yars::flightmodel::bridges {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kLabels =
    "<LABELS> ,Time,lat-geod-deg,long-gc-deg,h-sl-ft,phi-deg,theta-deg,psi-deg,v-north-fps,v-east-fps,v-down-fps\n";
constexpr const char* kLine =
    "        15.2,     36.5312,   -122.4057,    15178.85,    30.05256,    4.046085,    358.0963,    757.1168,   "
    "-33.21016,   -19.79934\n";

std::optional<ExternalSample> sample_from(JsbsimBridge& bridge, std::string_view text) {
  const auto outcome = bridge.receive(bytes_of(text), {});
  EXPECT_TRUE(outcome) << outcome.error().message();
  return outcome ? *outcome : std::nullopt;
}

std::string refusal_from(JsbsimBridge& bridge, std::string_view text) {
  const auto outcome = bridge.receive(bytes_of(text), {});
  return outcome ? "accepted" : outcome.error().message();
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size(); begin = text.find('\n', begin) + 1)
    lines.push_back(text.substr(begin, text.find('\n', begin) + 1 - begin));
  return lines;
}

TEST(Jsbsim, ALineIsReadByTheLabels) {
  JsbsimBridge bridge;
  EXPECT_FALSE(sample_from(bridge, kLabels)) << "labels are no report";
  const auto sample = sample_from(bridge, kLine);
  ASSERT_TRUE(sample);
  const databuffer::Ownship& own = sample->ownship;
  EXPECT_DOUBLE_EQ(own.latitude_deg, 36.5312);
  EXPECT_DOUBLE_EQ(own.longitude_deg, -122.4057);
  EXPECT_DOUBLE_EQ(own.altitude_msl_m, 15178.85 * 0.3048);
  EXPECT_DOUBLE_EQ(own.roll_deg, 30.05256);
  EXPECT_DOUBLE_EQ(own.pitch_deg, 4.046085);
  EXPECT_DOUBLE_EQ(own.heading_deg, 358.0963);
  EXPECT_DOUBLE_EQ(own.velocity_north_mps, 757.1168 * 0.3048);
  EXPECT_DOUBLE_EQ(own.velocity_east_mps, -33.21016 * 0.3048);
  EXPECT_DOUBLE_EQ(own.velocity_down_mps, -19.79934 * 0.3048);
  EXPECT_STREQ(own.source, "jsbsim");
}

TEST(Jsbsim, EveryLineOfARecordedFlightIsAccepted) {
  JsbsimBridge bridge;
  int samples = 0;
  const auto lines = lines_of(text_of_packet("jsbsim/flight.txt"));
  for (const std::string& line : lines) samples += sample_from(bridge, line) ? 1 : 0;
  EXPECT_EQ(samples, 501) << "20 s at 25 Hz, and the initial state";
}

TEST(Jsbsim, ColumnsMayHaveAnyOrderAndNewLabelsReplaceOldOnes) {
  JsbsimBridge bridge;
  sample_from(bridge, kLabels);
  sample_from(bridge,
              "<LABELS> , psi-deg, Time, alpha-deg, velocities/v-down-fps, v-east-fps, /fdm/jsbsim/velocities/"
              "v-north-fps, theta-deg, attitude/phi-deg, h-sl-ft, long-gc-deg, position/lat-geod-deg, Wind");
  const auto sample = sample_from(bridge, "90, 3, 1.5, -10, 700, 1, 2, -3, 10000, 151, -33, fresh");
  ASSERT_TRUE(sample);
  EXPECT_EQ(sample->ownship.latitude_deg, -33.0);
  EXPECT_EQ(sample->ownship.longitude_deg, 151.0);
  EXPECT_EQ(sample->ownship.heading_deg, 90.0);
  EXPECT_EQ(sample->ownship.roll_deg, -3.0);
  EXPECT_EQ(sample->ownship.velocity_down_mps, -10 * 0.3048);
}

TEST(Jsbsim, AGeocentricLatitudeIsRefusedAndTheGeodeticPropertyNamed) {
  JsbsimBridge bridge;
  const std::string refusal = refusal_from(
      bridge,
      "<LABELS> ,Time,lat-gc-deg,long-gc-deg,h-sl-ft,phi-deg,theta-deg,psi-deg,v-north-fps,v-east-fps,v-down-fps");
  EXPECT_THAT(refusal, HasSubstr("position/lat-geod-deg"));
  EXPECT_THAT(refusal, HasSubstr("geocentric"));
  EXPECT_THAT(refusal_from(bridge, kLine), HasSubstr("labels first")) << "refused labels do not apply";
}

// Labels that JSBSim writes for its output group <position> ON.
TEST(Jsbsim, JsbsimsPositionGroupIsRefusedAsGeocentric) {
  JsbsimBridge bridge;
  const auto refusal = refusal_from(bridge, "<LABELS> ,Time,Altitude ASL (ft),Latitude (deg),Longitude (deg)");
  EXPECT_THAT(refusal, HasSubstr("geocentric"));
  EXPECT_THAT(refusal, HasSubstr("velocities/v-down-fps"));
}

TEST(Jsbsim, LabelsWithoutARequiredColumnAreRefusedAndItIsNamed) {
  JsbsimBridge bridge;
  const auto refusal = refusal_from(
      bridge, "<LABELS> ,Time,lat-geod-deg,long-gc-deg,h-sl-ft,phi-deg,theta-deg,v-north-fps,v-east-fps,v-down-fps");
  EXPECT_THAT(refusal, HasSubstr("without attitude/psi-deg"));
  EXPECT_THAT(refusal, Not(HasSubstr("geocentric")));
  EXPECT_THAT(refusal_from(bridge, "<LABELS>"), HasSubstr("without position/lat-geod-deg"));
}

TEST(Jsbsim, NumbersBeforeLabelsAreRefusedWithAnInstruction) {
  JsbsimBridge bridge;
  EXPECT_THAT(refusal_from(bridge, kLine), HasSubstr("start flight-model before JSBSim"));
}

TEST(Jsbsim, ColumnsGivenToTheConstructorReplaceLabels) {
  const auto columns = parse_jsbsim_labels(
      "<LABELS>,Time,lat-geod-deg,long-gc-deg,h-sl-ft,phi-deg,theta-deg,psi-deg,v-north-fps,v-east-fps,v-down-fps");
  ASSERT_TRUE(columns) << columns.error().message();
  JsbsimBridge bridge(*columns);
  EXPECT_TRUE(sample_from(bridge, kLine));
}

TEST(Jsbsim, RepeatedAndOlderLinesAreRefused) {
  JsbsimBridge bridge;
  const auto lines = lines_of(text_of_packet("jsbsim/flight.txt"));
  for (std::size_t i = 0; i < 10; ++i) sample_from(bridge, lines[i]);
  EXPECT_THAT(refusal_from(bridge, lines[9]), HasSubstr("second time"));
  EXPECT_THAT(refusal_from(bridge, lines[7]), HasSubstr("after"));
  EXPECT_TRUE(sample_from(bridge, lines[10]));
}

TEST(Jsbsim, ARestartedJsbsimIsAcceptedFromItsSecondLine) {
  JsbsimBridge bridge;
  const auto lines = lines_of(text_of_packet("jsbsim/flight.txt"));
  for (const std::string& line : lines) sample_from(bridge, line);
  sample_from(bridge, lines[0]);
  EXPECT_THAT(refusal_from(bridge, lines[1]), HasSubstr("the sender may have restarted"));
  EXPECT_TRUE(sample_from(bridge, lines[2]));
}

TEST(Jsbsim, BrokenLinesAreRefusedWithTheReason) {
  JsbsimBridge bridge;
  sample_from(bridge, kLabels);
  EXPECT_THAT(refusal_from(bridge, "1,2,3"), HasSubstr("10 columns"));
  EXPECT_THAT(refusal_from(bridge, ""), HasSubstr("10 columns"));
  EXPECT_THAT(refusal_from(bridge, "1,36,-122,10000,0,0,90,700,0,nan"), HasSubstr("v-down-fps"));
  EXPECT_THAT(refusal_from(bridge, "1,36,-122,10000,0,0,90,700,0,inf"), HasSubstr("v-down-fps"));
  EXPECT_THAT(refusal_from(bridge, "1,91,-122,10000,0,0,90,700,0,0"), HasSubstr("latitude_deg"));
  EXPECT_THAT(refusal_from(bridge, "1,36,-1220,10000,0,0,90,700,0,0"), HasSubstr("longitude_deg"));
  EXPECT_THAT(refusal_from(bridge, "1,36,-122,1e9,0,0,90,700,0,0"), HasSubstr("altitude_msl_m"));
  EXPECT_THAT(refusal_from(bridge, "1,36,-122,10000,0,91,90,700,0,0"), HasSubstr("pitch_deg"));
  EXPECT_THAT(refusal_from(bridge, std::string(kMaxJsbsimLine + 1, '1')), HasSubstr("16384"));
  const std::string shown = refusal_from(bridge, "1,\033[2J\007x,-122,10000,0,0,90,700,0,0");
  EXPECT_THAT(shown, HasSubstr("\"?[2J?x\"")) << "control characters are replaced";
}

// Labels apply to their sender alone. Those of the other sender have latitude and roll (phi) swapped.
TEST(Jsbsim, LabelsApplyOnlyToTheirSender) {
  const Sender jsbsim{"127.0.0.1", 5000};
  const Sender other_sender{"127.0.0.1", 6000};
  JsbsimBridge bridge;
  bridge.set_sender(jsbsim);
  sample_from(bridge, kLabels);
  const auto lines = lines_of(text_of_packet("jsbsim/flight.txt"));
  const auto before = sample_from(bridge, lines[1]);
  ASSERT_TRUE(before);
  bridge.set_sender(other_sender);
  sample_from(bridge,
              "<LABELS> ,Time,phi-deg,long-gc-deg,h-sl-ft,lat-geod-deg,theta-deg,psi-deg,v-north-fps,v-east-fps,"
              "v-down-fps");
  bridge.set_sender(jsbsim);
  const auto after = sample_from(bridge, lines[2]);
  ASSERT_TRUE(after);
  EXPECT_NEAR(after->ownship.latitude_deg, before->ownship.latitude_deg, 0.01);
  EXPECT_NEAR(after->ownship.roll_deg, before->ownship.roll_deg, 5.0);
  bridge.set_sender({"127.0.0.1", 7000});
  EXPECT_THAT(refusal_from(bridge, lines[3]), HasSubstr("labels first")) << "a third sender has no labels";
}

TEST(Jsbsim, AFloodOfSendersWithLabelsDoesNotDisplaceTheFlyingSender) {
  const Sender jsbsim{"127.0.0.1", 5000};
  JsbsimBridge bridge;
  bridge.set_sender(jsbsim);
  sample_from(bridge, kLabels);
  const auto lines = lines_of(text_of_packet("jsbsim/flight.txt"));
  ASSERT_TRUE(sample_from(bridge, lines[1]));
  for (std::uint16_t port = 6000; port < 6100; ++port) {
    bridge.set_sender({"127.0.0.1", port});
    sample_from(bridge, kLabels);
  }
  bridge.set_sender(jsbsim);
  EXPECT_TRUE(sample_from(bridge, lines[2]));
}

}  // namespace
}  // namespace yars::flightmodel::bridges

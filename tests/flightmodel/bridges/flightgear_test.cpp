// Tests of the FlightGear decoder: decoded packets against the values that they were made from. The packets are
// recorded or from tests/flightmodel/bridges/make_packets.py.
#include <gmock/gmock.h>

#include <limits>

#include "databuffer/messages/validation.hpp"
#include "flightmodel/bridges/bridge.hpp"
#include "lib/text/plain_text.hpp"
#include "tests/flightmodel/bridges/packets.hpp"

namespace yars::flightmodel::bridges {
namespace {

using ::testing::HasSubstr;

std::string flightgear_refusal(const PacketBytes& packet) {
  const auto sample = decode_flightgear(packet);
  return sample ? "accepted" : sample.error().message();
}

// The flight of the packets v24.bin and v25.bin.
void expect_the_flight(const ExternalSample& sample) {
  const databuffer::Ownship& own = sample.ownship;
  EXPECT_NEAR(own.latitude_deg, 36.6, 1e-12);
  EXPECT_NEAR(own.longitude_deg, -121.9, 1e-12);
  EXPECT_NEAR(own.altitude_msl_m, 4572.0, 1e-9);
  EXPECT_NEAR(own.heading_deg, 80.0, 1e-5);
  EXPECT_NEAR(own.pitch_deg, 2.5, 1e-6);
  EXPECT_NEAR(own.roll_deg, -15.0, 1e-5);
  EXPECT_NEAR(own.velocity_north_mps, 40.0, 1e-4);
  EXPECT_NEAR(own.velocity_east_mps, 230.0, 1e-4);
  EXPECT_NEAR(own.velocity_down_mps, -5.0, 1e-5);
  EXPECT_STREQ(own.source, "flightgear");
  ASSERT_TRUE(sample.rates);
  EXPECT_NEAR(sample.rates->roll_dps, 1.0, 1e-6);
  EXPECT_NEAR(sample.rates->pitch_dps, 0.5, 1e-6);
  EXPECT_NEAR(sample.rates->heading_dps, -2.0, 1e-6);
}

TEST(FlightGear, Version24With408BytesDecodesToItsFlight) {
  const auto sample = decode_flightgear(packet_of("flightgear/v24.bin"));
  ASSERT_TRUE(sample) << sample.error().message();
  expect_the_flight(*sample);
}

TEST(FlightGear, Version25With552BytesDecodesToTheSameFlight) {
  const auto sample = decode_flightgear(packet_of("flightgear/v25.bin"));
  ASSERT_TRUE(sample) << sample.error().message();
  expect_the_flight(*sample);
}

TEST(FlightGear, SouthAndEastKeepTheirSigns) {
  const auto sample = decode_flightgear(packet_of("flightgear/south_east.bin"));
  ASSERT_TRUE(sample) << sample.error().message();
  EXPECT_NEAR(sample->ownship.latitude_deg, -33.9, 1e-12);
  EXPECT_NEAR(sample->ownship.longitude_deg, 151.2, 1e-12);
  EXPECT_NEAR(sample->ownship.heading_deg, 359.5, 1e-4);
}

// JSBSim wrote this packet, by its output of type FLIGHTGEAR, at the same moment as a line of its text output.
TEST(FlightGear, JsbsimsFlightGearOutputEqualsItsTextOutput) {
  const PacketBytes recorded = packet_of("flightgear/jsbsim_turn.bin");
  const auto sample = decode_flightgear(recorded);
  ASSERT_TRUE(sample) << sample.error().message();
  const databuffer::Ownship& own = sample->ownship;
  // Values of the line of packets/jsbsim/turn.txt, which has seven digits each.
  EXPECT_NEAR(own.latitude_deg, 36.5312, 1e-5);
  EXPECT_NEAR(own.longitude_deg, -122.4057, 1e-4);
  EXPECT_NEAR(own.altitude_msl_m, 15178.85 * 0.3048, 0.01);
  EXPECT_NEAR(own.roll_deg, 30.05256, 1e-4);
  EXPECT_NEAR(own.pitch_deg, 4.046085, 1e-5);
  EXPECT_NEAR(own.heading_deg, 358.0963, 1e-4);
  EXPECT_NEAR(own.velocity_north_mps, 757.1168 * 0.3048, 1e-3);
  EXPECT_NEAR(own.velocity_east_mps, -33.21016 * 0.3048, 1e-3);
  EXPECT_NEAR(own.velocity_down_mps, -19.79934 * 0.3048, 1e-3);
  // A steady turn has g tan(bank) / V = 9.81 tan(30.05 deg) / 231 = 1.41 deg/s. Here the turn is still building up.
  ASSERT_TRUE(sample->rates);
  EXPECT_NEAR(sample->rates->heading_dps, 1.3, 0.2);
  EXPECT_NEAR(sample->rates->roll_dps, 0.0, 0.1);
}

TEST(FlightGear, LengthAndVersionMustAgree) {
  const PacketBytes good = packet_of("flightgear/v24.bin");
  EXPECT_THAT(flightgear_refusal(with<std::uint32_t>(good, 0, 25)), HasSubstr("version 25 and 408 bytes"));
  EXPECT_THAT(flightgear_refusal(with<std::uint32_t>(good, 0, 23)), HasSubstr("version 23"));
  EXPECT_THAT(flightgear_refusal(with<std::uint32_t>(good, 0, 0x18000000)), HasSubstr("version 402653184"));
  for (const std::size_t length : {0U, 1U, 3U, 4U, 88U, 407U, 409U, 552U, 65'507U}) {
    PacketBytes packet = good;
    packet.resize(length);
    EXPECT_THAT(flightgear_refusal(packet), HasSubstr(text::counted(length, "byte")));
  }
}

TEST(FlightGear, InvalidNumbersAndPositionsAreRefusedByName) {
  const PacketBytes good = packet_of("flightgear/v24.bin");
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double bad : {kNan, kInfinity, -kInfinity, 1e300, -7.0}) {
    EXPECT_THAT(flightgear_refusal(with(good, 8, bad)), HasSubstr("longitude"));
    EXPECT_THAT(flightgear_refusal(with(good, 16, bad)), HasSubstr("latitude"));
  }
  EXPECT_THAT(flightgear_refusal(with(good, 8, -122.5)), HasSubstr("expected longitude in radians, found -122.5"));
  EXPECT_THAT(flightgear_refusal(with(good, 16, 37.5)), HasSubstr("expected latitude in radians, found 37.5"));
  for (const double bad : {kNan, kInfinity, -kInfinity, 1e300, -2000.0})
    EXPECT_THAT(flightgear_refusal(with(good, 24, bad)), HasSubstr("altitude"));
  struct Field {
    std::size_t offset;
    const char* name;
  };
  for (const auto& [offset, name] :
       {Field{36, "roll"}, Field{40, "pitch"}, Field{44, "heading"}, Field{56, "rate"}, Field{60, "rate"},
        Field{64, "rate"}, Field{76, "velocity_north"}, Field{80, "velocity_east"}, Field{84, "velocity_down"}})
    for (const float bad :
         {static_cast<float>(kNan), static_cast<float>(kInfinity), -static_cast<float>(kInfinity), 3e38F, -1e6F})
      EXPECT_THAT(flightgear_refusal(with(good, offset, bad)), HasSubstr(name)) << bad;
}

TEST(FlightGear, APitchRoundedBeyond90DegreesIs90Degrees) {
  const auto upright = with(packet_of("flightgear/v24.bin"), 40, static_cast<float>(1.5707963267948966));
  const auto sample = decode_flightgear(upright);
  ASSERT_TRUE(sample) << sample.error().message();
  EXPECT_EQ(sample->ownship.pitch_deg, 90.0);
  const auto inverted = decode_flightgear(with(upright, 36, static_cast<float>(-3.141592653589793)));
  ASSERT_TRUE(inverted) << inverted.error().message();
  EXPECT_EQ(inverted->ownship.roll_deg, -180.0);
}

}  // namespace
}  // namespace yars::flightmodel::bridges

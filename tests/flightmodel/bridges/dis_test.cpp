// Tests of the DIS decoder and bridge: decoded packets against the flight that they were made from. The packets are
// from tests/flightmodel/bridges/make_packets.py, which computes orientation independently, as a product of matrices.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "flightmodel/bridges/bridge_source.hpp"
#include "tests/flightmodel/bridges/packets.hpp"

namespace yars::flightmodel::bridges {
namespace {

using ::testing::HasSubstr;

constexpr geo::Duration kNow = geo::Duration::seconds(50.0);

std::string dis_refusal(const PacketBytes& packet) {
  const auto state = decode_entity_state(packet, no_geoid());
  return state ? "accepted" : state.error().message();
}

// The flight of all packets dis/air*.bin.
void expect_the_flight(const databuffer::Ownship& own) {
  EXPECT_NEAR(own.latitude_deg, 36.6, 1e-9);
  EXPECT_NEAR(own.longitude_deg, -121.9, 1e-9);
  EXPECT_NEAR(own.altitude_msl_m, 4572.0, 1e-3) << "height above the ellipsoid, without the geoid's undulation";
  EXPECT_NEAR(own.heading_deg, 80.0, 1e-4);
  EXPECT_NEAR(own.pitch_deg, 2.5, 1e-4);
  EXPECT_NEAR(own.roll_deg, -15.0, 1e-4);
  EXPECT_NEAR(own.velocity_north_mps, 40.0, 1e-3);
  EXPECT_NEAR(own.velocity_east_mps, 230.0, 1e-3);
  EXPECT_NEAR(own.velocity_down_mps, -5.0, 1e-3);
}

TEST(Dis, AnAirPlatformDecodesToItsFlight) {
  const EntityState state = state_of("dis/air.bin");
  EXPECT_EQ(text_of(state.id), "1,2,3");
  EXPECT_EQ(state.kind, EntityKind::platform);
  EXPECT_EQ(state.domain, EntityDomain::air);
  EXPECT_NEAR(state.stamp.value().seconds(), 100.0, 1e-5);
  expect_the_flight(state.sample.ownship);
  EXPECT_STREQ(state.sample.ownship.source, "dis/ellipsoid");
}

TEST(Dis, VelocityInBodyAxesIsRotatedToNorthEastDown) {
  expect_the_flight(state_of("dis/air_body_axes.bin").sample.ownship);
}

TEST(Dis, ArticulatedPartsAndLaterVersionsChangeNothing) {
  expect_the_flight(state_of("dis/air_version_7.bin").sample.ownship);
  expect_the_flight(state_of("dis/air_articulated.bin").sample.ownship);
}

TEST(Dis, TheDeadReckoningAlgorithmSelectsAccelerationAndRates) {
  const ExternalSample turning = state_of("dis/air_turning.bin").sample;
  EXPECT_NEAR(turning.acceleration_mps2->x, 3.0, 1e-5);
  EXPECT_NEAR(turning.acceleration_mps2->y, -1.0, 1e-5);
  EXPECT_NEAR(turning.acceleration_mps2->z, 0.5, 1e-5);
  // Yaw rate r alone: heading r cos(roll) / cos(pitch), pitch -r sin(roll).
  EXPECT_NEAR(turning.rates->heading_dps, 3.0 * 0.965926 / 0.999048, 1e-4);
  EXPECT_NEAR(turning.rates->pitch_dps, 3.0 * 0.258819, 1e-4);
  const ExternalSample straight = state_of("dis/air.bin").sample;
  EXPECT_EQ(glm::length(*straight.acceleration_mps2), 0.0);
  EXPECT_EQ(straight.rates->heading_dps, 0.0);
}

// Dead reckoning algorithms 6 to 9 work in body axes. 7 and 8 rotate the velocity with the body; 8 and 9 use the
// acceleration, here 5 m/s2 forward.
TEST(Dis, BodyAxesAlgorithmsSelectAccelerationAndTurn) {
  const double heading = 80.0 * geo::kRadiansPerDegree, pitch = 2.5 * geo::kRadiansPerDegree;
  const geo::Vector3 forward{std::cos(pitch) * std::cos(heading), std::cos(pitch) * std::sin(heading),
                             -std::sin(pitch)};
  for (std::uint8_t algorithm = 6; algorithm <= 9; ++algorithm) {
    PacketBytes packet = with(packet_of("dis/air_body_axes.bin"), 88, algorithm);
    put(packet, 104, 5.0F, std::endian::big);
    put(packet, 116, 0.1F, std::endian::big);  // roll rate [rad/s]: about the forward axis
    const auto state = decode_entity_state(packet, no_geoid());
    ASSERT_TRUE(state) << state.error().message();
    expect_the_flight(state->sample.ownship);
    const geo::Vector3 acceleration = (algorithm >= 8 ? 5.0 : 0.0) * forward;
    EXPECT_LT(glm::distance(*state->sample.acceleration_mps2, acceleration), 1e-4) << int{algorithm};
    const geo::Vector3 turn = (algorithm == 7 || algorithm == 8 ? 0.1 : 0.0) * forward;
    EXPECT_LT(glm::distance(state->sample.turn_radps, turn), 1e-6) << int{algorithm};
  }
}

TEST(Dis, WhatIsNoEntityStateIsRefusedWithTheReason) {
  const PacketBytes good = packet_of("dis/air.bin");
  EXPECT_THAT(dis_refusal({}), HasSubstr("0 bytes"));
  EXPECT_THAT(dis_refusal(PacketBytes(good.begin(), good.begin() + 143)), HasSubstr("143 bytes"));
  EXPECT_THAT(dis_refusal(with<std::uint8_t>(good, 0, 4)), HasSubstr("version 5, 6 or 7, found 4"));
  EXPECT_THAT(dis_refusal(with<std::uint8_t>(good, 2, 2)), HasSubstr("type 1"));
  EXPECT_THAT(dis_refusal(with<std::uint8_t>(good, 19, 1)), HasSubstr("160 bytes"));
  EXPECT_THAT(dis_refusal(with<std::uint8_t>(good, 19, 255)), HasSubstr("4224 bytes"));
  EXPECT_THAT(dis_refusal(with<std::uint16_t>(good, 8, 145)), HasSubstr("145 stated"));
  PacketBytes longer = good;
  longer.resize(145);
  EXPECT_THAT(dis_refusal(longer), HasSubstr("145 received"));
}

TEST(Dis, InvalidNumbersAndPositionsAreRefused) {
  const PacketBytes good = packet_of("dis/air.bin");
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const std::size_t offset : {48U, 56U, 64U})
    for (const double bad : {kNan, kInfinity, -kInfinity, 1e300, 1e-300 + 9e6})
      EXPECT_THAT(dis_refusal(with(good, offset, bad)), HasSubstr("location")) << bad;
  PacketBytes centre = good;
  for (const std::size_t offset : {48U, 56U, 64U}) put(centre, offset, 0.0, std::endian::big);
  EXPECT_THAT(dis_refusal(centre), HasSubstr("centre"));
  for (const std::size_t offset : {36U, 40U, 44U, 72U, 76U, 80U})
    for (const double bad : {kNan, kInfinity})
      EXPECT_THAT(dis_refusal(with(good, offset, static_cast<float>(bad))), HasSubstr("numbers")) << offset;
  EXPECT_THAT(dis_refusal(with(good, 36, 3e38F)), HasSubstr("velocity"));
  const PacketBytes turning = packet_of("dis/air_turning.bin");
  EXPECT_THAT(dis_refusal(with(turning, 104, static_cast<float>(kNan))), HasSubstr("acceleration"));
  for (const std::uint8_t algorithm : {std::uint8_t{4}, std::uint8_t{8}})
    for (const float bad : {1e9F, static_cast<float>(kNan)})
      EXPECT_THAT(dis_refusal(with(with(turning, 88, algorithm), 116, bad)), HasSubstr("rate"));
}

TEST(DisBridge, TheFirstAirPlatformIsTheAircraftAndIsLogged) {
  DisBridge bridge(std::nullopt, std::nullopt, no_geoid());
  EXPECT_THAT(bridge.take_log_message().value_or(""), HasSubstr("no grid of a geoid"));
  EXPECT_FALSE(*bridge.receive(packet_of("dis/ship.bin"), kNow));
  EXPECT_THAT(bridge.take_log_message().value_or(""), HasSubstr("exercise 1, the first one heard"));
  const auto sample = bridge.receive(packet_of("dis/air.bin"), kNow);
  ASSERT_TRUE(sample && *sample);
  expect_the_flight((*sample)->ownship);
  EXPECT_THAT(bridge.take_log_message().value_or(""), HasSubstr("1,2,3"));
  EXPECT_FALSE(bridge.take_log_message()) << "logged once";
}

// Without an acceleration ExternalFlight would estimate one from the report before the freeze, and the aircraft would
// drift backwards.
TEST(DisBridge, AFrozenAircraftHasNeitherVelocityNorAcceleration) {
  DisBridge bridge(std::nullopt, std::nullopt, no_geoid());
  constexpr std::uint32_t kFrozen = 1U << 21U;
  const auto sample = bridge.receive(with(packet_of("dis/air.bin"), 84, kFrozen), kNow);
  ASSERT_TRUE(sample && *sample);
  EXPECT_EQ((*sample)->ownship.velocity_east_mps, 0.0);
  ASSERT_TRUE((*sample)->acceleration_mps2);
  EXPECT_EQ(glm::length(*(*sample)->acceleration_mps2), 0.0);
}

TEST(DisBridge, OnlyTheConfiguredEntityIsTheAircraft) {
  DisBridge bridge(EntityId{1, 2, 10}, std::nullopt, no_geoid());
  EXPECT_FALSE(*bridge.receive(packet_of("dis/air.bin"), kNow));
  EXPECT_TRUE(*bridge.receive(packet_of("dis/truck.bin"), kNow));
  ASSERT_EQ(bridge.traffic(kNow).size(), 1U);
  EXPECT_EQ(text_of(bridge.traffic(kNow)[0].id), "1,2,3");
}

TEST(DisBridge, OtherEntitiesAreTrafficWithTheirDomain) {
  DisBridge bridge(std::nullopt, std::nullopt, no_geoid());
  for (const char* name : {"dis/air.bin", "dis/ship.bin", "dis/truck.bin"})
    ASSERT_TRUE(bridge.receive(packet_of(name), kNow)) << name;
  const auto traffic = bridge.traffic(kNow);
  ASSERT_EQ(traffic.size(), 2U);
  EXPECT_EQ(traffic[0].domain, EntityDomain::surface);
  EXPECT_EQ(traffic[1].domain, EntityDomain::land);
  EXPECT_NEAR(traffic[0].state.latitude_deg, 36.7, 1e-9);
}

TEST(DisBridge, OtherPdusAreIgnoredWithoutAnError) {
  DisBridge bridge(std::nullopt, std::nullopt, no_geoid());
  PacketBytes fire(96);
  put<std::uint8_t>(fire, 0, 6, std::endian::big);
  put<std::uint8_t>(fire, 2, 2, std::endian::big);
  put<std::uint16_t>(fire, 8, 96, std::endian::big);
  const auto outcome = bridge.receive(fire, kNow);
  ASSERT_TRUE(outcome) << outcome.error().message();
  EXPECT_FALSE(*outcome);
}

TEST(DisBridge, RepeatedAndOlderReportsAreRefused) {
  DisBridge bridge(std::nullopt, std::nullopt, no_geoid());
  EXPECT_TRUE(*bridge.receive(packet_of("dis/air_version_7.bin"), kNow));
  EXPECT_FALSE(bridge.receive(packet_of("dis/air_version_7.bin"), kNow)) << "the same again";
  EXPECT_FALSE(bridge.receive(packet_of("dis/air.bin"), kNow)) << "a second older";
  EXPECT_TRUE(bridge.receive(packet_of("dis/air_articulated.bin"), kNow));
}

// Entity State PDU of entity 1,2,`entity` at the time `stamp`, in units of 1 h / 2^31.
PacketBytes report_of(std::uint16_t entity, std::uint32_t stamp, bool deactivated = false) {
  PacketBytes packet = packet_of("dis/air.bin");
  put<std::uint16_t>(packet, 16, entity, std::endian::big);
  put<std::uint32_t>(packet, 4, stamp << 1U, std::endian::big);
  if (deactivated) put<std::uint32_t>(packet, 84, 1U << 23U, std::endian::big);
  return packet;
}

// True: the packet's entity is the aircraft.
bool flies(DisBridge& bridge, const PacketBytes& packet, geo::Duration now) {
  const auto outcome = bridge.receive(packet, now);
  EXPECT_TRUE(outcome) << outcome.error().message();
  return outcome && outcome->has_value();
}

TEST(DisBridge, ADeactivatedAircraftIsReplacedByTheNextAirPlatform) {
  DisBridge bridge(std::nullopt, std::nullopt, no_geoid());
  EXPECT_TRUE(flies(bridge, report_of(7, 1000), kNow));
  EXPECT_FALSE(flies(bridge, report_of(8, 1000), kNow)) << "traffic, while entity 7 is the aircraft";
  bridge.take_log_message();
  EXPECT_FALSE(flies(bridge, report_of(7, 2000, true), kNow));
  EXPECT_THAT(bridge.take_log_message().value_or(""), HasSubstr("was deactivated"));
  EXPECT_TRUE(flies(bridge, report_of(8, 2000), kNow));
  EXPECT_THAT(bridge.take_log_message().value_or(""), HasSubstr("1,2,8"));
  EXPECT_TRUE(bridge.traffic(kNow).empty()) << "the new aircraft is no longer traffic";
}

TEST(DisBridge, AnAircraftSilentForTwelveSecondsIsReplaced) {
  DisBridge bridge(std::nullopt, std::nullopt, no_geoid());
  EXPECT_TRUE(flies(bridge, report_of(7, 1000), kNow));
  const auto later = kNow + geo::Duration::seconds(11.0);
  EXPECT_FALSE(flies(bridge, report_of(8, 1000), later));
  const auto too_late = kNow + geo::Duration::seconds(12.5);
  EXPECT_TRUE(flies(bridge, report_of(8, 2000), too_late));
  EXPECT_FALSE(flies(bridge, report_of(7, 9000), too_late)) << "the former aircraft returns as traffic";
}

TEST(DisBridge, TheConfiguredAircraftIsNotReplaced) {
  DisBridge bridge(EntityId{1, 2, 7}, std::nullopt, no_geoid());
  EXPECT_TRUE(flies(bridge, report_of(7, 1000), kNow));
  EXPECT_FALSE(flies(bridge, report_of(7, 2000, true), kNow));
  const auto later = kNow + geo::Duration::seconds(100.0);
  EXPECT_FALSE(flies(bridge, report_of(8, 1000), later));
  EXPECT_TRUE(flies(bridge, report_of(7, 90'000'000), later));
}

PacketBytes joined(const std::vector<PacketBytes>& parts) {
  PacketBytes all;
  for (const PacketBytes& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

TEST(DisBridge, ADatagramMayHaveSeveralPdus) {
  for (const std::size_t padding : {0U, 4U}) {
    DisBridge bridge(std::nullopt, std::nullopt, no_geoid());
    const auto sample = bridge.receive(joined({packet_of("dis/ship.bin"), packet_of("dis/air_articulated.bin"),
                                               packet_of("dis/truck.bin"), PacketBytes(padding)}),
                                       kNow);
    ASSERT_TRUE(sample) << sample.error().message();
    EXPECT_TRUE(*sample);
    EXPECT_EQ(bridge.traffic(kNow).size(), 2U);
  }
}

TEST(DisBridge, OfADamagedBundleTheWholePdusCount) {
  DisBridge bridge(std::nullopt, std::nullopt, no_geoid());
  PacketBytes cut = packet_of("dis/truck.bin");
  cut.resize(100);
  const auto sample = bridge.receive(joined({packet_of("dis/air.bin"), cut}), kNow);
  ASSERT_TRUE(sample);
  EXPECT_TRUE(*sample);
  const auto fault = bridge.receive(joined({packet_of("dis/ship.bin"), cut}), kNow);
  EXPECT_FALSE(fault) << "without the aircraft the fault is told";
  EXPECT_EQ(bridge.traffic(kNow).size(), 1U);
}

TEST(DisBridge, OfSeveralExercisesTheFirstOneHeardCounts) {
  DisBridge bridge(std::nullopt, std::nullopt, no_geoid());
  EXPECT_TRUE(flies(bridge, report_of(7, 1000), kNow));
  bridge.take_log_message();
  for (const std::uint32_t stamp : {1000U, 2000U})
    EXPECT_FALSE(flies(bridge, with<std::uint8_t>(report_of(8, stamp), 1, 9), kNow));
  EXPECT_TRUE(bridge.traffic(kNow).empty());
  const std::string told = bridge.take_log_message().value_or("");
  EXPECT_THAT(told, HasSubstr("exercise 9 is heard too and left out"));
  EXPECT_EQ(told.find("heard too"), told.rfind("heard too")) << "told once";
  const auto later = kNow + geo::Duration::seconds(12.5);
  EXPECT_TRUE(flies(bridge, with<std::uint8_t>(report_of(8, 3000), 1, 9), later)) << "the first exercise has ended";
}

TEST(DisBridge, AConfiguredExerciseStays) {
  DisBridge bridge(std::nullopt, 9, no_geoid());
  EXPECT_FALSE(flies(bridge, report_of(7, 1000), kNow));
  EXPECT_TRUE(flies(bridge, with<std::uint8_t>(report_of(8, 1000), 1, 9), kNow));
  EXPECT_FALSE(flies(bridge, report_of(7, 2000), kNow + geo::Duration::seconds(100.0)));
}

TEST(DisBridge, AStampOfZeroIsNone) {
  DisBridge bridge(std::nullopt, std::nullopt, no_geoid());
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(flies(bridge, report_of(7, 0), kNow));
    EXPECT_FALSE(flies(bridge, report_of(8, 0), kNow));
  }
  EXPECT_EQ(bridge.traffic(kNow).size(), 1U);
}

}  // namespace
}  // namespace yars::flightmodel::bridges

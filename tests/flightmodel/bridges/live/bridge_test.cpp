// Tests of a set whose aircraft comes from a simulated external program by UDP. Its packets reach the radar. Bad
// packets are refused and noted. When it is silent, another source takes over. A flood of packets stalls no role.
#include <gmock/gmock.h>
#include <signal.h>

#include <cmath>
#include <optional>

#include "lib/geo/geodesy.hpp"
#include "lib/memory/byte_order.hpp"
#include "tests/flightmodel/bridges/live/bridged_set.hpp"
#include "tests/flightmodel/bridges/live/udp_peer.hpp"
#include "tests/flightmodel/bridges/packets.hpp"

namespace yars::endtoend {
namespace {

using databuffer::NoteKind;
using flightmodel::bridges::bytes_of;
using flightmodel::bridges::packet_of;
using flightmodel::bridges::PacketBytes;
using flightmodel::bridges::put;
using ::testing::HasSubstr;

constexpr geo::GeoPoint kStart{36.5, -122.5};
constexpr double kSpeed_mps = 240.0;

// Aircraft in straight and level flight along a geodesic, initially to the east, in real time.
class Flyer {
 public:
  geo::GeoPoint position() const {
    const double flown_s = 1e-9 * static_cast<double>(databuffer::monotonic_ns() - began_ns_);
    return ray_.position(geo::Length::metres(kSpeed_mps * flown_s));
  }

  PacketBytes flightgear() const {
    PacketBytes packet = packet_of("flightgear/v24.bin");
    constexpr auto kBig = std::endian::big;
    put(packet, 8, position().longitude_deg * geo::kRadiansPerDegree, kBig);
    put(packet, 16, position().latitude_deg * geo::kRadiansPerDegree, kBig);
    for (const std::size_t rate : {56U, 60U, 64U}) put(packet, rate, 0.0F, kBig);
    for (const std::size_t north_and_down : {76U, 84U}) put(packet, north_and_down, 0.0F, kBig);
    put(packet, 80, static_cast<float>(kSpeed_mps / geo::kMetresPerFoot), kBig);
    return packet;
  }

  // Distance [m] of a latched position from the present position of the aircraft.
  double distance_m(const databuffer::Ownship& own) const {
    return geo::geodesic_inverse(position(), {own.latitude_deg, own.longitude_deg}).distance.metres();
  }

 private:
  std::int64_t began_ns_ = databuffer::monotonic_ns();
  geo::GeodesicRay ray_{kStart, geo::Bearing::degrees(90)};
};

using Bridge = BridgedSet;

TEST_F(Bridge, FlightGearMovesOwnshipAndInItsSilenceAnotherSourceTakesOver) {
  const std::uint16_t port = listen("flightgear:0");
  set_.start("own", {"flight-model", "--source", "fixed:40,-100,15000,90,480"});
  start_radar();
  const UdpPeer peer;
  const Flyer flyer;
  ASSERT_TRUE(eventually([&] { return flown_by("fixed"); }, 30.0));
  const auto flown = [&] {
    peer.send(flyer.flightgear(), port);
    const auto own = latched_from("flightgear");
    return own && flyer.distance_m(*own) < 40.0 && std::abs(own->altitude_msl_m - 4572.0) < 0.5 &&
           std::abs(own->velocity_east_mps - kSpeed_mps) < 0.5;
  };
  ASSERT_TRUE(eventually(flown, 30.0)) << set_.log_of("bridge");
  EXPECT_TRUE(eventually([&] { return flown_by("fixed"); }, 30.0))
      << "while FlightGear is silent, the built-in source takes over";
  ASSERT_TRUE(eventually(flown, 30.0)) << set_.log_of("bridge");
  EXPECT_THAT(set_.log_of("bridge"), HasSubstr("silent"));
  for (const auto& [role, code] : set_.end_all()) EXPECT_EQ(code, 0) << role << ": " << set_.log_of(role);
}

TEST_F(Bridge, BadPacketsGiveFewNotesAndAFloodStallsNoRole) {
  const std::uint16_t port = listen("flightgear:0");
  start_radar();
  const UdpPeer peer, other_sender;
  const Flyer flyer;
  const auto flown = [&] {
    peer.send(flyer.flightgear(), port);
    const auto own = latched_from("flightgear");
    return own && flyer.distance_m(*own) < 40.0;
  };
  ASSERT_TRUE(eventually(flown, 30.0)) << set_.log_of("bridge");
  const std::uint64_t refused_before = notes(databuffer::NoteKind::refusal);
  const PacketBytes garbage = bytes_of("this is no aircraft");
  PacketBytes elsewhere = flyer.flightgear();
  put(elsewhere, 16, 0.0, std::endian::big);
  const auto under_fire = [&] {
    for (int packet = 0; packet < 5'000; ++packet) peer.send(garbage, port);
    // A second program on the same port does not move the aircraft.
    other_sender.send(elsewhere, port);
    peer.send(flyer.flightgear(), port);
    return notes(databuffer::NoteKind::refusal) > refused_before;
  };
  ASSERT_TRUE(eventually(under_fire, 30.0)) << set_.log_of("bridge");
  EXPECT_THAT(set_.log_of("bridge"), HasSubstr("version 24 and 408 bytes"));
  EXPECT_TRUE(eventually(flown, 30.0));
  const std::string log = set_.log_of("bridge");
  EXPECT_LT(std::count(log.begin(), log.end(), '\n'), 60) << "one line for thousands of packets";
  EXPECT_EQ(log.find("elsewhere"), std::string::npos) << log;
  for (const auto& [role, code] : set_.end_all()) EXPECT_EQ(code, 0) << role << ": " << set_.log_of(role);
}

TEST_F(Bridge, AFreezeOfTheSessionStopsTheRadarButNotTheExternalProgram) {
  const std::uint16_t port = listen("flightgear:0");
  start_radar();
  const UdpPeer peer;
  const Flyer flyer;
  const auto flown = [&] {
    peer.send(flyer.flightgear(), port);
    const auto own = latched_from("flightgear");
    return own && flyer.distance_m(*own) < 40.0;
  };
  ASSERT_TRUE(eventually(flown, 30.0)) << set_.log_of("bridge");
  ASSERT_EQ(set_.yars({"sim", "freeze"}).code, 0);
  const auto frozen = latched();
  ASSERT_TRUE(frozen);
  const double frozen_m = flyer.distance_m(*frozen);
  EXPECT_TRUE(eventually(
      [&] {
        peer.send(flyer.flightgear(), port);
        const auto own = latched();
        return own && flyer.distance_m(*own) > frozen_m + 500.0;
      },
      30.0))
      << "the position in the frozen radar stays";
  ASSERT_EQ(set_.yars({"sim", "run"}).code, 0);
  EXPECT_TRUE(eventually(flown, 30.0)) << set_.log_of("bridge");
}

TEST_F(Bridge, ARepositioningDoesNotMoveTheExternalProgram) {
  const std::uint16_t port = listen("flightgear:0");
  start_radar();
  const UdpPeer peer;
  const Flyer flyer;
  const auto flown = [&] {
    peer.send(flyer.flightgear(), port);
    return latched_from("flightgear");
  };
  ASSERT_TRUE(eventually([&] { return flown().has_value(); }, 30.0)) << set_.log_of("bridge");
  ASSERT_EQ(set_.yars({"sim", "reposition", "40", "-100", "20000", "45"}).code, 0);
  const auto flown_in_new_epoch = [&] {
    const auto own = flown();
    return own && own->epoch >= 1;
  };
  EXPECT_TRUE(eventually(flown_in_new_epoch, 30.0)) << "reports continue in the new epoch";
  const auto flown_in_place = [&] {
    const auto own = flown();
    return own && flyer.distance_m(*own) < 40.0;
  };
  EXPECT_TRUE(eventually(flown_in_place, 30.0));
  EXPECT_THAT(set_.log_of("bridge"), HasSubstr("controls the aircraft"));
}

TEST_F(Bridge, XplaneIsSubscribedMovesOwnshipAndIsUnsubscribed) {
  // Two senders with X-Plane's port on two loopback addresses: the one that flight-model subscribes to, and another.
  const UdpPeer xplane;
  const UdpPeer other_sender("127.0.0.2", xplane.port());
  set_.start("bridge", {"flight-model", "--source", "xplane:127.0.0.1:" + std::to_string(xplane.port())});
  start_radar();
  const auto request = xplane.hear(30'000);
  ASSERT_TRUE(request) << set_.log_of("bridge");
  EXPECT_EQ(request->datagram.size(), 413U);
  const PacketBytes reply = packet_of("xplane/level.bin");
  const PacketBytes elsewhere =
      flightmodel::bridges::with(packet_of("xplane/level.bin"), 9, -10.0F, std::endian::little);
  std::optional<databuffer::Ownship> own;
  ASSERT_TRUE(eventually(
      [&] {
        other_sender.send(elsewhere, request->port);
        xplane.send(reply, request->port);
        own = latched_from("xplane");
        return own.has_value();
      },
      30.0))
      << set_.log_of("bridge");
  EXPECT_NEAR(own->latitude_deg, 36.5, 0.1);
  EXPECT_EQ(set_.log_of("bridge").find("elsewhere"), std::string::npos) << set_.log_of("bridge");
  set_.kill("bridge", SIGTERM);
  EXPECT_EQ(set_.wait("bridge"), 0);
  int unsubscribed = 0;
  while (const auto last = xplane.hear(100))
    unsubscribed += memory::little_endian<std::int32_t>(last->datagram, 5) == 0 ? 1 : 0;
  EXPECT_EQ(unsubscribed, 14) << "each dataref is unsubscribed";
}

TEST_F(Bridge, ADisEntityIsOwnshipAndAShipIsTraffic) {
  const std::uint16_t port = listen("dis:0,1,2,3");
  start_radar();
  const UdpPeer peer;
  PacketBytes aircraft = packet_of("dis/air.bin");
  std::uint32_t stamp = 1000;
  std::optional<databuffer::Ownship> own;
  ASSERT_TRUE(eventually(
      [&] {
        put(aircraft, 4, stamp += 20'000, std::endian::big);
        peer.send(packet_of("dis/ship.bin"), port);
        peer.send(aircraft, port);
        own = latched_from("dis");
        return own.has_value();
      },
      30.0))
      << set_.log_of("bridge");
  EXPECT_NEAR(own->latitude_deg, 36.6, 0.1);
  EXPECT_NEAR(own->heading_deg, 80.0, 0.01);
  // The ship is traffic: radar-model latches it as a moving target.
  databuffer::Traffic traffic{};
  EXPECT_TRUE(eventually([&] { return layout().traffic.read(traffic) && traffic.count == 1; }, 30.0));
  EXPECT_NEAR(traffic.entities[0].latitude_deg, 36.7, 0.01);
  EXPECT_TRUE(eventually([&] { return layout().traffic_latched.next() > 0; }, 30.0));
}

TEST_F(Bridge, APortInUseIsReportedAndLeavesNoSession) {
  const UdpPeer other;
  const std::string port = std::to_string(other.port());
  set_.start("bridge", {"flight-model", "--source", "jsbsim:" + port});
  EXPECT_EQ(set_.wait("bridge"), 1);
  EXPECT_THAT(set_.log_of("bridge"), HasSubstr("127.0.0.1:" + port));
  EXPECT_THAT(set_.log_of("bridge"), HasSubstr("another program"));
  EXPECT_FALSE(set_.segment_exists());
}

TEST(BridgeUsage, AnExternalProgramInLockstepIsBadUsage) {
  const auto finished = run_program({"flight-model", "--source", "dis:0", "--lockstep", "flight-model,radar-model"});
  EXPECT_EQ(finished.code, 2) << finished.errors;
  EXPECT_THAT(finished.errors, HasSubstr("its own clock"));
}

}  // namespace
}  // namespace yars::endtoend

// Tests of the X-Plane bridge: its requests for datarefs (values of X-Plane) byte by byte, and decoded replies. The
// replies are from tests/flightmodel/bridges/make_packets.py.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "flightmodel/bridges/bridge.hpp"
#include "lib/memory/byte_order.hpp"
#include "tests/flightmodel/bridges/packets.hpp"

namespace yars::flightmodel::bridges {
namespace {

using ::testing::HasSubstr;

std::string refusal_from(XplaneBridge& bridge, const PacketBytes& packet) {
  const auto outcome = bridge.receive(packet, {});
  return outcome ? "accepted" : outcome.error().message();
}

TEST(Xplane, ARequestHas413BytesInXplanesFormat) {
  const Datagram request = xplane_request(1, 30);
  ASSERT_EQ(request.size(), 413U);
  const std::string text(reinterpret_cast<const char*>(request.data()), request.size());
  EXPECT_EQ(text.substr(0, 5), std::string("RREF\0", 5));
  EXPECT_EQ(memory::little_endian<std::int32_t>(request, 5), 30);
  EXPECT_EQ(memory::little_endian<std::int32_t>(request, 9), 1);
  EXPECT_STREQ(text.c_str() + 13, "sim/flightmodel/position/longitude");
  EXPECT_EQ(text.find_last_not_of('\0'), 13 + std::string("sim/flightmodel/position/longitude").size() - 1);
}

TEST(Xplane, ACompleteReplyGivesAReport) {
  XplaneBridge bridge;
  const auto sample = bridge.receive(packet_of("xplane/level.bin"), {});
  ASSERT_TRUE(sample && *sample);
  const databuffer::Ownship& own = (*sample)->ownship;
  EXPECT_NEAR(own.latitude_deg, 36.5, 1e-5);
  EXPECT_NEAR(own.longitude_deg, -122.0, 1e-5);
  EXPECT_NEAR(own.altitude_msl_m, 3000.0, 1e-3);
  EXPECT_NEAR(own.heading_deg, 26.6, 1e-5);
  EXPECT_NEAR(own.velocity_east_mps, 100.0, 1e-4);
  EXPECT_NEAR(own.velocity_north_mps, 200.0, 1e-4) << "z is south";
  EXPECT_NEAR(own.velocity_down_mps, -2.0, 1e-4);
}

// X-Plane gives velocity in the axes of a reference point, here at 60 degrees north. The aircraft is 1 degree of
// longitude farther east. Seen there, the east axis is turned by 1 deg x sin(60 deg), 0.87 deg, and tilted up by
// 1 deg x cos(60 deg), 0.5 deg.
TEST(Xplane, VelocityIsRotatedFromTheReferencePointToTheAircraft) {
  XplaneBridge bridge;
  const auto sample = bridge.receive(packet_of("xplane/far_from_reference.bin"), {});
  ASSERT_TRUE(sample && *sample);
  const databuffer::Ownship& own = (*sample)->ownship;
  const double turn_deg = std::atan2(own.velocity_north_mps, own.velocity_east_mps) * 180.0 / 3.14159265358979;
  EXPECT_NEAR(std::abs(turn_deg), std::sin(60.25 * 3.14159265358979 / 180.0), 0.01);
  EXPECT_NEAR(std::hypot(own.velocity_north_mps, own.velocity_east_mps, own.velocity_down_mps), 100.0, 1e-3);
  EXPECT_NEAR(own.velocity_down_mps, -100.0 * std::sin(0.5 * 3.14159265358979 / 180.0), 0.02);
}

TEST(Xplane, AReportMayComeInSeveralReplies) {
  XplaneBridge bridge;
  const PacketBytes complete = packet_of("xplane/level.bin");
  const auto part = [&complete](std::size_t from, std::size_t to) {
    const auto at = [&complete](std::size_t index) {
      return complete.begin() + static_cast<std::ptrdiff_t>(5 + 8 * index);
    };
    PacketBytes packet(5 + 8 * (to - from));
    std::copy(at(from), at(to), std::copy(complete.begin(), complete.begin() + 5, packet.begin()));
    return packet;
  };
  EXPECT_FALSE(*bridge.receive(part(0, 5), {}));
  EXPECT_FALSE(*bridge.receive(part(0, 5), {})) << "one part twice is not complete";
  EXPECT_TRUE(*bridge.receive(part(5, 14), {}));
  EXPECT_FALSE(*bridge.receive(part(5, 14), {})) << "each report needs all datarefs again";
}

TEST(Xplane, SubscribesAgainEachSecondOfSilenceAndUnsubscribesAtTheEnd) {
  XplaneBridge bridge;
  EXPECT_EQ(bridge.requests(seconds(5)).size(), kXplaneDatarefs);
  EXPECT_EQ(bridge.requests(seconds(5.5)).size(), 0U);
  EXPECT_EQ(bridge.requests(seconds(6)).size(), kXplaneDatarefs);
  ASSERT_TRUE(bridge.receive(packet_of("xplane/level.bin"), seconds(6.5)));
  EXPECT_EQ(bridge.requests(seconds(7.2)).size(), 0U);
  EXPECT_EQ(bridge.requests(seconds(8)).size(), kXplaneDatarefs);
  const auto closing_datagrams = bridge.closing_datagrams();
  ASSERT_EQ(closing_datagrams.size(), kXplaneDatarefs);
  for (const Datagram& request : closing_datagrams) EXPECT_EQ(memory::little_endian<std::int32_t>(request, 5), 0);
}

TEST(Xplane, BrokenRepliesAreRefusedWithTheReason) {
  const PacketBytes good = packet_of("xplane/level.bin");
  XplaneBridge bridge;
  EXPECT_THAT(refusal_from(bridge, {}), HasSubstr("0 bytes"));
  EXPECT_THAT(refusal_from(bridge, bytes_of("RREF")), HasSubstr("4 bytes"));
  EXPECT_THAT(refusal_from(bridge, bytes_of("DATA,12345678")), HasSubstr("RREF"));
  EXPECT_THAT(refusal_from(bridge, PacketBytes(good.begin(), good.end() - 1)), HasSubstr("116 bytes"));
  constexpr auto kLittle = std::endian::little;
  EXPECT_THAT(refusal_from(bridge, with(good, 9, std::numeric_limits<float>::quiet_NaN(), kLittle)),
              HasSubstr("latitude, a number"));
  EXPECT_THAT(refusal_from(bridge, with(good, 9, 91.0F, kLittle)), HasSubstr("position/latitude in [-90, 90]"));
  EXPECT_THAT(refusal_from(bridge, with(good, 9 + 8 * 7, 181.0F, kLittle)), HasSubstr("lon_ref"));
  EXPECT_THAT(refusal_from(bridge, with(good, 9 + 8 * 3, 3e38F, kLittle)), HasSubstr("velocity"));
  EXPECT_EQ(refusal_from(bridge, good), "accepted");
}

TEST(Xplane, UnknownDatarefsAreIgnored) {
  XplaneBridge bridge;
  const auto with_unknown_dataref = with<std::int32_t>(packet_of("xplane/level.bin"), 5, -1, std::endian::little);
  const auto outcome = bridge.receive(with_unknown_dataref, {});
  ASSERT_TRUE(outcome) << outcome.error().message();
  EXPECT_FALSE(*outcome) << "no report: the latitude is missing";
}

}  // namespace
}  // namespace yars::flightmodel::bridges

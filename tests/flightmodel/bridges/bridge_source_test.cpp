// Tests of bridges' addresses (`flight-model --source KIND:...`), of the gate that admits one sender at a time, and of
// the limited notes about refused packets.
#include "flightmodel/bridges/bridge_source.hpp"

#include <gmock/gmock.h>

#include "flightmodel/bridges/bridge.hpp"
#include "tests/flightmodel/bridges/packets.hpp"

namespace yars::flightmodel::bridges {
namespace {

using ::testing::HasSubstr;

TEST(BridgeSource, ListensOnLoopbackByDefault) {
  for (const char* kind : {"flightgear", "jsbsim", "dis"}) {
    const auto source = open_bridge(std::string(kind) + ":5500");
    ASSERT_TRUE(source) << source.error().message();
    EXPECT_EQ(source->host, "127.0.0.1");
    EXPECT_EQ(source->port, 5500);
    EXPECT_FALSE(source->requests_data);
    const auto given = open_bridge(std::string(kind) + ":0.0.0.0:0");
    ASSERT_TRUE(given) << given.error().message();
    EXPECT_EQ(given->host, "0.0.0.0");
    EXPECT_EQ(given->port, 0);
  }
}

TEST(BridgeSource, XplaneIsAskedForDataAtItsHost) {
  const auto source = open_bridge("xplane:simulator:49000");
  ASSERT_TRUE(source) << source.error().message();
  EXPECT_EQ(source->host, "simulator");
  EXPECT_EQ(source->port, 49000);
  EXPECT_TRUE(source->requests_data);
}

TEST(BridgeSource, ADisAddressMayNameTheEntity) {
  EXPECT_TRUE(open_bridge("dis:3000,1,2,65535"));
  for (const char* text : {"dis:3000,1", "dis:3000,1,2", "dis:3000,1,2,3,4", "dis:3000,1,2,65536", "dis:3000,a,b,c"})
    EXPECT_FALSE(open_bridge(text)) << text;
}

TEST(BridgeSource, ADisAddressMayNameTheExercise) {
  for (const char* text : {"dis:3000,exercise=0", "dis:3000,1,2,3,exercise=255", "dis:239.1.2.3:3000,exercise=7"})
    EXPECT_TRUE(open_bridge(text)) << text;
  for (const char* text :
       {"dis:3000,exercise=256", "dis:3000,exercise=", "dis:3000,exercise=-1", "dis:3000,exercise=1,1,2,3"})
    EXPECT_FALSE(open_bridge(text)) << text;
}

TEST(BridgeSource, AHostMayBeAnIpv6AddressOrAGroup) {
  for (const auto& [text, host] :
       {std::pair{"dis:[::1]:3000", "::1"}, std::pair{"dis:[ff02::1%eth0]:3000,1,2,3", "ff02::1%eth0"},
        std::pair{"flightgear:[::]:0", "::"}, std::pair{"dis:239.1.2.3%lo:3000", "239.1.2.3%lo"}}) {
    const auto source = open_bridge(text);
    ASSERT_TRUE(source) << source.error().message();
    EXPECT_EQ(source->host, host);
  }
  for (const char* text : {"dis:::1:3000", "dis:[::1]", "dis:[::1:3000", "dis:[]:3000", "dis:[[::1]]:3000"})
    EXPECT_FALSE(open_bridge(text)) << text;
}

TEST(BridgeSource, AJsbsimAddressMayNameTheColumns) {
  EXPECT_TRUE(open_bridge(
      "jsbsim:1138,Time,lat-geod-deg,long-gc-deg,h-sl-ft,phi-deg,theta-deg,psi-deg,v-north-fps,v-east-fps,v-down-fps"));
  const auto refused = open_bridge("jsbsim:1138,Time,lat-geod-deg");
  ASSERT_FALSE(refused);
  EXPECT_TRUE(refused.error().bad_usage());
  EXPECT_THAT(refused.error().message(), HasSubstr("position/long-gc-deg"));
}

TEST(BridgeSource, AnInvalidAddressIsBadUsageAndTheMessageShowsTheSyntax) {
  for (const char* text : {"flightgear:", "flightgear:x", "flightgear:-1", "flightgear:65536", "flightgear::5500",
                           "flightgear:5500,1", "flightgear", "jsbsim:", "xplane:49000", "xplane:host:0",
                           "xplane::49000", "xplane:host:49000,1", "dis:", "balloon:1"}) {
    const auto source = open_bridge(text);
    ASSERT_FALSE(source) << text;
    EXPECT_TRUE(source.error().bad_usage()) << text;
    EXPECT_THAT(source.error().message(), HasSubstr("PORT")) << text;
  }
}

TEST(BridgeSource, OnlyExternalProgramsAreBridges) {
  for (const char* text : {"flightgear:1", "jsbsim", "xplane:a:1", "dis:1"}) EXPECT_TRUE(names_bridge(text)) << text;
  for (const char* text : {"", "route:a", "fixed:1,2,3,4,5", "csv:dis", "Dis:1"})
    EXPECT_FALSE(names_bridge(text)) << text;
}

TEST(SenderGate, ASecondSenderIsAdmittedAfterHalfASecondOfSilence) {
  SenderGate gate;
  const Sender first{"127.0.0.1", 1000}, second{"127.0.0.1", 1001};
  EXPECT_TRUE(gate.admits(second, seconds(0)));
  EXPECT_TRUE(gate.taken(first, seconds(0)));
  EXPECT_FALSE(gate.taken(first, seconds(0.1)));
  EXPECT_TRUE(gate.admits(first, seconds(0.2)));
  EXPECT_FALSE(gate.admits(second, seconds(0.6)));
  EXPECT_TRUE(gate.admits(second, seconds(0.61)));
}

TEST(RefusalNotes, TheFirstIsWrittenAtOnceAndMoreWithinFiveSecondsAreCounted) {
  RefusalNotes notes;
  EXPECT_EQ(notes.refused("one", seconds(3)), "one");
  for (int packet = 0; packet < 1'000; ++packet) EXPECT_EQ(notes.refused("another", seconds(3.5)), std::nullopt);
  EXPECT_EQ(notes.refused("last", seconds(8)), "last (and 1000 more refused before)");
  EXPECT_EQ(notes.refused("later", seconds(20)), "later");
  EXPECT_EQ(notes.count(), 1'003U);
}

}  // namespace
}  // namespace yars::flightmodel::bridges

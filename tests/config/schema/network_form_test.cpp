// Tests of the GUF form Network: reading, errors, printing, a file of its own, and what it leaves alone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/schema/slot_text.hpp"
#include "lib/radar/network.hpp"
#include "tests/config/support.hpp"

namespace yars::config {
namespace {

using namespace testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string network(const std::string& slots) {
  return "( Network " + slots + " )";
}

TEST(NetworkForm, OpensNoNetworkByDefault) {
  const radar::NetworkSettings settings;
  EXPECT_THAT(settings.interfaces, ElementsAre("lo"));
  EXPECT_THAT(settings.peers, ElementsAre("127.0.0.1"));
  EXPECT_EQ(fields(loaded(network("")).network.value()), fields(settings));
  EXPECT_EQ(fields(load_network("")->network), fields(settings));
}

TEST(NetworkForm, IsReadSlotBySlot) {
  const auto read = loaded(network(R"(:name "cockpit-2" :priority 20 :domain 7 :interfaces `( "eth0" "wg0" )
    :peers `( "10.77.0.1" "10.77.0.3:7410" "radar_host.lan" ) :topicsIn `( sweeps "outputs" ) :topicsOut input_events
    :participants 8 :mapRowsPerSecond 500 :maxMessageBytes 9000 :security "/etc/yars/identity")"));
  EXPECT_THAT(read.warnings, IsEmpty());
  ASSERT_TRUE(read.network);
  EXPECT_EQ(fields(*read.network), fields(radar::NetworkSettings{"cockpit-2",
                                                                 20,
                                                                 7,
                                                                 {"eth0", "wg0"},
                                                                 {"10.77.0.1", "10.77.0.3:7410", "radar_host.lan"},
                                                                 {"sweeps", "outputs"},
                                                                 {"input_events"},
                                                                 8,
                                                                 500,
                                                                 9000,
                                                                 "/etc/yars/identity"}));
}

TEST(NetworkForm, ALaterFormReplacesSlotsOfAnEarlierOne) {
  const auto read = loaded(network(":domain 3 :priority 5") + network(":domain 4"));
  ASSERT_TRUE(read.network);
  EXPECT_EQ(read.network->domain, 4);
  EXPECT_EQ(read.network->priority, 5);
}

TEST(NetworkForm, TakesEveryTopicByItsName) {
  std::string names;
  for (const std::string_view name : radar::kTopicNames) names.append(name).append(" ");
  const auto read = loaded(network(":topicsOut `( " + names + ")"));
  EXPECT_EQ(read.network.value().topics_out.size(), radar::kTopicNames.size());
}

TEST(NetworkForm, ErrorsNameTheSlot) {
  for (const char* name : {"two words", "a/b", "host.lan", "a123456789012345678901234567890x", "h\xc3\xb6st"})
    EXPECT_THAT(refusal(network(std::string(":name \"") + name + "\"")),
                HasSubstr("expected 1 to 31 letters, digits, - or _ for :name"));
  EXPECT_THAT(refusal(network(":priority 1001")), HasSubstr("a whole number in [0, 1000] for :priority"));
  EXPECT_THAT(refusal(network(":domain 231")), HasSubstr("[0, 230] for :domain"));
  EXPECT_THAT(refusal(network(":domain 1.5")), HasSubstr(":domain"));
  EXPECT_THAT(refusal(network(":interfaces `( )")), HasSubstr("a list of 1 to 8 strings for :interfaces"));
  EXPECT_THAT(refusal(network(":interfaces `( 5 )")), HasSubstr(":interfaces"));
  EXPECT_THAT(refusal(network(":participants 0")), HasSubstr("[1, 32] for :participants"));
  EXPECT_THAT(refusal(network(":mapRowsPerSecond 9")), HasSubstr("[10, 20000] 1/s for :mapRowsPerSecond"));
  EXPECT_THAT(refusal(network(":maxMessageBytes 65001")), HasSubstr("[512, 65000] bytes for :maxMessageBytes"));
  EXPECT_THAT(refusal(network(":security 1")), HasSubstr(":security"));
}

// Names and addresses become XML, in which these characters would be markup.
TEST(NetworkForm, RefusesWhatWouldBeMarkup) {
  for (const char* word : {"", "a b", "<x>", "a\\\"b", "a'b", "a&b", "a/b", "0123456789abcdef"})
    EXPECT_THAT(refusal(network(std::string(":interfaces `( \"lo\" \"") + word + "\" )")),
                HasSubstr("expected names of network interfaces, as `ip link` lists them for :interfaces"))
        << word;
  for (const char* word : {"", "10.0.0.1 10.0.0.2", "<Peer/>", "a\\\"b", "a'b", "a&b", "udp/10.0.0.1"})
    EXPECT_THAT(refusal(network(std::string(":peers `( \"") + word + "\" )")),
                HasSubstr("expected IPv4 addresses or host names for :peers"))
        << word;
}

// Cyclone DDS would send to other computers from the loopback address, and fail each time.
TEST(NetworkForm, RefusesLoBesideOtherInterfaces) {
  for (const char* list : {R"("lo" "eth0")", R"("eth0" "lo")"})
    EXPECT_THAT(
        refusal(network(std::string(":interfaces `( ") + list + " )")),
        HasSubstr("expected \"lo\" alone, or interfaces without it for :interfaces, found \"lo\" beside \"eth0\""));
  EXPECT_TRUE(loaded(network(":interfaces `( \"lo\" )")).network);
  EXPECT_TRUE(loaded(network(":interfaces `( \"eth0\" \"wg0\" )")).network);
}

// Cyclone DDS takes these words and asks nobody.
TEST(NetworkForm, RefusesAddressesThatAreNoComputer) {
  const auto refusal_of = [](const std::string& word) { return refusal(network(":peers `( \"" + word + "\" )")); };
  EXPECT_THAT(refusal_of("fe80::1"), HasSubstr("IPv4 addresses or host names for :peers, found \"fe80::1\", an IPv6"));
  for (const char* word : {"[2001:db8::1]", "fe80::1%eth0"}) EXPECT_THAT(refusal_of(word), HasSubstr("expected IPv4"));
  for (const char* word : {"192.168.10.300", "192.168.10", "1.2.3.4.5", "10..0.1", "7"})
    EXPECT_THAT(refusal_of(word), HasSubstr("such as 192.168.10.2, or host names for :peers")) << word;
  EXPECT_THAT(refusal_of("239.255.0.1"), HasSubstr("found \"239.255.0.1\", a multicast address"));
  EXPECT_THAT(refusal_of("255.255.255.255"), HasSubstr("a broadcast or reserved address"));
  EXPECT_THAT(refusal_of("0.0.0.0"), HasSubstr("the address of none"));
  EXPECT_TRUE(loaded(network(":peers `( \"10.0.0.1:7410\" \"radar\" \"3com.lan\" )")).network);
}

TEST(NetworkForm, AMisspelledTopicHasItsNearestName) {
  EXPECT_THAT(refusal(network(":topicsIn `( sweep )")),
              HasSubstr("for :topicsIn, found \"sweep\"; did you mean 'sweeps'?"));
  EXPECT_THAT(refusal(network(":topicsOut `( sweeps nonsense )")),
              HasSubstr("topics, which are hosts, probes, clock, clock_requests"));
}

TEST(NetworkForm, PrintedReadsBackEqual) {
  const radar::NetworkSettings settings{"a", 1, 2, {"eth0"}, {}, {"sweeps"}, {"outputs", "hosts"}, 3, 20, 600, "/x"};
  EXPECT_EQ(fields(loaded(print_network(settings)).network.value()), fields(settings));
}

// The text of the radar's configuration stays what it was: computers of a session compare it, and each has its Network.
TEST(NetworkForm, IsNoPartOfTheRadar) {
  const auto with = loaded(network(":domain 9"));
  EXPECT_EQ(print_configuration(with.radar), print_configuration(radar::RadarConfiguration{}));
  EXPECT_FALSE(loaded("( Apg70 )").network);
}

TEST(NetworkFile, MayHoldOtherForms) {
  const Folder folder;
  const auto path =
      folder.write("set.guf", "( Apg70 :ranges `( 10 20 ) )\n( Network :domain 5 :security \"identity\" )\n");
  const auto settings = load_network(path);
  ASSERT_TRUE(settings) << settings.error().message();
  EXPECT_EQ(settings->network.domain, 5);
  EXPECT_EQ(settings->network.security, (folder.path() / "identity").string());
}

TEST(NetworkFile, WithoutOneTheFormOfTheConfigurationIsUsed) {
  const Folder folder;
  const auto with = folder.write("with.guf", "( Apg70 :ranges `( 10 20 ) )\n( Network :domain 5 )\n");
  const auto own = folder.write("own.guf", "( Network :domain 7 )\n");
  const auto of_configuration = load_network("", with);
  ASSERT_TRUE(of_configuration) << of_configuration.error().message();
  EXPECT_EQ(of_configuration->network.domain, 5);
  EXPECT_EQ(of_configuration->source, with);
  EXPECT_EQ(of_configuration->radar.ranges_nm, (std::vector<double>{10, 20}));
  const auto of_file = load_network(own, with);
  ASSERT_TRUE(of_file) << of_file.error().message();
  EXPECT_EQ(of_file->network.domain, 7);
  EXPECT_EQ(of_file->source, own);
  EXPECT_EQ(load_network("", own)->source, own);
  EXPECT_EQ(load_network("", folder.write("radar.guf", "( Apg70 )\n"))->source, "");
}

TEST(NetworkFile, WithoutTheFormIsRefused) {
  const Folder folder;
  const auto settings = load_network(folder.write("set.guf", "( Apg70 )\n"));
  ASSERT_FALSE(settings);
  EXPECT_THAT(settings.error().message(), HasSubstr("expected a form Network"));
  EXPECT_FALSE(load_network(folder.path() / "none.guf"));
}

TEST(NetworkFile, TheExampleShowsTheDefaults) {
  auto loaded_example = load_network(std::string(YARS_SOURCE_DIR) + "/config/network.guf");
  ASSERT_TRUE(loaded_example) << loaded_example.error().message();
  radar::NetworkSettings* const example = &loaded_example->network;
  const radar::NetworkSettings defaults;
  EXPECT_NE(example->interfaces, defaults.interfaces);
  EXPECT_EQ(example->peers.size(), 2U);
  example->interfaces = defaults.interfaces;
  example->peers = defaults.peers;
  EXPECT_EQ(fields(*example), fields(defaults));
}

}  // namespace
}  // namespace yars::config

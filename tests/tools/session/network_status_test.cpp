// `yars status` of a session that runs on several hosts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "databuffer/json/status_json.hpp"
#include "databuffer/messages/validation.hpp"
#include "tests/databuffer/session/open_session.hpp"
#include "tests/shm/child_process.hpp"
#include "tools/session/status_text.hpp"

namespace yars::tools {
namespace {

using databuffer::NetworkStatus;
using databuffer::Role;
using databuffer::Session;
using nlohmann::ordered_json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::uint32_t bit(Role role) {
  return 1U << static_cast<unsigned>(role);
}

// The gateway of host `alpha`, which hears `beta` (with the radar model) and `gamma`.
class NetworkStatusTest : public databuffer::testing::OpenSessionTest {
 protected:
  void SetUp() override {
    // A process of its own: the gateway's entries are told from others by their pid.
    machine_.emplace([this] {
      auto session = open("state-machine");
      const auto role = session.claim(Role::state_machine);
      while (role) pause();
    });
    ASSERT_TRUE(shm::testing::wait_until([&] {
      const auto session = Session::open_read_only(name_);
      return session && session->role_is_held(Role::state_machine);
    }));
    gateway_.emplace(open("gateway"));
    role_.emplace(*gateway_->claim(Role::gateway));
    status_.monotonic_ns = databuffer::monotonic_ns();
    status_.joined = 1;
    status_.domain = 7;
    status_.secured = 1;
    status_.takeovers = 1;
    status_.conflicts = 2;
    status_.load = 0.015;
    status_.host_count = 3;
    host(0, "alpha").flags = databuffer::kHostSelf | databuffer::kHostPresent | databuffer::kHostOffsetKnown;
    host(0, "alpha").held_roles = bit(Role::state_machine);
    auto& beta = host(1, "beta");
    beta.flags = databuffer::kHostPresent | databuffer::kHostOffsetKnown | databuffer::kHostOwnsClock;
    beta.held_roles = bit(Role::radar_model) | bit(Role::recorder);
    beta.offset_ns = 3'200'000;
    beta.offset_error_ns = 150'000;
    beta.latency_ns = 210'000;
    beta.received = 1000;
    beta.lost = 3;
    beta.refused = 4;
    beta.repeated = 5;
    host(2, "gamma").flags = databuffer::kHostPresent;
    status_.topic_count = 1;
    status_.topics[0] = {"sweeps", 10, 42'400, 0, 0};
  }
  databuffer::HostStatus& host(std::size_t index, const char* name) {
    std::strcpy(status_.hosts[index].name, name);
    std::strcpy(status_.hosts[index].version, "1.0");
    return status_.hosts[index];
  }
  // An entry as the gateway keeps it for the holder on another host.
  void mirror_radar_model() {
    mirror_.emplace(open("radar-model"));
    mirror_role_.emplace(*mirror_->claim(Role::radar_model));
  }
  databuffer::Status found() {
    if (gateway_) gateway_->layout().network_status.publish(status_);
    return databuffer::status_of(*Session::open_read_only(name_), "test");
  }
  ordered_json status() { return databuffer::status_json(found()); }
  std::string reasons() {
    std::string all;
    for (const std::string& reason : found().health.reasons) all += reason + "\n";
    return all;
  }
  std::string printed() {
    const databuffer::Status object = found();
    ::testing::internal::CaptureStdout();
    print_status(object, {{getpid(), 0.5}});
    return ::testing::internal::GetCapturedStdout();
  }
  static ordered_json role(const ordered_json& status, const std::string& name) {
    for (const auto& entry : status["roles"])
      if (entry["name"] == name) return entry;
    return nullptr;
  }

  NetworkStatus status_{};
  std::optional<shm::testing::ChildProcess> machine_;
  std::optional<Session> gateway_, mirror_;
  std::optional<databuffer::Claim> role_, mirror_role_;
};

TEST_F(NetworkStatusTest, JsonHasTheHostsWithTheirOffsetsAndCounts) {
  const ordered_json network = status()["network"];
  EXPECT_EQ(network["joined"], true);
  EXPECT_EQ(network["domain"], 7);
  EXPECT_EQ(network["secured"], true);
  EXPECT_EQ(network["takeovers"], 1);
  EXPECT_EQ(network["conflicts"], 2);
  ASSERT_EQ(network["hosts"].size(), 3u);
  EXPECT_EQ(network["hosts"][0]["self"], true);
  const auto& beta = network["hosts"][1];
  EXPECT_EQ(beta["name"], "beta");
  EXPECT_EQ(beta["self"], false);
  EXPECT_EQ(beta["present"], true);
  EXPECT_EQ(beta["silent_s"], nullptr);
  EXPECT_EQ(beta["owns_clock"], true);
  EXPECT_DOUBLE_EQ(beta["offset_ms"], 3.2);
  EXPECT_DOUBLE_EQ(beta["offset_error_ms"], 0.15);
  EXPECT_DOUBLE_EQ(beta["latency_ms"], 0.21);
  EXPECT_EQ(beta["lost"], 3);
  EXPECT_EQ(beta["refused"], 4);
  EXPECT_EQ(beta["repeated"], 5);
  EXPECT_EQ(beta["roles"], (ordered_json{"radar-model", "recorder"}));
  EXPECT_EQ(network["hosts"][2]["offset_ms"], nullptr);
  EXPECT_EQ(network["topics"],
            (ordered_json{
                {{"name", "sweeps"}, {"sent", 10}, {"sent_bytes", 42'400}, {"received", 0}, {"received_bytes", 0}}}));
}

TEST_F(NetworkStatusTest, TextHasALineForEachHostAndOneForTheGateway) {
  const std::string text = printed();
  EXPECT_THAT(text, HasSubstr("hosts:"));
  EXPECT_THAT(text, HasSubstr("alpha *"));
  EXPECT_THAT(text, ::testing::ContainsRegex(
                        "beta +yes +3.2 ms +150 us +210 us +3 +4 +5 +radar-model, recorder; sets the clock"));
  EXPECT_THAT(text, ::testing::ContainsRegex("gamma +yes +unknown"));
  EXPECT_THAT(text, HasSubstr("gateway: DDS domain 7, encrypted, 1.5 % of a core, 1 takeover, 2 conflicts"));
}

// Two hosts have a source of one priority. The model uses that of its host, and the other one is in a lane here.
TEST_F(NetworkStatusTest, AnOwnshipOfTheModelsHostAloneIsShown) {
  mirror_radar_model();
  databuffer::ModelStatus model{};
  model.ownship.latitude_deg = 37.5;
  std::strcpy(model.ownship.source, "fixed");
  model.ownship_lane = 0xFFFFFFFFU;
  ASSERT_FALSE(databuffer::validate(model)) << *databuffer::validate(model);
  gateway_->layout().model_status.publish(model);
  EXPECT_EQ(status()["watch"]["ownship"]["source"], "fixed");
  EXPECT_THAT(reasons(), Not(HasSubstr("ownship")));
  model.flags = databuffer::kModelStale;
  gateway_->layout().model_status.publish(model);
  EXPECT_TRUE(status()["watch"]["ownship"].is_null());
  EXPECT_THAT(reasons(), HasSubstr("no ownship"));
}

TEST_F(NetworkStatusTest, ARoleThatAnotherHostHoldsIsNotMissing) {
  const ordered_json before = status();
  EXPECT_EQ(role(before, "radar-model")["pid"], 0) << "not mirrored yet";
  EXPECT_EQ(role(before, "radar-model")["host"], "beta");
  EXPECT_THAT(reasons(), Not(HasSubstr("not running")));
  mirror_radar_model();
  EXPECT_EQ(role(status(), "radar-model")["host"], "beta");
  EXPECT_EQ(role(status(), "state-machine")["host"], "alpha");
  EXPECT_THAT(reasons(), Not(HasSubstr("not running")));
  EXPECT_THAT(printed(), AllOf(::testing::ContainsRegex("radar-model .*on beta"), Not(HasSubstr("NO MODEL"))));
}

TEST_F(NetworkStatusTest, HostsOfFlightModelAndDisplaysAreNamed) {
  using databuffer::kFirstProcessBit;
  status_.hosts[2].held_roles = 1U << kFirstProcessBit | 1U << (kFirstProcessBit + 1) | 1U << (kFirstProcessBit + 4);
  EXPECT_EQ(status()["network"]["hosts"][2]["roles"], (ordered_json{"flight-model", "input-monitor", "radar-display"}));
  EXPECT_THAT(printed(), ::testing::ContainsRegex("gamma .*flight-model, input-monitor, radar-display"));
}

TEST_F(NetworkStatusTest, RestartsOfTheGatewayAreCounted) {
  EXPECT_EQ(role(status(), "gateway")["restarts"], 0);
  gateway_->count_restart("gateway");
  EXPECT_EQ(role(status(), "gateway")["restarts"], 1);
  EXPECT_THAT(reasons(), HasSubstr("gateway was started again once in the last minute"));
}

TEST_F(NetworkStatusTest, TheHolderOfARoleForAnotherHostIsTheGateway) {
  mirror_radar_model();
  Session second = open("gateway");
  const std::string pid = std::to_string(getpid());
  auto claim = second.claim(Role::gateway);
  ASSERT_FALSE(claim);
  EXPECT_THAT(claim.error().message(), HasSubstr("found held by gateway, pid " + pid + ";"));
  claim = second.claim(Role::radar_model);
  ASSERT_FALSE(claim);
  EXPECT_THAT(claim.error().message(),
              HasSubstr("found held by gateway, pid " + pid + ", for another host; end it there, or wait"));
}

TEST_F(NetworkStatusTest, ARoleOfAHostThatHasGoneIsMissing) {
  mirror_radar_model();
  status_.hosts[1].flags &= ~std::uint32_t{databuffer::kHostPresent};
  status_.hosts[1].heard_ns = databuffer::monotonic_ns() - 12'000'000'000;
  EXPECT_EQ(role(status(), "radar-model")["host"], nullptr);
  EXPECT_THAT(reasons(),
              AllOf(HasSubstr("radar-model is not running"), HasSubstr("host beta has been silent for 12 s")));
  EXPECT_THAT(printed(), AllOf(HasSubstr("silent 12.0 s"), HasSubstr("DEGRADED")));
}

TEST_F(NetworkStatusTest, AStandbyIsNoHolder) {
  const Session standby = open("radar-model standby");
  status_.hosts[1].held_roles = 0;
  EXPECT_THAT(reasons(), HasSubstr("radar-model is not running"));
}

TEST_F(NetworkStatusTest, DifferencesBetweenHostsAreReasons) {
  status_.hosts[1].flags |= databuffer::kHostOtherTerrain | databuffer::kHostOtherConfiguration;
  status_.hosts[2].flags |= databuffer::kHostOtherLayout;
  status_.hosts[0].flags |= databuffer::kHostSameName;
  EXPECT_THAT(reasons(),
              AllOf(HasSubstr("host beta has another terrain"), HasSubstr("host beta has another configuration"),
                    HasSubstr("host gamma has another layout"), HasSubstr("host alpha has the name of another")));
  EXPECT_THAT(printed(), AllOf(HasSubstr("other configuration, other terrain"), HasSubstr("same name")));
}

TEST_F(NetworkStatusTest, AGatewayThatHasNotJoinedIsAReason) {
  status_.joined = 0;
  EXPECT_THAT(reasons(), HasSubstr("the session clock of the hosts is not known yet"));
}

TEST_F(NetworkStatusTest, ARecordIsShownWhileItsWriterRuns) {
  databuffer::RecorderStatus written{};
  written.bytes = 20'140'000;
  written.writing = 1;
  gateway_->layout().recorder_status.publish(written);
  host(1, "beta").held_roles = bit(Role::radar_model);
  EXPECT_EQ(status()["recorder"], nullptr);
  role_.reset();
  gateway_.reset();
  const auto recorder = open("recorder");
  EXPECT_EQ(status()["recorder"], (ordered_json{{"bytes", 20'140'000}, {"writing", true}, {"problem", nullptr}}));
  EXPECT_THAT(printed(), HasSubstr("\nrecorder: 20.1 MB, writing\n"));
}

TEST_F(NetworkStatusTest, WithoutAGatewayThereIsNoNetwork) {
  mirror_radar_model();
  ASSERT_NE(status()["network"], nullptr);
  role_.reset();
  const ordered_json object = status();
  EXPECT_EQ(object["network"], nullptr);
  EXPECT_EQ(role(object, "state-machine")["host"], nullptr);
  EXPECT_THAT(printed(), Not(HasSubstr("hosts:")));
}

TEST_F(NetworkStatusTest, AGatewayThatDiedWithRolesOfOtherHostsIsMissing) {
  gateway_->layout().network.mirrored_roles.store(bit(Role::radar_model));
  EXPECT_THAT(reasons(), Not(HasSubstr("gateway is not running")));
  role_.reset();
  gateway_.reset();
  EXPECT_THAT(reasons(), AllOf(HasSubstr("gateway is not running"), HasSubstr("radar-model is not running")));
}

TEST_F(NetworkStatusTest, TheGatewaysFurtherEntriesAreNotListed) {
  const Session traffic = open("gateway");
  int gateways = 0;
  const ordered_json object = status();
  for (const auto& entry : object["roles"]) gateways += entry["name"] == "gateway" ? 1 : 0;
  EXPECT_EQ(gateways, 1);
}

TEST_F(NetworkStatusTest, ADamagedRecordCountsAsAbsent) {
  const NetworkStatus good = status_;
  const auto is_refused = [&] {
    const bool refused = databuffer::validate(status_).has_value() && status()["network"].is_null();
    status_ = good;
    return refused;
  };
  status_.host_count = 17;
  EXPECT_TRUE(is_refused());
  status_.topic_count = 25;
  EXPECT_TRUE(is_refused());
  status_.hosts[1].name[0] = '\x1b';
  EXPECT_TRUE(is_refused());
  std::fill(std::begin(status_.hosts[1].name), std::end(status_.hosts[1].name), 'x');
  EXPECT_TRUE(is_refused());
  status_.topics[0].name[2] = '\n';
  EXPECT_TRUE(is_refused());
  status_.load = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(is_refused());
  status_.joined = 2;
  EXPECT_TRUE(is_refused());
  status_.domain = 233;
  EXPECT_TRUE(is_refused());
  status_.hosts[2].priority = databuffer::kMaxHostPriority + 1;
  EXPECT_TRUE(is_refused());
  status_.hosts[5].name[0] = '\x1b';
  EXPECT_FALSE(databuffer::validate(status_)) << "a host beyond the count is not read";
}

// Times have no range: a damaged record may hold any.
TEST_F(NetworkStatusTest, AnyTimesArePrinted) {
  for (const std::int64_t time_ns :
       {std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max()}) {
    status_.monotonic_ns = time_ns;
    for (auto& host : status_.hosts) {
      host.heard_ns = host.offset_ns = host.offset_error_ns = host.latency_ns = time_ns;
      host.flags &= ~std::uint32_t{databuffer::kHostPresent};
      host.lost = host.refused = host.repeated = std::numeric_limits<std::uint64_t>::max();
    }
    EXPECT_THAT(printed(), HasSubstr("host beta has been silent for"));
  }
}

}  // namespace
}  // namespace yars::tools

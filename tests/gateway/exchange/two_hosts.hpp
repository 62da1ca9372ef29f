// Fixture: the gateway of host `alpha` on a real session, without a network. The test hands it the samples of hosts
// `beta` and `gamma`.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "databuffer/messages/derived_values.hpp"
#include "databuffer/messages/validation.hpp"
#include "gateway/exchange/context.hpp"
#include "tests/databuffer/session/open_session.hpp"

namespace yars::gateway::testing {

using databuffer::Role;

constexpr std::uint32_t bit(Role role) {
  return 1U << static_cast<unsigned>(role);
}

inline databuffer::Ownship good_ownship() {
  databuffer::Ownship own{};
  own.latitude_deg = 36.6;
  own.longitude_deg = -121.9;
  own.altitude_msl_m = 5000.0;
  own.velocity_north_mps = 200.0;
  own.radar_altitude_m = std::nan("");
  std::strcpy(own.source, "fixed");
  return own;
}

inline databuffer::InputEvent good_event(std::uint32_t number) {
  databuffer::InputEvent event{};
  event.kind = static_cast<std::uint16_t>(databuffer::EventKind::push_button);
  event.argument = 1;
  event.number = number;
  event.monotonic_ns = databuffer::monotonic_ns();
  return event;
}

class TwoHosts : public databuffer::testing::OpenSessionTest {
 protected:
  static constexpr std::int64_t kSecond_ns = 1'000'000'000;
  static constexpr std::uint64_t kSegment = 2002, kBetaSegment = 3003;

  TwoHosts()
      : session_(open("gateway")),
        role_(*session_.claim(Role::gateway)),
        hosts_(session_, nullptr, {"alpha", 0, 1001, kSegment, 0, 0}),
        roles_(session_, name_),
        context_{session_, nullptr, hosts_, roles_},
        began_ns_(databuffer::monotonic_ns()) {
    context_.now_ns = began_ns_;
  }

  // Announces a host with these roles.
  void announce(const std::string& name, std::uint32_t held_roles, std::uint64_t segment = kBetaSegment,
                std::uint32_t owns_clock = 0, std::uint32_t epoch = 0) {
    auto sample = from<yars_net_HostSample>(name);
    sample.segment = segment;
    sample.layout_hash = databuffer::kLayoutIdentity.hash;
    sample.held_roles = held_roles;
    sample.owns_clock = owns_clock;
    sample.epoch = epoch;
    sample.protocol = yars_net_kProtocol;
    sample.group = 1;
    sample.machine_term = (held_roles & bit(Role::state_machine)) != 0 ? sample.host ^ segment : 0;
    name.copy(sample.name, sizeof sample.name - 1);
    hosts_.receive(sample, true, context_.now_ns);
    roles_.update(hosts_, context_.now_ns);
  }
  void end(const std::string& name) {
    yars_net_HostSample sample{};
    sample.host = host_id(name);
    hosts_.receive(sample, false, context_.now_ns);
    roles_.update(hosts_, context_.now_ns);
  }
  void pass(std::int64_t elapsed_ns) {
    context_.now_ns += elapsed_ns;
    roles_.update(hosts_, context_.now_ns);
  }
  // A local process takes the role.
  void hold(Role role) {
    auto& holder = local_.emplace_back(open(std::string(databuffer::name_of(role))), std::nullopt);
    holder.second.emplace(*holder.first.claim(role));
    roles_.update(hosts_, context_.now_ns);
  }
  void release(Role role) {
    for (auto& [session, claim] : local_)
      if (claim && session.role_is_held(role)) claim.reset();
    roles_.update(hosts_, context_.now_ns);
  }
  // An empty sample of a host, with the next number of its topic. Each host has one process.
  template <class Sample>
  Sample from(const std::string& name) {
    Sample sample{};
    sample.host = host_id(name);
    sample.start = sample.host ^ 0x5555U;
    sample.number = numbers_[{name, dds::index_of(dds::kTopicOf<Sample>)}]++;
    return sample;
  }
  std::uint64_t refusals() const {
    return session_.layout().note_counts[static_cast<std::size_t>(databuffer::NoteKind::refusal)].load();
  }
  const databuffer::SessionLayout& layout() const { return session_.layout(); }

  databuffer::Session session_;
  databuffer::Claim role_;
  Hosts hosts_;
  Roles roles_;
  Context context_;
  std::int64_t began_ns_;

 private:
  std::deque<std::pair<databuffer::Session, std::optional<databuffer::Claim>>> local_;
  std::map<std::pair<std::string, std::size_t>, std::uint64_t> numbers_;
};

}  // namespace yars::gateway::testing

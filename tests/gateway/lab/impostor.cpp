// A member of a network that says what is not true, with the certificate of its host: claims of roles and of the clock,
// samples in the name of another host, requests to the owner of the clock, worlds.
// usage: impostor SESSION FILE TARGET SECONDS     FILE: form Network; TARGET: name of the host that it poses as
// Outputs: one line: how many samples of each kind DDS accepted, and how many it refused.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <thread>

#include "config/schema/load.hpp"
#include "gateway/dds/link.hpp"
#include "gateway/host_agreement.hpp"

namespace {

using namespace yars;

constexpr std::uint64_t kAhead = 1'000'000;  // its sample numbers are beyond those of the target
constexpr std::uint32_t kAllRoles = 0xFFFF'FFFFU;

class Impostor {
 public:
  Impostor(gateway::dds::Link link, std::string name, const std::string& target)
      : link_(std::move(link)), name_(std::move(name)), target_(gateway::host_id(target)) {}

  void step() {
    link_.take_hosts([this](const yars_net_HostSample& sample, bool alive) {
      if (alive) heard_[sample.host] = sample;
    });
    ++number_;
    claim_everything();
    if (heard_.contains(target_)) pose_as(heard_[target_]);
    for (const auto& [id, host] : heard_)
      if (host.owns_clock != 0) stop_clock_of(host);
    for (const auto& [id, host] : heard_) change_world_of(host);
  }
  void report() const {
    for (const auto& [what, count] : accepted_) std::printf("%s %d ", what.c_str(), count);
    std::printf("refused %d\n", refused_);
  }

 private:
  template <class Sample>
  void write(const std::string& what, const Sample& sample) {
    if (link_.write(sample))
      ++accepted_[what];
    else
      ++refused_;
  }
  void claim_everything() {
    yars_net_HostSample claim = heard_.empty() ? yars_net_HostSample{} : heard_.begin()->second;  // the same layout
    std::snprintf(claim.name, sizeof claim.name, "%s", name_.c_str());
    claim.host = gateway::host_id(name_);
    claim.start = start_;
    claim.number = number_;
    claim.held_roles = kAllRoles;
    claim.processes = kAllRoles;
    claim.owns_clock = 1;
    claim.priority = 1000;
    claim.group = 16;
    claim.epoch += 1000;
    write("claims", claim);
  }
  void pose_as(yars_net_HostSample target) {
    yars_net_InputEventSample event{};
    event.host = target.host;
    event.start = target.start;
    event.segment = target.segment;
    event.number = kAhead + number_;
    for (const auto& [id, host] : heard_)
      if (host.machine_term != 0) event.machine_term = host.machine_term;
    event.event.kind = 1;
    event.event.argument = 1;
    write("events", event);
    yars_net_ProbeSample answer{};
    for (const auto& [id, host] : heard_) {
      answer = {id, target.host, 1, 0, 1, 9'000'000'000, 9'000'000'000};
      write("answers", answer);
    }
    target.number += kAhead + number_;
    target.held_roles = 0;
    target.owns_clock = 0;
    write("announcements", target);
    if (number_ % 2 == 0) link_.dispose(target);
  }
  void stop_clock_of(const yars_net_HostSample& owner) {
    yars_net_ClockRequestSample request{};
    request.host = gateway::host_id(name_);
    request.start = start_;
    request.number = number_;
    request.owner = owner.host;
    request.new_epoch = 1;
    request.clock.base_monotonic_ns = owner.monotonic_ns;
    request.clock.epoch = owner.epoch;
    request.before = request.clock;
    request.before.running = 1;
    request.before.rate = 1.0;
    write("requests", request);
  }
  void change_world_of(const yars_net_HostSample& host) {
    yars_net_WorldRequestSample request{};
    request.host = gateway::host_id(name_);
    request.start = start_;
    request.number = request.request = number_;
    request.owner = host.host;
    request.world.edit = 1;
    request.world.source_time_ns = host.monotonic_ns;
    write("worlds", request);
    yars_net_LatchedWorldSample latched{};
    latched.host = host.host;
    latched.start = host.start;
    latched.segment = host.segment;
    latched.number = latched.ring_number = kAhead + number_;
    write("worlds", latched);
    yars_net_WorldSample world{};
    world.host = host.host;
    world.start = host.start;
    world.number = kAhead + number_;
    write("worlds", world);
  }

  gateway::dds::Link link_;
  std::string name_;
  std::uint64_t target_, start_ = 4242, number_ = 0;
  std::map<std::uint64_t, yars_net_HostSample> heard_;
  std::map<std::string, int> accepted_;
  int refused_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) {
    std::fprintf(stderr, "usage: impostor SESSION FILE TARGET SECONDS\n");
    return 2;
  }
  const auto loaded = config::load_network(argv[2]);
  auto link = loaded ? gateway::dds::Link::open(loaded->network, argv[1]) : tl::unexpected(loaded.error());
  if (!link) {
    std::fprintf(stderr, "impostor: %s\n", link.error().message().c_str());
    return 2;
  }
  Impostor impostor(std::move(*link), loaded->network.name, argv[3]);
  constexpr int kStepsPerSecond = 50;
  for (int step = 0; step < std::atoi(argv[4]) * kStepsPerSecond; ++step) {
    impostor.step();
    std::this_thread::sleep_for(std::chrono::milliseconds(1000 / kStepsPerSecond));
  }
  impostor.report();
  return 0;
}

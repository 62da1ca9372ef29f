#include "gateway/exchange/hosts.hpp"

#include <cstdio>

#include "lib/text/plain_text.hpp"

namespace yars::gateway {

namespace {

using databuffer::NoteKind;

constexpr std::int64_t kProbeInterval_ns = 250'000'000;
constexpr std::int64_t kFirstProbeInterval_ns = 25'000'000;  // of the first kFirstProbes, so that a host joins quickly
constexpr std::size_t kFirstProbes = 12;
constexpr std::int64_t kClaimPatience_ns = 3'000'000'000;
constexpr std::uint32_t kOtherClaims = 1U << 31U;  // of Host::differences: roles or the clock that it may not have
constexpr std::int64_t kGroupDelay_ns = 1'000'000'000;

std::optional<std::string> fault_of(const yars_net_HostSample& sample) {
  for (const std::string_view text : {text::text_of(sample.name), text::text_of(sample.version)})
    if (text.size() == sizeof sample.name ||
        !std::ranges::all_of(text, [](char letter) { return letter >= ' ' && letter <= '~'; }))
      return "name and version: expected printable ASCII";
  if (sample.name[0] == '\0' || host_id(text::text_of(sample.name)) != sample.host)
    return "host: expected the hash of its name, found another number";
  if (sample.priority > databuffer::kMaxHostPriority)
    return "priority: expected at most " + std::to_string(databuffer::kMaxHostPriority) + ", found " +
           std::to_string(sample.priority);
  return std::nullopt;
}

}  // namespace

Hosts::Hosts(databuffer::Session& session, dds::Link* link, Identity identity)
    : session_(&session), link_(link), identity_(std::move(identity)) {
  views_.push_back({host_id(identity_.name), identity_.name, identity_.priority});
  own_.segment = identity_.segment;
  own_.layout_hash = databuffer::kLayoutIdentity.hash;
  own_.configuration_hash = identity_.configuration_hash;
  own_.terrain_hash = identity_.terrain_hash;
  own_.priority = identity_.priority;
  own_.protocol = yars_net_kProtocol;
  text::put_text(own_.name, identity_.name);
  text::put_text(own_.version, YARS_VERSION);
}

// The stored history of all instances of a host.
std::uint64_t Hosts::max_repeats(dds::Topic topic) {
  constexpr std::uint64_t kStates = 4, kMapRows = 16384, kLanes = databuffer::kInputLanes;
  if (topic == dds::Topic::patch_rows || topic == dds::Topic::patch_maps) return kMapRows;
  const auto depth = static_cast<std::uint64_t>(settings_of(topic).depth);
  return depth == 1 ? kStates * kLanes : depth * (topic == dds::Topic::input_events ? kLanes : 1) + kStates;
}

void Hosts::exchange(std::int64_t now_ns) {
  // After a pause of this process (SIGSTOP, a loaded machine) the silence is its own. The others get another lease.
  if (last_pass_ns_ != 0 && now_ns - last_pass_ns_ > kLease_ns) {
    paused_until_ns_ = now_ns + kLease_ns;
    for (Host& host : hosts_) host.heard_ns = now_ns;
  }
  if (link_ != nullptr)
    link_->take_hosts([&](const yars_net_HostSample& sample, bool alive) { receive(sample, alive, now_ns); });
  for (Host& host : hosts_)
    if (host.alive && now_ns - host.heard_ns > kLease_ns) lose(host);
  update_group(now_ns);
  announce(now_ns);
  ask(now_ns);
}

void Hosts::receive(const yars_net_HostSample& sample, bool alive, std::int64_t now_ns) {
  if (!alive) {
    if (Host* host = host_of(sample.host, false); host != nullptr && host->alive && now_ns >= paused_until_ns_) {
      host->left = now_ns - host->heard_ns < kLease_ns;
      lose(*host);
    }
    return;
  }
  if (sample.host == self().id) return hear_own_name(sample.start, now_ns);
  if (const auto fault = fault_of(sample)) return refuse(sample, *fault);
  Host* host = host_of(sample.host, true);
  if (host == nullptr) return;
  host->name.hear(sample.start, now_ns);
  if (host->name.is_news(now_ns))
    say(log::error, NoteKind::loss, "two hosts are called " + host->view.name + "; give each a `name` of its own");
  if (!host->alive) readmit(*host, sample.start);
  if (!host->numbers[dds::index_of(dds::Topic::hosts)].is_new(sample.start, sample.number,
                                                              max_repeats(dds::Topic::hosts)))
    return;
  const bool is_news = !host->alive || host->said.start != sample.start;
  host->said = sample;
  host->heard_ns = now_ns;
  if (is_news) begin(*host, sample, now_ns);
  host->view.priority = sample.priority;
  host->view.group = std::clamp<std::uint32_t>(sample.group, 1, databuffer::kMaxHosts);
  const auto writes = [&](dds::Topic topic) { return link_ == nullptr || link_->host_writes(sample.host, topic); };
  host->view.held_roles = sample.held_roles & writable_roles(writes);  // claims to others do not count
  host->view.owns_clock = sample.owns_clock != 0 && writes(dds::Topic::clock);
  report_differences(*host, now_ns);
  update_views();
}

// A host that is heard for the first time, again after silence, or with a new gateway.
void Hosts::begin(Host& host, const yars_net_HostSample& sample, std::int64_t now_ns) {
  const bool was_alive = std::exchange(host.alive, true);
  host.left = false;
  host.view.name = text::text_of(sample.name);
  host.offset = {};
  host.next_probe_ns = now_ns;
  host.differences = 0;
  host.began_ns = now_ns;
  readmit(host, sample.start);
  if (was_alive && host.name.is_shared(now_ns)) return;  // each of those with the name would be said again and again
  say(log::info, NoteKind::restart, "hears host " + host.view.name);
}

void Hosts::report_differences(Host& host, std::int64_t now_ns) {
  const yars_net_HostSample& said = host.said;
  const std::string other = "host " + host.view.name;
  // A host's writers are known some ms after it is first heard.
  const bool claims = said.held_roles != host.view.held_roles || (said.owns_clock != 0) != host.view.owns_clock;
  report(host, kOtherClaims, claims && now_ns - host.began_ns > kClaimPatience_ns,
         other + " claims roles or the clock, and may not write their topics; its claims are left out");
  char hash[20];
  std::snprintf(hash, sizeof hash, "%016llx", static_cast<unsigned long long>(said.layout_hash));
  host.other_layout = said.layout_hash != databuffer::kLayoutIdentity.hash || said.protocol != yars_net_kProtocol;
  report(host, databuffer::kHostOtherLayout, host.other_layout,
         other + " has another layout of the records (" + std::string(text::text_of(said.version)) + ", layout " +
             hash + "): nothing is exchanged with it; install the same version on both");
  const auto differ = [](std::uint64_t mine, std::uint64_t theirs) {
    return mine != 0 && theirs != 0 && mine != theirs;
  };
  report(host, databuffer::kHostOtherConfiguration, differ(identity_.configuration_hash, said.configuration_hash),
         other + " has another configuration; start both with the same --config");
  report(host, databuffer::kHostOtherTerrain, differ(identity_.terrain_hash, said.terrain_hash),
         other + " has another terrain; start both with the same --terrain");
}

void Hosts::ask(std::int64_t now_ns) {
  for (Host& host : hosts_) {
    if (!host.alive || now_ns < host.next_probe_ns) continue;
    host.next_probe_ns = now_ns + (host.offset.count() < kFirstProbes ? kFirstProbeInterval_ns : kProbeInterval_ns);
    yars_net_ProbeSample question{};
    question.from = self().id;
    question.to = host.view.id;
    question.asked_ns = databuffer::monotonic_ns();
    if (link_ != nullptr) link_->write(question);
  }
}

void Hosts::receive(const yars_net_ProbeSample& sample, std::int64_t now_ns) {
  if (sample.stage == 0 && sample.to == self().id && link_ != nullptr) {
    yars_net_ProbeSample answer = sample;
    answer.stage = 1;
    answer.received_ns = now_ns;
    answer.answered_ns = databuffer::monotonic_ns();
    link_->write(answer);
  } else if (sample.stage == 1 && sample.from == self().id) {
    if (Host* host = host_of(sample.to, false); host != nullptr)
      host->offset.add({sample.asked_ns, sample.received_ns, sample.answered_ns, now_ns});
  }
}

Hosts::Host* Hosts::host_of(std::uint64_t id, bool add) {
  if (const Host* known = std::as_const(*this).host_of(id)) return const_cast<Host*>(known);
  if (!add || id == self().id) return nullptr;
  Host host;
  host.view.id = id;
  if (hosts_.size() + 1 < databuffer::kMaxHosts) return &hosts_.emplace_back(std::move(host));
  // A host that has left makes room, one that never announced itself first.
  const auto oldest =
      std::ranges::min_element(hosts_, {}, [](const Host& other) { return std::pair(other.alive, other.heard_ns); });
  if (oldest->alive) {
    log::warning("expected at most " + std::to_string(databuffer::kMaxHosts) + " hosts, found another");
    return nullptr;
  }
  *oldest = std::move(host);
  return &*oldest;
}

// Number of hosts that were heard kGroupDelay_ns ago, so that two hosts that meet again say how many each had with it.
// A process that was stopped for longer than the lease was alone.
void Hosts::update_group(std::int64_t now_ns) {
  if (now_ns - std::exchange(last_pass_ns_, now_ns) > kLease_ns) group_sizes_ = {{now_ns - kGroupDelay_ns, 1}};
  const auto heard = static_cast<std::uint32_t>(views_.size());
  if (group_sizes_.empty() || group_sizes_.back().second != heard) group_sizes_.emplace_back(now_ns, heard);
  while (group_sizes_.size() > 1 && group_sizes_[1].first <= now_ns - kGroupDelay_ns) group_sizes_.pop_front();
  if (in_conflict_) return;
  const bool is_old = group_sizes_.front().first <= now_ns - kGroupDelay_ns;
  views_.front().group = is_old ? group_sizes_.front().second : 1;
}

void Hosts::describe(databuffer::NetworkStatus& status, std::int64_t now_ns) const {
  // Losses count where each sample matters. In the other topics a newer state replaces an older one.
  constexpr std::array kHistories{dds::Topic::applied_events, dds::Topic::model_ticks, dds::Topic::sweeps,
                                  dds::Topic::traffic_latched, dds::Topic::world_latched};
  const auto add = [&](const HostView& view, const yars_net_HostSample& said, const SharedName& name, bool alive) {
    auto& to = status.hosts[status.host_count++];
    text::put_text(to.name, view.name);
    text::put_text(to.version, text::text_of(said.version));
    to.heard_ns = now_ns;
    to.priority = view.priority;
    const auto processes = static_cast<std::uint32_t>(said.processes) & shown_processes();
    to.held_roles = alive ? view.held_roles | processes << databuffer::kFirstProcessBit : 0;
    to.flags = (alive ? databuffer::kHostPresent : 0U) | (name.is_shared(now_ns) ? databuffer::kHostSameName : 0U) |
               (alive && view.owns_clock ? databuffer::kHostOwnsClock : 0U);
    return &to;
  };
  status.host_count = 0;
  add(self(), own_, own_name_, true)->flags |= databuffer::kHostSelf | databuffer::kHostOffsetKnown;
  for (const Host& host : hosts_) {
    if (host.view.name.empty() || status.host_count >= databuffer::kMaxHosts) continue;
    auto& to = *add(host.view, host.said, host.name, host.alive);
    to.heard_ns = host.heard_ns;
    to.flags |= (host.differences & ~kOtherClaims) | (host.left ? databuffer::kHostLeft : 0U);
    if (const auto best = host.offset.best()) {
      to.offset_ns = best->offset_ns;
      to.offset_error_ns = best->round_trip_ns / 2;
      to.flags |= databuffer::kHostOffsetKnown;
    }
    to.latency_ns = host.offset.latency_ns();
    for (const SampleNumbers& numbers : host.numbers) {
      to.received += numbers.received();
      to.repeated += numbers.repeated();
    }
    for (const dds::Topic topic : kHistories) to.lost += host.numbers[dds::index_of(topic)].lost();
    to.refused = host.refused;
  }
}

}  // namespace yars::gateway

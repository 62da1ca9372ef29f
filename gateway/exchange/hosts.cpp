#include "gateway/exchange/hosts.hpp"

#include <cstdio>

namespace yars::gateway {

namespace {

using databuffer::NoteKind;

constexpr std::int64_t kClaimPatience_ns = 3'000'000'000;
constexpr std::uint32_t kOtherClaims = 1U << 31U;  // of Host::differences: roles or the clock that it may not have

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
  if (!is_new(sample)) return;
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
         other + " has another layout of the records or another radar model (" +
             std::string(text::text_of(said.version)) + ", layout " + hash +
             "): nothing is exchanged with it; install the same version on both");
  const auto differ = [](std::uint64_t mine, std::uint64_t theirs) {
    return mine != 0 && theirs != 0 && mine != theirs;
  };
  report(host, databuffer::kHostOtherConfiguration, differ(identity_.configuration_hash, said.configuration_hash),
         other + " has another configuration; start both with the same --config");
  report(host, databuffer::kHostOtherTerrain, differ(identity_.terrain_hash, said.terrain_hash),
         other + " has another terrain; start both with the same --terrain");
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

// What the class Hosts says about other hosts: differences, claims, equal names.
#include <cstdio>

#include "gateway/exchange/hosts.hpp"
#include "lib/log/log.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::gateway {

using databuffer::NoteKind;

namespace {

constexpr std::int64_t kClaimPatience_ns = 3'000'000'000;
constexpr std::int64_t kSharedAgain_ns = 60'000'000'000;  // a name that is shared again after this is said again
constexpr std::int64_t kGhost_ns = 3'000'000'000;         // a predecessor of this process may be heard for the lease

}  // namespace

// Says once that a host claims what it may not have. A host's writers are known some ms after it is first heard.
void Hosts::report_claims(Host& host, std::int64_t now_ns) {
  const bool claims =
      (host.said.held_roles & ~host.view.held_roles) != 0 || (host.said.owns_clock != 0 && !host.view.owns_clock);
  if (!claims) host.claims_since_ns = now_ns;
  if (host.reported_claims || now_ns - host.claims_since_ns < kClaimPatience_ns) return;
  host.reported_claims = true;
  const std::string line =
      "host " + host.view.name + " claims roles or the clock, and may not write their topics; its claims are left out";
  log::warning(line);
  session_->note(NoteKind::refusal, line);
}

void Hosts::report_differences(Host& host) {
  const yars_net_HostSample& said = host.said;
  const std::string other = "host " + host.view.name;
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

// Says a difference once while it lasts.
void Hosts::report(Host& host, std::uint32_t flag, bool differs, const std::string& line) {
  if (!differs) {
    host.differences &= ~flag;
    return;
  }
  if ((host.differences & flag) != 0) return;
  host.differences |= flag;
  log::warning(line);
  session_->note(NoteKind::refusal, line);
}

// Says once that two other hosts have one name.
void Hosts::report_shared_name(Host& host, std::uint64_t start, std::int64_t now_ns) {
  host.name.hear(start, now_ns);
  if (!host.name.is_shared(now_ns)) return;
  const std::int64_t before_ns = std::exchange(host.name_shared_ns, now_ns);
  if (before_ns != 0 && now_ns - before_ns < kSharedAgain_ns) return;
  const std::string line = "two hosts are called " + host.view.name + "; give each a `name` of its own";
  log::error(line);
  session_->note(NoteKind::loss, line);
}

void Hosts::report_same_name(const yars_net_HostSample& sample, std::int64_t now_ns) {
  if (sample.start == identity_.start) return;
  if (!has_same_name(now_ns)) {
    same_name_since_ns_ = now_ns;
    same_name_ = false;
  }
  same_name_heard_ns_ = now_ns;
  if (same_name_ || now_ns - same_name_since_ns_ < kGhost_ns) return;
  same_name_ = true;
  const std::string line = "another host is also called " + identity_.name + "; give each host a `name` of its own";
  log::error(line);
  session_->note(NoteKind::refusal, line);
}

// True if another host with this name has been heard a short time ago.
bool Hosts::has_same_name(std::int64_t now_ns) const {
  return same_name_heard_ns_ != 0 && now_ns - same_name_heard_ns_ <= kGhost_ns;
}

}  // namespace yars::gateway

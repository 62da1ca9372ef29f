// What every exchange between the local segment and the other hosts needs in one pass of the gateway.
#pragma once

#include <cstdint>
#include <cstring>

#include "databuffer/session/session.hpp"
#include "gateway/dds/link.hpp"
#include "gateway/exchange/hosts.hpp"
#include "gateway/exchange/roles.hpp"

namespace yars::gateway {

struct Context {
  databuffer::Session& session;
  dds::Link* link;  // null only in tests that hand samples to the exchanges
  Hosts& hosts;
  Roles& roles;
  std::int64_t now_ns = 0;  // CLOCK_MONOTONIC at the begin of the pass
  bool lockstep = false;    // the session runs in lockstep: every tick is exchanged
  bool joined = false;      // the session clock is known

  // As Link::write() and Link::writes(). Without a link every sample counts as written.
  template <class Sample>
  bool write(const Sample& sample) {
    return link == nullptr || link->write(sample);
  }
  bool writes(dds::Topic topic) const { return link == nullptr || link->writes(topic); }
  bool reads(dds::Topic topic) const { return link == nullptr || link->reads(topic); }
};

// A record and its structure in a sample have the same bytes (checked when yars_gateway_types is built).
template <class To, class From>
void copy_record(To& to, const From& from) {
  static_assert(sizeof to == sizeof from);
  std::memcpy(&to, &from, sizeof to);
}

inline constexpr std::uint32_t kNoLane = 0xFFFFFFFFU;  // lane of a host other than this one

}  // namespace yars::gateway

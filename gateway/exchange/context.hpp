// What every exchange between the local segment and the other hosts needs: one pass of the gateway, records of other
// hosts, and the memory of these hosts. The headers below are for all exchanges, which include this one.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "databuffer/session/session.hpp"
#include "databuffer/session/validated.hpp"
#include "gateway/dds/link.hpp"
#include "gateway/exchange/hosts.hpp"
#include "gateway/exchange/roles.hpp"
#include "gateway/pace.hpp"
#include "lib/log/log.hpp"

namespace yars::gateway {

// A record and its structure in a sample have the same bytes (checked when yars_gateway_types is built).
template <class To, class From>
void copy_record(To& to, const From& from) {
  static_assert(sizeof to == sizeof from);
  std::memcpy(&to, &from, sizeof to);
}
template <class Record>
bool equal(const Record& first, const Record& second) {
  return std::memcmp(&first, &second, sizeof first) == 0;
}
// Publishes a record that does not stand in the slot. A local process may have written there since the last one.
template <class Record>
void publish_changed(shm::LatestValue<Record>& slot, const Record& record) {
  Record present{};
  if (!slot.read(present) || !equal(record, present)) slot.publish(record);
}

struct Context {
  databuffer::Session& session;
  dds::Link* link;  // null only in tests that hand samples to the exchanges
  Hosts& hosts;
  Roles& roles;
  std::int64_t now_ns = 0;  // CLOCK_MONOTONIC at the start of the pass
  bool lockstep = false;    // the session runs in lockstep: every tick is exchanged

  const databuffer::SessionLayout& layout() const { return std::as_const(session).layout(); }
  std::uint64_t segment() const { return hosts.identity().segment; }  // of this host
  // An empty sample with the host, start and number of this host.
  template <class Sample>
  Sample made() {
    Sample sample{};
    hosts.stamp(sample);
    return sample;
  }
  // As Link::write() and Link::writes(). Without a link every sample counts as written.
  template <class Sample>
  bool write(const Sample& sample) {
    return link == nullptr || link->write(sample);
  }
  bool writes(dds::Topic topic) const { return link == nullptr || link->writes(topic); }
  bool reads(dds::Topic topic) const { return link == nullptr || link->reads(topic); }
  // Hands the samples of these topics that have arrived to exchange.receive().
  template <class... Samples, class Exchange>
  void take(Exchange& exchange) {
    if (link == nullptr) return;
    (link->take<Samples>([&](const Samples& sample) { exchange.receive(*this, sample); }), ...);
  }
  // The record in a field of a sample; nullopt: it is invalid, which is counted and noted.
  template <class Record, class Sample, class Field>
  std::optional<Record> valid(const Sample& sample, const Field& field) {
    const auto record = std::bit_cast<Record>(field);
    const auto reason = validate(record);
    if (!reason) return record;
    hosts.refuse(sample, *reason);
    return std::nullopt;
  }
  // The same; nullopt also: the sample has arrived before.
  template <class Record, class Sample, class Field>
  std::optional<Record> new_and_valid(const Sample& sample, const Field& field) {
    return hosts.is_new(sample) ? valid<Record>(sample, field) : std::nullopt;
  }
};

// What an exchange remembers of each host that has sent it something, of kMaxHosts at most. Hosts that are not heard
// make room.
template <class Value>
class HostMemory {
 public:
  // nullptr: there is no room.
  Value* of(const Hosts& hosts, std::uint64_t id) {
    if (values_.size() >= databuffer::kMaxHosts && !values_.contains(id))
      std::erase_if(values_, [&](const auto& known) { return hosts.find(known.first) == nullptr; });
    return values_.size() < databuffer::kMaxHosts || values_.contains(id) ? &values_[id] : nullptr;
  }
  Value* find(std::uint64_t id) {
    const auto found = values_.find(id);
    return found == values_.end() ? nullptr : &found->second;
  }
  // For memories of samples: keeps the newest one of a host, also of a host that has a role only later.
  void keep(const Hosts& hosts, const Value& sample) {
    if (Value* place = of(hosts, sample.host)) *place = sample;
  }
  // The newest sample of the gateway that runs on the host now; nullptr: none.
  const Value* newest(const Hosts& hosts, std::optional<std::uint64_t> id) {
    const Value* sample = id ? find(*id) : nullptr;
    return sample != nullptr && sample->start == hosts.start_of(*id) ? sample : nullptr;
  }
  auto begin() { return values_.begin(); }
  auto end() { return values_.end(); }

 private:
  std::map<std::uint64_t, Value> values_;  // by host
};

inline constexpr std::uint32_t kNoLane = 0xFFFFFFFFU;  // lane of a host other than this one

struct RemoteName {
  std::uint64_t host = 0;
  std::uint32_t lane = 0;
  bool operator==(const RemoteName&) const = default;
  void write_to(std::uint64_t& host_field, std::uint32_t& lane_field) const {
    host_field = host;
    lane_field = lane;
  }
};

// Lanes of the local segment that this gateway fills for other hosts, and the names of these lanes on their own hosts.
// Records name lanes by number. Numbers are translated where a record leaves or enters a host.
struct LaneNames {
  std::array<std::optional<RemoteName>, databuffer::kInputLanes> input;  // of the local input lanes
  std::optional<std::size_t> ownship_lane;  // local ownship lane with the ownship of another host
  RemoteName ownship;                       // whose it is

  // Name of a local ownship lane for other hosts; `self`: this host.
  RemoteName ownship_name(std::uint32_t lane, std::uint64_t self) const {
    return ownship_lane && lane == *ownship_lane ? ownship : RemoteName{self, lane};
  }
  // Local number of an ownship lane; `none` if this host has no such lane.
  std::uint32_t local_ownship_lane(RemoteName name, std::uint64_t self, std::uint32_t none) const {
    if (name.host == self) return name.lane;
    return ownship_lane && ownship == name ? static_cast<std::uint32_t>(*ownship_lane) : none;
  }
  RemoteName input_name(std::uint32_t lane, std::uint64_t self) const {
    return lane < input.size() && input[lane] ? *input[lane] : RemoteName{self, lane};
  }
};

}  // namespace yars::gateway

// What every exchange between the local segment and the other hosts needs: the roles, one pass of the gateway, records
// of other hosts, and the memory of these hosts. The headers below are for all exchanges, which include this one.
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

#include "databuffer/session/receivers.hpp"
#include "databuffer/session/session.hpp"
#include "gateway/dds/link.hpp"
#include "gateway/exchange/hosts.hpp"
#include "lib/log/log.hpp"

namespace yars::gateway {

// [ns] A gateway that starts listens so long before it takes what no host has. Hosts hear each other within 0.3 s.
inline constexpr std::int64_t kListening_ns = 1'000'000'000;

// Which host has each role of a session, and the roles that this host's gateway holds for others.
// Inputs: the hosts that are heard; lock bytes of the local segment.
// Outputs: claims on the local roles of other hosts ("mirrored" roles), so that no local process takes them; requests
//   that a local holder yields; this host's claims, for its announcements.
// Errors: a mirrored role that a local process holds is left to it until it yields.
// Source: docs/network.md#which-host-has-a-role.
class Roles {
 public:
  // `session_name`: each mirrored role has an entry of its own in the process table, which takes a Session of its own.
  Roles(databuffer::Session& session, std::string session_name)
      : session_(&session), session_name_(std::move(session_name)) {
    session.layout().network.yielding_roles.store(0);
  }
  Roles(const Roles&) = delete;
  Roles& operator=(const Roles&) = delete;
  // A standby of this host takes a released role at once.
  ~Roles() {
    for (State& state : states_) release(state);
  }

  // This host may not hold the role, as its records may not leave it (topicsOut, permissions): a local holder yields.
  void bar(Role role) {
    std::ranges::find(states_, role, &State::role)->barred = true;
    log::info("this host may not hold the role " + std::string(name_of(role)) + ": its topics may not leave it");
  }

  // Compares who holds each role, claims, releases, and asks to yield.
  void update(const Hosts& hosts, std::int64_t now_ns) {
    for (State& state : states_) state.local = !state.claim && std::as_const(*session_).role_is_held(state.role);
    for (State& state : states_) update(state, hosts, now_ns);
  }

  void heartbeat() {
    for (State& state : states_)
      if (state.session) state.session->heartbeat();
  }

  // Host whose records of this role are to be published here: it has the role, and this gateway mirrors it.
  std::optional<std::uint64_t> source(Role role) const {
    const State& state = state_of(role);
    return state.claim ? state.holder : std::nullopt;
  }

  // True if a local process holds the role and no other host precedes: its records go to the other hosts.
  bool exports(Role role) const {
    const State& state = state_of(role);
    return state.holds() &&
           (!state.exclusive || (session_->layout().network.yielding_roles.load() & bit_of(role)) == 0);
  }

  // Host with the role, this one included; nullopt: none.
  std::optional<std::uint64_t> holder(Role role) const { return state_of(role).holder; }

  // Bit n: a local process other than this gateway holds role n
  std::uint32_t held_roles() const {
    std::uint32_t bits = 0;
    for (const State& state : states_)
      if (state.holds()) bits |= bit_of(state.role);
    return bits;
  }

  std::uint32_t takeovers() const { return takeovers_; }
  std::uint32_t conflicts() const { return conflicts_; }
  // True if two hosts hold a role at this moment.
  bool in_conflict() const { return std::ranges::any_of(states_, &State::conflict); }

  // True if a role of this host stays on another that holds it too.
  bool gives_way() const { return std::ranges::any_of(states_, &State::gives_way); }

 private:
  static constexpr std::int64_t kLending_ns = 300'000'000;  // time for a local process to claim a role that it wants

  struct State {
    Role role;
    // One host of the session holds it, and the process table shows it by name. Else each host may have a holder.
    bool exclusive = false;
    std::optional<databuffer::Session> session = std::nullopt;
    std::optional<databuffer::Claim> claim = std::nullopt;
    bool local = false;   // a local process holds it
    bool barred = false;  // bar()
    bool conflict = false;
    bool gives_way = false;
    std::int64_t lent_until_ns = 0;  // until then the role is left to a local process that wants it
    std::optional<std::uint64_t> holder = std::nullopt;
    Vacancy vacancy = {};
    bool holds() const { return local && !barred; }
  };

  void update(State& state, const Hosts& hosts, std::int64_t now_ns) {
    // This host's announced claims may be one pass old; what counts here is the present.
    const auto holds = [&](const HostView& host) {
      return host.id == hosts.self().id ? state.holds() : (host.held_roles & bit_of(state.role)) != 0;
    };
    const HostView* holder = preceding(hosts.views(), holds);
    const bool is_self = holder != nullptr && holder->id == hosts.self().id;
    const auto holders = std::ranges::count_if(hosts.views(), holds);
    const bool conflict = state.exclusive && holders > 1;
    if (conflict && !state.conflict) {
      ++conflicts_;
      hosts.say(log::warning, databuffer::NoteKind::restart,
                std::string(name_of(state.role)) + " runs on " + std::to_string(holders) + " hosts; it stays on " +
                    holder->name);
    }
    state.conflict = conflict;
    state.gives_way = conflict && !is_self && state.holds();
    if (is_self && state.holder && *state.holder != hosts.self().id) ++takeovers_;
    if (holder != nullptr) state.holder = holder->id;
    const bool may_release = state.vacancy.may_take(holder == nullptr, rank_of(hosts.views(), hosts.self()), now_ns);
    if (!state.exclusive && state.local) state.holder = hosts.self().id;
    // A process of this host that wants a shared role gets it. It claims the role within some ms.
    auto& wanted = session_->layout().network.wanted_roles;
    if (!state.exclusive && (wanted.load() & bit_of(state.role)) != 0) {
      set_bit(wanted, state.role, false);
      release(state);
      state.lent_until_ns = now_ns + kLending_ns;
    }
    if (now_ns < state.lent_until_ns && !state.local) return;
    // The role is claimed before the request to yield ends, so that no standby of this host gets in between.
    const bool is_elsewhere = holder != nullptr && !is_self;
    if ((is_elsewhere || state.barred) && !state.local && !state.claim) mirror(state);
    if (state.exclusive)
      set_bit(session_->layout().network.yielding_roles, state.role, state.local && (is_elsewhere || state.barred));
    // A gateway that has just started has not heard the other hosts yet.
    if (state.exclusive && hosts.age_ns(now_ns) < kListening_ns) return;
    if (holder == nullptr && (may_release || !state.exclusive)) {
      state.holder.reset();
      if (!state.barred) release(state);
    }
  }

  void mirror(State& state) {
    if (!state.session) {
      auto session = databuffer::Session::open(session_name_, state.exclusive ? name_of(state.role) : "gateway");
      if (!session) return;
      state.session.emplace(std::move(*session));
    }
    if (state.exclusive) set_bit(session_->layout().network.mirrored_roles, state.role, true);
    if (auto claim = state.session->claim(state.role)) state.claim.emplace(std::move(*claim));
  }

  void release(State& state) {
    if (state.exclusive) set_bit(session_->layout().network.mirrored_roles, state.role, false);
    if (!state.claim) return;
    if (state.role == Role::traffic) session_->layout().traffic.clear();
    if (state.role == Role::tour) session_->layout().caption.clear();
    state.claim.reset();
    state.session.reset();
  }

  static void set_bit(std::atomic<std::uint32_t>& bits, Role role, bool on) {
    if (on)
      bits.fetch_or(bit_of(role));
    else
      bits.fetch_and(~bit_of(role));
  }

  const State& state_of(Role role) const { return *std::ranges::find(states_, role, &State::role); }

  databuffer::Session* session_;
  std::string session_name_;
  std::array<State, 5> states_{
      {{Role::radar_model, true}, {Role::state_machine, true}, {Role::traffic}, {Role::recorder}, {Role::tour}}};
  std::uint32_t takeovers_ = 0, conflicts_ = 0;
};

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

// What an exchange remembers of hosts, of kMaxHosts at most. Hosts that are not heard make room.
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

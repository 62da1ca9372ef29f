// Which host has each role of a session, and the roles that this host's gateway holds for others.
// Inputs: the hosts that are heard; lock bytes of the local segment.
// Outputs: claims on the local roles of other hosts ("mirrored" roles), so that no local process takes them; requests
//   that a local holder yields; this host's claims, for its announcements.
// Errors: a mirrored role that a local process holds is left to it until it yields.
// Source: docs/network.md#which-host-has-a-role.
#pragma once

#include <string>

#include "gateway/exchange/hosts.hpp"
#include "lib/log/log.hpp"

namespace yars::gateway {

// [ns] A gateway that starts listens so long before it takes what no host has. Hosts hear each other within 0.3 s.
inline constexpr std::int64_t kListening_ns = 1'000'000'000;

class Roles {
 public:
  // `session_name`: each mirrored role has an entry of its own in the process table, which takes a Session of its own.
  Roles(databuffer::Session& session, std::string session_name)
      : session_(&session),
        session_name_(std::move(session_name)),
        states_{
            {{Role::radar_model, true}, {Role::state_machine, true}, {Role::traffic}, {Role::recorder}, {Role::tour}}} {
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
  std::array<State, 5> states_;
  std::uint32_t takeovers_ = 0, conflicts_ = 0;
};

}  // namespace yars::gateway

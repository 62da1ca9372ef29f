#include "gateway/exchange/roles.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "lib/log/log.hpp"

namespace yars::gateway {

using databuffer::Role;

namespace {

constexpr std::int64_t kLending_ns = 300'000'000;  // time for a local process to claim a role that it wants

}  // namespace

Roles::Roles(databuffer::Session& session, std::string session_name)
    : session_(&session),
      session_name_(std::move(session_name)),
      states_{{{Role::radar_model, true},
               {Role::state_machine, true},
               {Role::traffic, false},
               {Role::recorder, false},
               {Role::tour, false}}} {
  session.layout().network.yielding_roles.store(0);
}

Roles::~Roles() {
  for (State& state : states_) release(state);
}

void Roles::bar(Role role) {
  const auto found = std::ranges::find(states_, role, &State::role);
  assert(found != states_.end() && found->exclusive);
  found->barred = true;
  log::info("this host may not hold the role " + std::string(name_of(role)) + ": its topics may not leave it");
}

void Roles::update(const Hosts& hosts, std::int64_t now_ns) {
  for (State& state : states_) state.local = !state.claim && std::as_const(*session_).role_is_held(state.role);
  for (State& state : states_) update(state, hosts, now_ns);
}

void Roles::update(State& state, const Hosts& hosts, std::int64_t now_ns) {
  // This host's announced claims may be one pass old; what counts here is the present.
  const auto holds = [&](const HostView& host) {
    return host.id == hosts.self().id ? state.local && !state.barred
                                      : (host.held_roles >> static_cast<unsigned>(state.role) & 1U) != 0;
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
  state.gives_way = conflict && !is_self && state.local && !state.barred;
  if (is_self && state.holder && *state.holder != hosts.self().id) ++takeovers_;
  if (holder != nullptr) state.holder = holder->id;
  const bool may_release = state.vacancy.may_take(holder == nullptr, rank_of(hosts.views(), hosts.self()), now_ns);
  if (!state.exclusive && state.local) state.holder = hosts.self().id;
  // A process of this host that wants a shared role gets it. It claims the role within some ms.
  auto& wanted = session_->layout().network.wanted_roles;
  if (!state.exclusive && (wanted.load() >> static_cast<unsigned>(state.role) & 1U) != 0) {
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
  if (first_update_ns_ == 0) first_update_ns_ = now_ns;
  if (state.exclusive && now_ns - first_update_ns_ < kListening_ns) return;
  if (holder == nullptr && (may_release || !state.exclusive)) {
    state.holder.reset();
    if (!state.barred) release(state);
  }
}

void Roles::mirror(State& state) {
  auto& bits = session_->layout().network.mirrored_roles;
  if (!state.session) {
    auto session = databuffer::Session::open(session_name_, state.exclusive ? name_of(state.role) : "gateway");
    if (!session) return;
    state.session.emplace(std::move(*session));
  }
  if (state.exclusive) set_bit(bits, state.role, true);
  auto claim = state.session->claim(state.role);
  if (claim) state.claim.emplace(std::move(*claim));
}

void Roles::release(State& state) {
  if (state.exclusive) set_bit(session_->layout().network.mirrored_roles, state.role, false);
  if (!state.claim) return;
  if (state.role == Role::traffic) session_->layout().traffic.clear();
  if (state.role == Role::tour) session_->layout().caption.clear();
  state.claim.reset();
  state.session.reset();
}

void Roles::set_bit(std::atomic<std::uint32_t>& bits, Role role, bool on) {
  const std::uint32_t bit = 1U << static_cast<unsigned>(role);
  if (((bits.load() & bit) != 0) == on) return;
  if (on)
    bits.fetch_or(bit);
  else
    bits.fetch_and(~bit);
}

void Roles::heartbeat() {
  for (State& state : states_)
    if (state.session) state.session->heartbeat();
}

const Roles::State& Roles::state_of(Role role) const {
  const auto found = std::ranges::find(states_, role, &State::role);
  assert(found != states_.end());
  return *found;
}

std::optional<std::uint64_t> Roles::source(Role role) const {
  const State& state = state_of(role);
  return state.claim ? state.holder : std::nullopt;
}

bool Roles::exports(Role role) const {
  const State& state = state_of(role);
  if (!state.local || state.barred) return false;
  return !state.exclusive ||
         (session_->layout().network.yielding_roles.load() >> static_cast<unsigned>(role) & 1U) == 0;
}

std::optional<std::uint64_t> Roles::holder(Role role) const {
  return state_of(role).holder;
}

std::uint32_t Roles::held_roles() const {
  std::uint32_t bits = 0;
  for (const State& state : states_)
    if (state.local && !state.barred) bits |= 1U << static_cast<unsigned>(state.role);
  return bits;
}

bool Roles::in_conflict() const {
  return std::ranges::any_of(states_, &State::conflict);
}

bool Roles::gives_way() const {
  return std::ranges::any_of(states_, &State::gives_way);
}

}  // namespace yars::gateway

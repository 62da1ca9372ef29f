// Roles of a session that is spread over hosts: which host has each, and the roles that this host's gateway holds for
// others.
// Inputs: the hosts that are heard; lock bytes of the local segment.
// Outputs: claims on the local roles of other hosts ("mirrored" roles), so that no local process takes them; requests
//   that a local holder yields; this host's claims, for its announcements.
// Errors: a mirrored role that a local process holds is left to it until it yields.
// Source: docs/network.md#which-host-has-a-role.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "databuffer/session/session.hpp"
#include "gateway/exchange/hosts.hpp"

namespace yars::gateway {

// [ns] Time for which a gateway that starts only listens, before it takes what no host has. Hosts hear each other
// within 0.3 s, also on a line with 20 ms delay that loses 1 %.
inline constexpr std::int64_t kListening_ns = 1'000'000'000;

class Roles {
 public:
  // `session_name`: each mirrored role has an entry of its own in the process table, which takes a Session of its own.
  Roles(databuffer::Session& session, std::string session_name);
  Roles(const Roles&) = delete;
  Roles& operator=(const Roles&) = delete;
  ~Roles();  // a standby of this host takes a released role at once

  // This host may not hold the role, as its records may not leave it (topicsOut, permissions of DDS Security). A local
  // holder yields, and a standby waits. Otherwise the other hosts would wait for records that never come.
  void bar(databuffer::Role role);

  // Compares who holds each role, claims, releases, and asks to yield.
  void update(const Hosts& hosts, std::int64_t now_ns);
  void heartbeat();

  // Host whose records of this role are to be published here: it has the role, and this gateway mirrors it.
  std::optional<std::uint64_t> source(databuffer::Role role) const;
  // True if a local process holds the role and no other host precedes: its records go to the other hosts.
  bool exports(databuffer::Role role) const;
  // Host with the role, this one included; nullopt: none.
  std::optional<std::uint64_t> holder(databuffer::Role role) const;
  std::uint32_t held_roles() const;  // bit n: a local process other than this gateway holds role n

  std::uint32_t takeovers() const { return takeovers_; }
  std::uint32_t conflicts() const { return conflicts_; }
  bool in_conflict() const;  // two hosts hold a role at this moment
  bool gives_way() const;    // a role of this host stays on another that holds it too

 private:
  struct State {
    databuffer::Role role;
    // One host of the session holds it, and the process table shows it by name. Else each host may have a holder.
    bool exclusive;
    std::optional<databuffer::Session> session = std::nullopt;
    std::optional<databuffer::Claim> claim = std::nullopt;
    bool local = false;   // a local process holds it
    bool barred = false;  // bar()
    bool conflict = false;
    bool gives_way = false;
    std::int64_t lent_until_ns = 0;  // until then the role is left to a local process that wants it
    std::optional<std::uint64_t> holder = std::nullopt;
    Vacancy vacancy = {};
  };
  void update(State& state, const Hosts& hosts, std::int64_t now_ns);
  void mirror(State& state);
  void release(State& state);
  void set_bit(std::atomic<std::uint32_t>& bits, databuffer::Role role, bool on);
  const State& state_of(databuffer::Role role) const;

  databuffer::Session* session_;
  std::string session_name_;
  std::array<State, 5> states_;
  std::uint32_t takeovers_ = 0, conflicts_ = 0;
  std::int64_t first_update_ns_ = 0;
};

}  // namespace yars::gateway

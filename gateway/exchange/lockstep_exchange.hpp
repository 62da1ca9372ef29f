// Lockstep over several hosts: carries the last done tick of each role to the other hosts.
// Inputs: done ticks of local roles; those of other hosts, with the numbers of the samples written up to then.
// Outputs: done ticks in the local segment, after everything has arrived here that the role, and the roles before it,
//   published in the tick. Network::lost_role: a role whose host has been gone for 10 s before the end of the run.
// Errors: a done tick that goes back, or is out of range, is refused. A host whose run has another end is named once.
// Threads: wakes the roles that wait on the futexes of the segment.
// Source: docs/architecture.md#time; TickLoop (runtime/tick_loop.hpp).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "databuffer/session/session_layout.hpp"
#include "gateway/exchange/context.hpp"

namespace yars::gateway {

class LockstepExchange {
 public:
  LockstepExchange() { known_.fill(-1); }
  // Reads the done ticks before the records of the tick are sent.
  void begin_pass(Context& context);
  // Sends the done ticks that begin_pass() found, after the records.
  void send(Context& context);
  void receive(Context& context) { context.take<yars_net_LockstepSample>(*this); }
  void receive(Context& context, const yars_net_LockstepSample& sample);
  // Applies the done ticks whose samples have all arrived, after those of the roles before. `in_order`: no record that
  // has arrived waits for another.
  void apply(Context& context, bool in_order);

 private:
  // The host that did the last tick of a role.
  struct Performer {
    std::uint64_t host = 0;    // 0: this host, or not known
    std::string name{};        // empty: not known
    std::int64_t gone_ns = 0;  // [ns] time without that host, as far as this process ran
  };
  // Another host of the run.
  struct Partner {
    std::array<std::optional<yars_net_LockstepSample>, databuffer::kLockstepRoles> waiting;  // newest of each role
    bool has_other_end = false;                                                              // which has been said
  };
  void complete_ticks(Context& context);
  bool complete(Context& context, Partner& partner, const yars_net_LockstepSample& sample);
  static void compare_end(const Context& context, Partner& partner, const yars_net_LockstepSample& sample);
  void watch_hosts(Context& context);
  bool has_ended(const Context& context, std::size_t role);
  static bool has_arrived(const Context& context, const yars_net_LockstepSample& sample);
  static bool others_are_done(const databuffer::Lockstep& lockstep, std::size_t role, std::int64_t tick);

  std::array<std::int64_t, databuffer::kLockstepRoles> done_{}, known_{};  // by local roles; sent or written here
  HostMemory<Partner> partners_;
  std::array<Performer, databuffer::kLockstepRoles> performers_;
  std::int64_t watched_ns_ = 0;
};

}  // namespace yars::gateway

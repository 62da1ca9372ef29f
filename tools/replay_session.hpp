// A session in which a recording plays: state-machine and radar-model to whoever looks on, with the clock set to the
// recording's time. Each jump begins a new epoch, so that no picture mixes what was before with what is after; all
// records bear the session's epoch instead of the recorded one. What is pressed there goes nowhere.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "databuffer/session.hpp"
#include "tools/recording/player.hpp"

namespace yars::tools {

class ReplaySession {
 public:
  // An error: somebody runs one of the two roles there, or the session steps in lockstep.
  static failure::Expected<ReplaySession> create(const std::string& name);

  // Clock to this tick, a new epoch; with a rate, it runs by it.
  failure::Expected<void> jump_to(std::int64_t tick);
  failure::Expected<void> start(std::int64_t tick, double rate);
  std::int64_t tick() const;
  // Somebody else began an epoch (`yars sim reset`); true once for each.
  bool was_reset();

  // The key frame of a jump takes the place of what stood before, also where it has nothing.
  void publish_key_frame(const recording::Played& played);
  void publish(const recording::Played& played);
  void heartbeat();
  void drop_events();

 private:
  ReplaySession(databuffer::Session machine, databuffer::Session model);
  failure::Expected<void> set_clock(std::int64_t tick, const double* rate);
  void publish_maps(const recording::Played& played);
  void publish_sweeps(const recording::Played& played);
  void publish_status(databuffer::ModelStatus status);

  // Two, because the process table has a name for each role, and a glass takes a role without one for dead.
  databuffer::Session machine_, model_;
  databuffer::Claim machine_role_, model_role_, lane_;
  std::uint32_t epoch_ = 0;
  std::array<std::uint64_t, 4> maps_named_{};
};

}  // namespace yars::tools

// `yars replay FILE`: plays a recording into a separate session, for a radar-display. The replay follows that session's
// clock, so `yars sim freeze`, `run`, `rate` and `step` control the replay. `yars sim reset` seeks in the recording.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "databuffer/session/session.hpp"
#include "lib/error/error.hpp"
#include "radar/recording/replay.hpp"

namespace yars::tools {

// The session of a replay. This process takes the roles state-machine and radar-model and sets the clock to the
// recording's time. Each jump begins a new epoch, so that no picture mixes records from before and after the jump.
// Published records have the session's epoch instead of the recorded epoch, except patch maps. Input events of the
// session have no effect.
class ReplaySession {
 public:
  // Errors: another process has one of the two roles, or the session runs in lockstep.
  static error::Expected<ReplaySession> create(const std::string& name);

  // jump_to() and start() set the clock to `tick` in a new epoch. start() also sets the rate and runs the clock.
  error::Expected<void> jump_to(std::int64_t tick);
  error::Expected<void> start(std::int64_t tick, double rate);
  // Freezes the clock at `tick` in the recorded epoch, with the position at which a new flight begins.
  error::Expected<void> hold(std::int64_t tick, std::uint32_t epoch, const databuffer::Ownship& ownship);
  // Runs the clock from its present time. The epoch stays.
  error::Expected<void> release_clock();
  // Gives the ownship lane and the two roles back. The process still takes part.
  void release_roles();
  const databuffer::Session& session() const { return machine_; }
  std::int64_t tick() const;
  // Returns true once after another process has begun an epoch (`yars sim reset`).
  bool was_reset();

  // Publishes a key frame (result of recording::Player::seek()). Clears the session's radar state, outputs or model
  // status if the key frame has none.
  void publish_key_frame(const recording::Played& played);
  void publish(const recording::Played& played);
  // Has the live radar model begin with this world.
  void want_world(databuffer::WorldState world);
  void heartbeat();
  void drop_events();

 private:
  ReplaySession(databuffer::Session machine, databuffer::Session model);
  error::Expected<void> set_clock(std::int64_t tick, const double* rate);
  void publish_maps(const recording::Played& played);
  void publish_sweeps(const recording::Played& played);
  void publish_status(databuffer::ModelStatus status);

  // Each role has a Session object of its own, because each role needs an entry in the process table. A display treats
  // a role without an entry as dead.
  databuffer::Session machine_, model_;
  databuffer::Claim machine_role_, model_role_, lane_;
  std::uint32_t epoch_ = 0;
  std::array<std::uint64_t, 4> maps_named_{};  // ids of the newest state's maps, which are not overwritten
};

struct PlayOptions {
  std::string file;  // name for messages
  std::string session;
  double rate = 1.0;             // [0, 10] times real time; 0: the clock stands still
  std::optional<double> seek_s;  // [s] sim time at which to begin; nullopt: the start of the recording
  bool json = false;             // the result is printed as one JSON object
};

// Returns when the recording has ended or a stop was requested. `world`: see recording::Player. Errors: a rate that is
// not a number; a --seek time outside the recording; a session in lockstep; another process with the role state-machine
// or radar-model; a recorded tick beyond the clock's range.
error::Expected<void> play_recording(recording::RecordingReader& reader, std::optional<recording::PlayerWorld> world,
                                     const PlayOptions& options);

}  // namespace yars::tools

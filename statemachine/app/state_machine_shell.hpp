// The state machine as a process: latches events, ownship and model status once a tick, publishes the radar
// state when it has changed and every event that it applied.
#pragma once

#include <cstdint>

#include "databuffer/runtime/receivers.hpp"
#include "databuffer/runtime/tick_loop.hpp"
#include "databuffer/session/session.hpp"
#include "lib/geo/geodesy.hpp"
#include "lib/radar/configuration.hpp"
#include "statemachine/machine.hpp"

namespace yars::statemachine {

class StateMachineShell {
 public:
  // Goes on from the radar state that a predecessor left in the segment, else starts with power off.
  StateMachineShell(databuffer::Session& session, const radar::RadarConfiguration& configuration, bool lockstep);
  void step(const databuffer::TickLoop::Due& due);

 private:
  bool latch_model();
  void latch_maps();
  void latch_recorder();
  void latch_variation();
  void latch(const databuffer::TickLoop::Due& due);
  void take_events(std::int64_t tick);
  void take(const databuffer::InputEvent& event, std::size_t lane, std::int64_t tick);
  void publish_if_changed(std::int64_t tick);

  databuffer::Session* session_;
  const radar::RadarConfiguration* configuration_;
  bool drop_old_events_;  // what waited for a dead predecessor for over a second is dropped
  databuffer::OwnshipReceiver ownship_;
  geo::MagneticField field_;
  Inputs inputs_;
  bool model_told_ = false;        // inputs_.model holds a status
  std::uint64_t refused_map_ = 0;  // told once
  databuffer::RecorderStatus recorder_{};
  std::uint64_t recorder_version_ = 0;
  databuffer::RadarState state_;
  databuffer::RadarState published_;
  bool nothing_published_ = true;
};

}  // namespace yars::statemachine

// Shell of state-machine in a session: latches the inputs once per tick, applies events, publishes the results.
// Inputs: events of all input lanes, ownship and nav, model status, recorder status, patch map records.
// Outputs: the radar state when it has changed; every applied event; an Outputs record in every tick; advice for the
//   pilot when it has changed.
// Errors: invalid events and records are dropped and noted in the flight recorder; the last valid record stays in use.
#pragma once

#include <cstdint>

#include "databuffer/runtime/receivers.hpp"
#include "databuffer/runtime/tick_loop.hpp"
#include "databuffer/session/session.hpp"
#include "databuffer/session/validated.hpp"
#include "lib/geo/geodesy.hpp"
#include "statemachine/machine.hpp"

namespace yars::statemachine {

class StateMachineShell {
 public:
  // Continues from the radar state that a predecessor left in the segment. Without one, starts with power off.
  StateMachineShell(databuffer::Session& session, const Parameters& parameters, bool lockstep);
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
  void publish_advice();

  databuffer::Session* session_;
  Parameters parameters_;
  bool drop_old_events_;  // drops events older than 1 s; false in lockstep and after the first tick
  databuffer::OwnshipReceiver ownship_;
  geo::MagneticField field_;
  Inputs inputs_;
  databuffer::WantedMaps wanted_maps_{*session_, "patch map"};
  databuffer::Validated<databuffer::ModelStatus> model_;
  databuffer::Validated<databuffer::RecorderStatus> recorder_;
  databuffer::RadarState state_;
  databuffer::RadarState published_;
  bool nothing_published_ = true;
  databuffer::PilotAdvice advice_{}, published_advice_{};
  bool advice_due_ = true;
};

}  // namespace yars::statemachine

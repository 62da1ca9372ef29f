// Shell of state-machine in a session: latches the inputs once per tick, applies events, publishes the results.
// Inputs: events of all input lanes, ownship and nav, model status, recorder status, patch map records, sequence points
//   of the world in effect.
// Outputs: the radar state when it has changed; every applied event; an Outputs record in every tick; advice for the
//   pilot when it has changed.
// Errors: invalid events and records are dropped and noted in the flight recorder; the last valid record stays in use.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "databuffer/session/receivers.hpp"
#include "databuffer/session/session.hpp"
#include "lib/geo/geodesy.hpp"
#include "lib/radar/mission.hpp"
#include "runtime/tick_loop.hpp"
#include "statemachine/machine.hpp"

namespace yars::statemachine {

class StateMachineShell {
 public:
  // Continues from the radar state that a predecessor left in the segment. Without one, starts with power off.
  StateMachineShell(databuffer::Session& session, const Parameters& parameters, bool lockstep);
  void step(const runtime::TickLoop::Due& due);

 private:
  bool latch_model();
  void latch_maps();
  void latch_recorder();
  void latch_variation();
  void latch_route();
  void use_route(const std::optional<databuffer::WorldState>& world);
  void latch(const runtime::TickLoop::Due& due);
  void take_events(std::int64_t tick);
  void take(const databuffer::InputEvent& event, std::size_t lane, std::int64_t tick);
  void publish_if_changed(std::int64_t tick);
  void publish_advice();

  databuffer::Session* session_;
  Parameters parameters_;
  std::span<const radar::RoutePoint> configured_route_;
  std::vector<radar::RoutePoint> changed_route_;  // the sequence points that an instructor has changed
  std::uint64_t worlds_latched_ = 0;              // records in the ring world_latched at the last look
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

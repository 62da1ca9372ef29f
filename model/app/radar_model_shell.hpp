// Shell of radar-model: latches the inputs of a session, calls the kernel and publishes the results, tick by tick.
// Inputs, latched once a tick: ownship, nav, traffic, world and radar state of the segment; the clock.
// Outputs: ModelTick (the latched inputs), latched traffic and world, Sweep, patch maps, ModelStatus, notes and log.
// Errors: a record that fails validation is refused, counted and noted; the last valid record stays in use.
// Threads: one, the thread of the tick loop.
// Source: docs/architecture.md#time, docs/architecture.md#kernel-and-shell.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "databuffer/session/receivers.hpp"
#include "databuffer/session/session.hpp"
#include "lib/radar/fidelity.hpp"
#include "lib/radar/world.hpp"
#include "model/app/background_shell.hpp"
#include "model/kernel/radar_kernel.hpp"
#include "model/kernel/tick_inputs.hpp"
#include "runtime/tick_loop.hpp"

namespace yars::radar {
struct RadarConfiguration;
}  // namespace yars::radar

namespace yars::model {

// Requests the terrain and the scenes that a radar model will need when it resumes from the session's model status.
// A standby calls it while it waits. No effect while the session has no status or no radar state. Resumes `kernel`,
// which serves only to find what is needed.
void load_ahead(const databuffer::Session& session, kernel::RadarKernel& kernel, TerrainLoader& terrain,
                SceneLoader& scenes);

class RadarModelShell {
 public:
  // Background workers. They must outlive the shell.
  struct Workers {
    TerrainLoader& terrain;
    SceneLoader& scenes;
    PatchMaker& patches;
  };
  RadarModelShell(databuffer::Session& session, const radar::RadarConfiguration& configuration, const Workers& workers);
  // Runs one tick. `late_ticks`: ticks that this process has skipped.
  void step(const runtime::TickLoop::Due& due, std::uint64_t late_ticks);

 private:
  void resume();
  void latch(const runtime::TickLoop::Due& due);
  void latch_command();
  void latch_traffic();
  void latch_world();
  void select_fidelity(std::string_view preset);
  void announce_jump(const databuffer::Ownship& ownship, std::uint32_t lane);
  void latch_fidelity();
  void govern(double elapsed_s, double rate);
  bool inherits_ownship(const runtime::TickLoop::Due& due) const;
  void await_ground(const terrain::TerrainRegion& region);
  void run_kernel(bool may_wait);
  void note_problems(const std::vector<std::string>& problems);
  void request_map();
  bool publish_due_map();
  void publish_map(const PatchMaker::Picture& picture);
  void publish_status(std::uint64_t late_ticks);

  databuffer::Session* session_;
  const radar::RadarConfiguration* configuration_;
  TerrainLoader* terrain_;
  SceneLoader* scenes_;
  SceneLoader::LoadedScenes loaded_scenes_;
  PatchMaker* patches_;
  kernel::RadarKernel kernel_;
  databuffer::OwnshipReceiver ownship_;
  databuffer::TrafficReceiver traffic_;
  PatchMaker::Targets targets_;  // movers and traffic in effect
  databuffer::Validated<databuffer::WorldState> wanted_world_;
  databuffer::ModelTick tick_{};
  databuffer::ModelStatus status_{};
  databuffer::Sweep sweep_{};
  std::uint64_t requested_map_ = 0;  // id and start tick of the last requested map
  std::int64_t requested_map_tick_ = -1;
  databuffer::Validated<databuffer::RadarState> radar_state_;
  std::array<std::uint64_t, 4> referenced_maps_{};  // ids of maps that the radar state names; the segment keeps them
  std::uint64_t refused_ = 0;                       // refused radar states, plus inputs that previous processes refused
  std::uint64_t previous_late_ticks_ = 0;           // ticks that previous processes skipped
  double load_ = 0.0;                               // processor time per tick / 5 ms, smoothed
  kernel::FidelityGovernor governor_;
  radar::Fidelity fidelity_;                          // selected by the instructor or the governor, or configured
  bool selected_fidelity_ = false;                    // by the instructor
  double scan_time_s_ = 0.0;                          // processor time of the current scan, multiplied by clock rate
  std::uint32_t scan_ticks_ = 0, governed_scan_ = 0;  // ticks and number of the current scan
  bool first_tick_ = true;
  std::uint32_t resumed_epoch_ = 0;  // epoch of the status from which this process resumed
};

}  // namespace yars::model

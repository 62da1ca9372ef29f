// The radar model as a process: once a tick it latches ownship and radar state, publishes what it latched, drives
// the kernel and publishes sweeps and status.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "databuffer/runtime/receivers.hpp"
#include "databuffer/runtime/tick_loop.hpp"
#include "databuffer/session/session.hpp"
#include "lib/radar/configuration.hpp"
#include "model/app/background_shell.hpp"
#include "model/kernel/radar_kernel.hpp"
#include "model/kernel/tick_inputs.hpp"

namespace yars::model {

class RadarModelShell {
 public:
  // What fills the kernel's needs; all outlive the shell.
  struct Makers {
    TerrainLoader& terrain;
    SceneLoader& scenes;
    PatchMaker& patches;
  };
  RadarModelShell(databuffer::Session& session, const radar::RadarConfiguration& configuration, const Makers& makers);
  void step(const databuffer::TickLoop::Due& due, std::uint64_t late_ticks);

 private:
  void resume();
  void latch(const databuffer::TickLoop::Due& due);
  void latch_command();
  void latch_traffic();
  void tell_of_jump(const databuffer::Ownship& there, std::uint32_t lane);
  void latch_fidelity();
  void govern(double seconds, double rate);
  void run_kernel();
  void note_problems(const std::vector<std::string>& problems);
  void ask_for_map();
  bool publish_due_map();
  void publish_map(const PatchMaker::Picture& picture);
  void publish_status(std::uint64_t late_ticks);

  databuffer::Session* session_;
  const radar::RadarConfiguration* configuration_;
  TerrainLoader* terrain_;
  SceneLoader* scenes_;
  SceneLoader::Held seen_scenes_;
  PatchMaker* patches_;
  kernel::RadarKernel kernel_;
  databuffer::OwnshipReceiver ownship_;
  databuffer::TrafficReceiver traffic_;
  std::vector<physics::MovingPoint> traffic_points_;
  databuffer::ModelTick tick_{};
  databuffer::ModelStatus status_{};
  databuffer::Sweep sweep_{};
  std::uint64_t state_version_ = 0;
  std::uint64_t map_asked_ = 0;  // id and start of the map that was asked for last
  std::int64_t map_asked_tick_ = -1;
  databuffer::RadarState asked_{};             // the last one latched
  std::array<std::uint64_t, 4> maps_named_{};  // by the radar state: they stay
  std::uint64_t refused_ = 0;                  // radar states
  std::uint64_t late_before_ = 0;              // ticks that predecessors skipped
  double load_ = 0.0;
  kernel::FidelityGovernor governor_;
  radar::Fidelity picked_;     // the governor's, or the configuration's
  double scan_seconds_ = 0.0;  // of processor time, in the scan under way
  std::uint32_t scan_ticks_ = 0, governed_scan_ = 0;
  bool first_tick_ = true;
};

}  // namespace yars::model

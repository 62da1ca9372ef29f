// Radar model as a pure step of one tick (5 ms sim time).
// Inputs: configuration; a ModelTick per step; terrain, scenes and traffic by reference.
// Outputs: a Sweep record when a tick completes one; the needed terrain region; ModelStatus; the pending patch map.
// Determinism: configuration, terrain, seed and the ticks so far determine every bit of a sweep.
// Errors: none. An invalid ownship record gives blank sweeps at the last valid position.
// Threads: one at a time per instance. step() does not allocate after the first call with a number of samples.
// Source: docs/architecture.md#kernel-and-shell, docs/radar_maths.md#from-tick-to-sweep.
#pragma once

#include <memory>

#include "databuffer/messages/model_records.hpp"
#include "model/kernel/map_schedule.hpp"
#include "model/physics/environment.hpp"

namespace yars::radar {
struct RadarConfiguration;
}  // namespace yars::radar

namespace yars::model::kernel {

class RadarKernel {
 public:
  explicit RadarKernel(const radar::RadarConfiguration& configuration);
  ~RadarKernel();
  RadarKernel(RadarKernel&&) noexcept;
  RadarKernel& operator=(RadarKernel&&) noexcept;

  // Continues servo, scan and sweep numbers from the last status of a previous process.
  void resume(const databuffer::ModelStatus& status);

  // Schedule of patch maps. The caller forms the pending map's picture by the time it is due. It reports completion by
  // the flag kTickMapComplete of the next tick.
  const MapSchedule& maps() const;

  // Terrain region that the tick's command needs, for prepare(). `ground` is false if no terrain is needed: without a
  // scan, in SNIFF without jammers, in BCN without beacons and jammers.
  struct Need {
    bool ground = false;
    terrain::TerrainRegion region;
  };
  Need need(const databuffer::ModelTick& tick) const;

  // Advances by one tick. Writes `sweep` and returns true if the tick completes a sweep. Uses no clock, file, log or
  // global variable.
  bool step(const databuffer::ModelTick& tick, const physics::Environment& environment, databuffer::Sweep& sweep);

  // Fills `status` except load, terrain_bytes, late_ticks and refused, which the shell fills.
  void describe(const terrain::TerrainView& terrain, databuffer::ModelStatus& status) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Fills the elevation [m] at the position that the state machine requests, and that position.
void answer_elevation(const databuffer::RadarState& request, const terrain::TerrainView& terrain,
                      databuffer::ModelStatus& status);

}  // namespace yars::model::kernel

// The radar model as one pure step: configuration, terrain, seed and the ticks up to now decide every sweep.
// The live process, `yars scan`, the tests and the benchmarks drive this same kernel.
#pragma once

#include <memory>

#include "databuffer/messages/model_records.hpp"
#include "lib/radar/configuration.hpp"
#include "model/kernel/map_schedule.hpp"
#include "model/physics/environment.hpp"

namespace yars::model::kernel {

class RadarKernel {
 public:
  explicit RadarKernel(const radar::RadarConfiguration& configuration);
  ~RadarKernel();
  RadarKernel(RadarKernel&&) noexcept;
  RadarKernel& operator=(RadarKernel&&) noexcept;

  // Takes up servo, scan and sweep numbers where a predecessor's status left them.
  void resume(const databuffer::ModelStatus& status);

  // The patch map under way: who drives the kernel has its picture ready when it is due, and says so by the flag
  // kTickMapComplete of the next tick.
  const MapSchedule& maps() const;

  // The region that the command needs at this place, for prepare(); none while nothing looks at the ground: without
  // video, in SNIFF without jammers, in BCN without beacons.
  struct Need {
    bool ground = false;
    terrain::TerrainRegion region;
  };
  Need need(const databuffer::ModelTick& tick) const;

  // Advances by one tick of 5 ms. Writes `sweep` and returns true when this tick completes a sweep. No allocation
  // after the first call of a sample count; no clock, file, log or global.
  bool step(const databuffer::ModelTick& tick, const physics::Environment& database, databuffer::Sweep& sweep);

  // Fills all but load, terrain_bytes, late_ticks, refused: those are the shell's.
  void describe(const terrain::TerrainView& terrain, databuffer::ModelStatus& status) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Tells the elevation [m] of the ground that the state machine asked for, and which ground that is.
void answer_elevation(const databuffer::RadarState& asked, const terrain::TerrainView& terrain,
                      databuffer::ModelStatus& status);

}  // namespace yars::model::kernel

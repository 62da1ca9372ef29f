// The radar model without clock, file, log or segment. step() advances the model by one tick of 5 ms sim time.
// Inputs: configuration; a ModelTick per step; terrain, scenes and traffic by reference; changes of the world.
// Outputs: a Sweep record when a tick completes one; the needed terrain region; ModelStatus; the pending patch map.
// Determinism: configuration (with its seed), terrain, scenes, traffic, changes of the world and the ticks so far
// determine every bit of a sweep.
// Errors: without a valid ownship record (state of the radar's own aircraft) sweeps start at the last valid position;
// with none so far there are no sweeps. If the record is flagged valid but has values out of range, sweeps are blank.
// Threads: one at a time per instance. step() allocates only if the number of samples or the preset changes.
// Source: docs/architecture.md#kernel-and-shell, docs/radar_maths.md#from-tick-to-sweep.
#pragma once

#include <memory>

#include "databuffer/messages/model_records.hpp"
#include "model/kernel/map_schedule.hpp"
#include "model/physics/environment.hpp"

namespace yars::radar {
struct RadarConfiguration;
struct WorldConfiguration;
}  // namespace yars::radar

namespace yars::model::kernel {

class RadarKernel {
 public:
  explicit RadarKernel(const radar::RadarConfiguration& configuration);
  ~RadarKernel();
  RadarKernel(RadarKernel&&) noexcept;
  RadarKernel& operator=(RadarKernel&&) noexcept;

  // Continues from the last status of a previous process: antenna, scan, velocity update, and the numbers of scans,
  // sweeps and maps.
  void resume(const databuffer::ModelStatus& status);

  // Uses the sea state, wind, rain cells, jammers and movers of another world from the next step on. The other parts of
  // `world` are those of the configuration. Allocates. An equal world changes nothing.
  void use_world(const radar::WorldConfiguration& world);

  // Schedule of patch maps. The caller forms the picture of the pending map. In the first tick with the map due and the
  // picture complete, the caller sets the flag kTickMapComplete.
  const MapSchedule& maps() const;

  // Terrain region that the commanded scan needs, for TerrainStore::prepare(). `ground` is false if no terrain is
  // needed: no scan is commanded, a patch map is commanded or shown, the scan is frozen, or there is no valid position
  // yet. SNIFF (receive only) without jammers and BCN (beacons only) without beacons and jammers need no terrain
  // either.
  struct Need {
    bool ground = false;
    terrain::TerrainRegion region;
  };
  Need need(const databuffer::ModelTick& tick) const;

  // Advances by one tick. If the tick completes a sweep, writes it to `sweep` and returns true.
  bool step(const databuffer::ModelTick& tick, const physics::Environment& environment, databuffer::Sweep& sweep);

  // Fills the fields of `status` that follow from the kernel's state and the terrain. The shell fills the other fields,
  // such as load, terrain_bytes, late_ticks and refused.
  void describe(const terrain::TerrainView& terrain, databuffer::ModelStatus& status) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Answers the state machine's request for a ground elevation: writes the requested position and the elevation there
// [m MSL] (NaN: unknown) to `status`.
void answer_elevation(const databuffer::RadarState& request, const terrain::TerrainView& terrain,
                      databuffer::ModelStatus& status);

}  // namespace yars::model::kernel

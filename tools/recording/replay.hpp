// Runs the kernel again over the ticks of a recording and compares its sweeps with those recorded.
#pragma once

#include <cstdint>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "model/kernel/radar_kernel.hpp"
#include "model/kernel/traffic_points.hpp"
#include "model/scene/scene_store.hpp"
#include "model/terrain/terrain_view.hpp"
#include "tools/recording/comparison.hpp"
#include "tools/recording/recorded_kinds.hpp"

namespace yars::tools::recording {

class Replay {
 public:
  // All must outlive it; without a store of scenes there are none.
  Replay(const radar::RadarConfiguration& configuration, model::terrain::TerrainStore& store,
         model::scene::SceneStore* scenes = nullptr);

  // Before ticks, or between them: a new kernel that goes on from there.
  void start(const StartingPoint& point);
  // The sweep that came out of it; nullptr: none, or one whose smear needs those from before the start.
  const databuffer::Sweep* tick(const databuffer::ModelTick& tick);
  // Holds from the next tick on.
  void traffic(const databuffer::Traffic& traffic) { traffic_ = model::kernel::points_of(traffic); }
  void recorded(const SweepMark& mark) { comparison_.recorded(mark); }

  std::uint64_t ticks() const { return ticks_; }
  std::uint64_t sweeps() const { return sweeps_; }
  const Comparison& comparison() const { return comparison_; }

 private:
  void restart(std::int64_t resumed_tick);

  const radar::RadarConfiguration* configuration_;
  model::terrain::TerrainStore* store_;
  model::kernel::RadarKernel kernel_;
  model::terrain::TerrainViewPointer view_;
  model::scene::SceneStore* scenes_;
  model::scene::SceneViewPointer scene_view_;
  std::vector<model::rbm::MovingPoint> traffic_;
  databuffer::Sweep sweep_{};
  databuffer::ModelStatus last_{}, before_last_{};  // after the newest tick and after the one before
  Comparison comparison_;
  std::uint64_t ticks_ = 0, sweeps_ = 0;
  std::uint64_t smeared_ = 0;  // sweeps to come whose smear needs those from before the start
};

}  // namespace yars::tools::recording

// One scan from one place without processes: the same chain as the live kernel, spread over threads. Sweep i is what
// the kernel makes of a hovering aircraft in its first scan: equal hashes, for any number of threads.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "databuffer/messages/model_records.hpp"
#include "lib/memory/line_vector.hpp"
#include "lib/parallel/thread_pool.hpp"
#include "lib/radar/configuration.hpp"
#include "model/kernel/sweep_chain.hpp"
#include "model/kernel/tick_inputs.hpp"
#include "model/rbm/algorithm.hpp"
#include "model/rbm/emitters.hpp"

namespace yars::model::kernel {

struct ScanRequest {
  Pose pose;
  geo::Length range;
  geo::Angle width;
  geo::Angle elevation;          // of the antenna, against the horizon
  int gain = 3;                  // 0..3
  std::int64_t sim_time_ns = 0;  // [ns] of the first sweep
  std::uint8_t band = 0;         // 0..4: A..E
  std::uint8_t channel = 1;      // 1..8
};

class OfflineScan {
 public:
  OfflineScan(const radar::RadarConfiguration& configuration, const ScanRequest& request, int threads);

  // Terrain to power to video and hashes. The threads do not wait for each other between the two.
  void run(const physics::Environment& database);
  // Terrain to power alone.
  void measure(const physics::Environment& database);

  std::span<const databuffer::Sweep> sweeps() const { return sweeps_; }
  // Where the sweeps lie, and the power that was found: sweep after sweep, full scale = 1.
  std::span<const SweepPlace> places() const { return places_; }
  std::span<const float> power() const { return power_; }

 private:
  std::span<float> power_of(std::size_t sweep) { return {power_.data() + sweep * samples_, samples_}; }
  // What a thread does alone: a run of neighbours, for the smear joins those.
  struct Part {
    std::size_t thread, first, end;
  };
  Part part(std::size_t thread) const;
  void measure_part(const Part& part, const physics::Environment& database);
  void form_sweep_video(std::size_t sweep, std::size_t thread);
  void await_measured(std::size_t thread);
  void place_sweeps(const radar::RadarConfiguration& configuration, const ScanRequest& request);

  std::uint64_t seed_;
  int gain_;
  std::size_t samples_;
  std::vector<std::unique_ptr<rbm::Algorithm>> algorithms_;  // one a thread
  std::vector<rbm::Strobes> strobes_;                        // one a thread
  std::vector<SweepPlace> places_;
  std::vector<std::uint32_t> flags_;
  std::vector<double> jamming_;
  memory::LineVector<float> power_;  // sweep after sweep
  std::vector<databuffer::Sweep> sweeps_;
  struct alignas(64) Progress {
    std::atomic<std::uint32_t> scans{0};  // that the thread has measured its part of in run()
  };
  std::uint32_t scans_ = 0;  // that run() has begun
  parallel::ThreadPool workers_;
  std::vector<Progress> measured_;  // one a thread
};

}  // namespace yars::model::kernel

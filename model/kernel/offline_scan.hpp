// Offline scan: one scan from one position, on several threads, without a session.
// Inputs: configuration, scan request, terrain, scenes and traffic.
// Outputs: sweep records with hashes; power of all samples (full scale = 1).
// Accuracy: with one bar, video and hashes equal those of the kernel's first scan from a hovering aircraft, bit by bit,
// for any number of threads. Further bars (scan_bars of the antenna) are not scanned.
// Threads: the caller uses one thread at a time; run() and measure() use the workers of a ThreadPool.
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
#include "model/kernel/sweep_chain.hpp"
#include "model/kernel/tick_inputs.hpp"
#include "model/rbm/algorithm.hpp"
#include "model/rbm/emitters.hpp"

namespace yars::model::kernel {

// Parameters of the scan.
struct ScanRequest {
  Pose pose;
  geo::Length range;
  geo::Angle width;
  geo::Angle elevation;          // antenna elevation above the horizontal
  int gain = 3;                  // 0..3
  std::int64_t sim_time_ns = 0;  // sim time of the first sweep
  std::uint8_t band = 0;         // 0..4: A..E
  std::uint8_t channel = 1;      // 1..8
};

// One scan with its buffers and threads.
class OfflineScan {
 public:
  OfflineScan(const physics::RadarParameters& parameters, const ScanRequest& request, int threads);

  // Computes power, video and hashes. Each thread computes successive sweeps. It waits for the other threads only
  // before it forms the video of the first and the last of these sweeps.
  void run(const physics::Environment& environment);
  // Computes power, without video and hashes.
  void measure(const physics::Environment& environment);

  std::span<const databuffer::Sweep> sweeps() const { return sweeps_; }
  // Geometry and settings of each sweep. power() has the power of all samples, sweep after sweep.
  std::span<const SweepHeader> headers() const { return positions_; }
  std::span<const float> power() const { return power_; }

 private:
  std::span<float> power_of(std::size_t sweep) { return {power_.data() + sweep * samples_, samples_}; }
  // Sweeps [first, end) of one thread. They are contiguous, because the azimuth smear joins neighbours.
  struct Part {
    std::size_t thread, first, end;
  };
  Part part(std::size_t thread) const;
  void measure_part(const Part& part, const physics::Environment& environment);
  void form_sweep_video(std::size_t sweep, std::size_t thread);
  void await_measured(std::size_t thread);
  void position_sweeps(const physics::RadarParameters& parameters, const ScanRequest& request);

  parallel::ThreadPool workers_;
  std::uint64_t seed_;
  int gain_;
  std::size_t samples_;
  std::vector<std::unique_ptr<rbm::Algorithm>> algorithms_;  // one per thread
  std::vector<rbm::Strobes> strobes_;                        // one per thread
  std::vector<SweepHeader> positions_;
  std::vector<std::uint32_t> flags_;
  std::vector<double> jamming_;              // by sweep; full scale = 1
  memory::CacheAlignedVector<float> power_;  // sweep after sweep
  std::vector<databuffer::Sweep> sweeps_;
  struct alignas(64) Progress {
    std::atomic<std::uint32_t> scans{0};  // number of run() calls in which the thread has measured its part
  };
  std::uint32_t scans_ = 0;         // number of run() calls
  std::vector<Progress> measured_;  // one per thread
};

}  // namespace yars::model::kernel

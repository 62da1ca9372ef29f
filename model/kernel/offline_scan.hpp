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
#include <utility>
#include <vector>

#include "databuffer/messages/model_records.hpp"
#include "lib/memory/line_vector.hpp"
#include "lib/parallel/thread_pool.hpp"
#include "model/kernel/sweep_chain.hpp"
#include "model/kernel/tick_inputs.hpp"
#include "model/rbm/beam.hpp"
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

  // Computes power, video and hashes. Each thread takes pieces of successive sweeps. No thread waits for another one
  // before it finds none to measure or to form. `goes_on` is asked before each sweep of the calling thread; throws
  // parallel::Stopped.
  void run(const physics::Environment& environment, const parallel::GoesOn& goes_on = {});
  // Computes power, without video and hashes.
  void measure(const physics::Environment& environment);

  std::span<const databuffer::Sweep> sweeps() const { return sweeps_; }
  // Geometry and settings of each sweep. power() has the power of all samples, sweep after sweep.
  std::span<const SweepHeader> headers() const { return positions_; }
  std::span<const float> power() const { return power_; }
  // Results of the functions above, moved out of this object. Call it last.
  struct Result {
    std::vector<databuffer::Sweep> sweeps;
    std::vector<SweepHeader> headers;
    memory::CacheAlignedVector<float> power;
  };
  Result take_result() { return {std::move(sweeps_), std::move(positions_), std::move(power_)}; }
  // Number of rays of the last scan, which sweeps share. Threads measure some rays at the ends of their pieces twice.
  std::size_t rays() const;

 private:
  std::span<float> power_of(std::size_t sweep) { return {power_.data() + sweep * samples_, samples_}; }
  // A piece is a number of successive sweeps that one thread measures or forms at a time.
  // First sweep of a piece. The first sweep of the piece `pieces()` is the number of sweeps.
  std::size_t first_of(std::size_t piece) const { return piece * positions_.size() / pieces(); }
  std::size_t pieces() const { return ready_.size(); }
  void begin_pass(const parallel::GoesOn& goes_on);
  bool stops(std::size_t thread);
  template <class Measured>
  void measure_pieces(std::size_t thread, const physics::Environment& environment, const Measured& measured);
  void measure_sweep(std::size_t sweep, std::size_t thread, const physics::Environment& environment);
  void form_if_ready(std::size_t piece, std::size_t thread);
  void form_sweep_video(std::size_t sweep, std::size_t thread);
  void position_sweeps(const physics::RadarParameters& parameters, const ScanRequest& request);

  parallel::ThreadPool workers_;
  std::uint64_t seed_;
  int gain_;
  std::size_t samples_;
  std::vector<rbm::Beam> beams_;       // one per thread
  std::vector<rbm::Strobes> strobes_;  // one per thread
  std::vector<SweepHeader> positions_;
  std::vector<std::uint32_t> flags_;
  std::vector<double> jamming_;                            // by sweep; full scale = 1
  std::vector<std::vector<physics::SteadyPower>> steady_;  // by sweep
  memory::CacheAlignedVector<float> power_;                // sweep after sweep
  std::vector<databuffer::Sweep> sweeps_;
  parallel::ChunkQueues to_measure_, to_form_;  // pieces
  // By piece: number of measured pieces among itself and its neighbours, and one when a thread has taken it to form it.
  std::vector<std::atomic<std::uint8_t>> ready_;
  const parallel::GoesOn* goes_on_ = nullptr;  // of the current run(); null: it goes on
  std::atomic<bool> stop_ = false;             // true: threads take no more sweeps
};

}  // namespace yars::model::kernel

#include "model/kernel/offline_scan.hpp"

#include <algorithm>

#include "lib/radar/modes.hpp"
#include "model/kernel/sweep_chain.hpp"
#include "model/physics/receiver.hpp"
#include "model/rbm/sub_beams.hpp"

namespace yars::model::kernel {

OfflineScan::OfflineScan(const physics::RadarParameters& parameters, const ScanRequest& request, int threads)
    : workers_(static_cast<std::size_t>(std::max(1, threads))),
      seed_(parameters.seed),
      gain_(request.gain),
      samples_(rbm::sample_count(parameters)),
      measured_(workers_.threads()) {
  position_sweeps(parameters, request);
  for (std::size_t thread = 0; thread < workers_.threads(); ++thread) {
    algorithms_.push_back(rbm::make_algorithm(parameters));
    strobes_.emplace_back(parameters);
  }
  flags_.assign(positions_.size(), 0U);
  jamming_.assign(positions_.size(), 0.0);
  power_.assign(positions_.size() * samples_, 0.0F);
  sweeps_.resize(positions_.size());
}

void OfflineScan::position_sweeps(const physics::RadarParameters& parameters, const ScanRequest& request) {
  const antenna::ScanPattern pattern = antenna::make_scan_pattern(parameters.antenna, request.width.degrees());
  const geo::Bearing centre = antenna::scan_centre(request.pose.platform, parameters.antenna);
  constexpr int kClockwise = 1;
  for (int i = 0; i < pattern.sweep_ticks; ++i) {
    positions_.push_back(
        {request.pose.position, request.pose.altitude, centre + geo::Angle::degrees(pattern.edge_deg(i, kClockwise)),
         centre + geo::Angle::degrees(pattern.edge_deg(i + 1, kClockwise)), request.pose.platform.ground_track,
         request.elevation, request.range, kClockwise, sim_time_of(request.sim_time_ns + i * radar::kTickNanoseconds),
         request.band, request.channel});
  }
}

// The assignment of sweeps to threads does not change results, because each sweep is measured from the inputs alone.
OfflineScan::Part OfflineScan::part(std::size_t thread) const {
  const std::size_t threads = workers_.threads();
  return {thread, thread * positions_.size() / threads, (thread + 1) * positions_.size() / threads};
}

void OfflineScan::measure_part(const Part& part, const physics::Environment& environment) {
  for (std::size_t sweep = part.first; sweep < part.end; ++sweep) {
    const physics::SweepGeometry geometry = geometry_of(positions_[sweep]);
    const std::size_t pending = algorithms_[part.thread]->measure(geometry, environment, power_of(sweep));
    jamming_[sweep] = strobes_[part.thread].level(geometry, environment.terrain);
    flags_[sweep] = pending > 0 || !environment.scenes_ready ? databuffer::kSweepNotReady : 0U;
  }
}

void OfflineScan::form_sweep_video(std::size_t sweep, std::size_t thread) {
  const std::size_t last = positions_.size() - 1;
  const std::size_t before = sweep > 0 ? sweep - 1 : 0;
  const std::size_t after = std::min(sweep + 1, last);
  SweepChain::Labels labels;
  labels.scan = 1;
  labels.number = static_cast<std::uint32_t>(sweep);
  labels.gain = static_cast<std::uint8_t>(std::clamp(gain_, 0, physics::kFullGain));
  labels.mode = static_cast<std::uint8_t>(radar::Mode::rbm);
  labels.flags = flags_[before] | flags_[sweep] | flags_[after];
  if (sweep == 0) labels.flags |= databuffer::kSweepScanStart;
  if (sweep == last) labels.flags |= databuffer::kSweepScanEnd;
  finish_sweep(*algorithms_[thread], seed_, positions_[sweep], labels,
               {power_of(before), power_of(sweep), power_of(after), jamming_[sweep]}, sweeps_[sweep]);
}

void OfflineScan::measure(const physics::Environment& environment) {
  workers_.run([&](std::size_t thread) { measure_part(part(thread), environment); });
}

void OfflineScan::await_measured(std::size_t thread) {
  const std::atomic<std::uint32_t>& scans = measured_[thread].scans;
  for (std::uint32_t seen = scans.load(std::memory_order_acquire); seen != scans_;)
    seen = parallel::wait_for_change(scans, seen);
}

void OfflineScan::run(const physics::Environment& environment) {
  ++scans_;
  workers_.run([&](std::size_t thread) {
    const Part own = part(thread);
    measure_part(own, environment);
    measured_[thread].scans.store(scans_, std::memory_order_release);
    measured_[thread].scans.notify_all();
    // The first and the last sweep of a part need power from neighbouring parts. The inner sweeps are formed first, to
    // reduce waiting.
    for (std::size_t sweep = own.first + 1; sweep + 1 < own.end; ++sweep) form_sweep_video(sweep, thread);
    for (std::size_t other = 0; other < measured_.size(); ++other) await_measured(other);
    if (own.first < own.end) form_sweep_video(own.first, thread);
    if (own.first + 1 < own.end) form_sweep_video(own.end - 1, thread);
  });
}

}  // namespace yars::model::kernel

#include "model/kernel/offline_scan.hpp"

#include <algorithm>
#include <numeric>

#include "lib/radar/modes.hpp"
#include "model/kernel/sweep_chain.hpp"
#include "model/physics/receiver.hpp"

namespace yars::model::kernel {

namespace {
// Sweeps of a piece: 20 to 100 us. A thread waits about so long at the end of a scan. With fewer, threads meet more
// often at the queues, and more often measure a ray that another thread has measured, too.
constexpr std::size_t kSweepsPerPiece = 6;
}  // namespace

OfflineScan::OfflineScan(const physics::RadarParameters& parameters, const ScanRequest& request, int threads)
    : workers_(static_cast<std::size_t>(std::max(1, threads))),
      seed_(parameters.seed),
      gain_(request.gain),
      samples_(rbm::sample_count(parameters)),
      to_measure_(workers_.threads()),
      to_form_(workers_.threads()) {
  position_sweeps(parameters, request);
  for (std::size_t thread = 0; thread < workers_.threads(); ++thread) {
    beams_.emplace_back(parameters);
    strobes_.emplace_back(parameters);
  }
  flags_.assign(positions_.size(), 0U);
  jamming_.assign(positions_.size(), 0.0);
  steady_.resize(positions_.size());
  power_.assign(positions_.size() * samples_, 0.0F);
  sweeps_.resize(positions_.size());
  ready_ = std::vector<std::atomic<std::uint8_t>>(std::max(positions_.size() / kSweepsPerPiece, std::size_t{1}));
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
    positions_.back().ground_speed = request.pose.ground_speed;
  }
}

// Measures pieces as long as there are any, and calls `measured` after each. The assignment of sweeps to threads and
// their order do not change results, because each sweep is measured from the inputs alone. Successive sweeps share
// rays: a thread takes its own pieces from left to right, and those of other threads from right to left.
template <class Measured>
void OfflineScan::measure_pieces(std::size_t thread, const physics::Environment& environment,
                                 const Measured& measured) {
  int before = -1;
  for (int piece = to_measure_.take(thread); piece >= 0; piece = to_measure_.take(thread)) {
    const std::size_t first = first_of(static_cast<std::size_t>(piece));
    const std::size_t end = first_of(static_cast<std::size_t>(piece) + 1);
    const bool leftwards = before >= 0 && piece != before + 1;
    for (std::size_t i = first; i < end; ++i) {
      if (stops(thread)) return;
      measure_sweep(leftwards ? end - 1 - (i - first) : i, thread, environment);
    }
    before = piece;
    measured(static_cast<std::size_t>(piece));
  }
}

void OfflineScan::measure_sweep(std::size_t sweep, std::size_t thread, const physics::Environment& environment) {
  const physics::SweepGeometry geometry = geometry_of(positions_[sweep]);
  jamming_[sweep] = strobes_[thread].level(geometry, environment.terrain);
  const std::size_t pending = beams_[thread].measure(geometry, environment, power_of(sweep));
  const auto steady = beams_[thread].steady();
  steady_[sweep].assign(steady.begin(), steady.end());
  flags_[sweep] = pending > 0 || !environment.scenes_ready ? databuffer::kSweepNotReady : 0U;
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
  physics::PowerWindow window{power_of(before), power_of(sweep), power_of(after), jamming_[sweep]};
  window.steady = {steady_[before], steady_[sweep], steady_[after]};
  finish_sweep(beams_[thread], seed_, positions_[sweep], labels, window, sweeps_[sweep]);
}

// Call it when a thread takes the piece to form it, and when it or a neighbour is measured. The last of these calls
// forms the video. So no thread waits for the power of a neighbouring piece.
void OfflineScan::form_if_ready(std::size_t piece, std::size_t thread) {
  const int neighbours = (piece > 0 ? 1 : 0) + (piece + 1 < pieces() ? 1 : 0);
  const int calls_before = ready_[piece].fetch_add(1, std::memory_order_acq_rel);
  if (calls_before != 1 + neighbours) return;
  for (std::size_t sweep = first_of(piece); sweep < first_of(piece + 1); ++sweep) form_sweep_video(sweep, thread);
}

// Thread 0 is the caller. Work of other threads must not throw, so all of them return.
bool OfflineScan::stops(std::size_t thread) {
  if (thread == 0 && goes_on_ != nullptr && !(*goes_on_)()) stop_.store(true, std::memory_order_relaxed);
  return stop_.load(std::memory_order_relaxed);
}

void OfflineScan::begin_pass(const parallel::GoesOn& goes_on) {
  goes_on_ = goes_on ? &goes_on : nullptr;
  stop_.store(false, std::memory_order_relaxed);
  for (rbm::Beam& beam : beams_) beam.begin_pass();
}

std::size_t OfflineScan::rays() const {
  return std::accumulate(beams_.begin(), beams_.end(), std::size_t{0},
                         [](std::size_t sum, const rbm::Beam& beam) { return sum + beam.rays(); });
}

void OfflineScan::measure(const physics::Environment& environment) {
  begin_pass({});
  to_measure_.begin(pieces());
  workers_.run([&](std::size_t thread) { measure_pieces(thread, environment, [](std::size_t) {}); });
}

// A thread measures until nothing is left to measure, and forms then. That is faster than both in turn.
void OfflineScan::run(const physics::Environment& environment, const parallel::GoesOn& goes_on) {
  for (std::atomic<std::uint8_t>& ready : ready_) ready.store(0, std::memory_order_relaxed);
  begin_pass(goes_on);
  to_measure_.begin(pieces());
  to_form_.begin(pieces());
  workers_.run([&](std::size_t thread) {
    measure_pieces(thread, environment, [&](std::size_t piece) {
      if (piece > 0) form_if_ready(piece - 1, thread);
      form_if_ready(piece, thread);
      if (piece + 1 < pieces()) form_if_ready(piece + 1, thread);
    });
    for (int piece = to_form_.take(thread); piece >= 0 && !stops(thread); piece = to_form_.take(thread))
      form_if_ready(static_cast<std::size_t>(piece), thread);
  });
  if (stop_.load(std::memory_order_relaxed)) throw parallel::Stopped{};
}

}  // namespace yars::model::kernel

// From what the beam sweeps, tick by tick, to finished sweep records: measures each sweep, keeps the three newest, and
// finishes the middle one when its successor is there. So a sweep comes out one tick after it was measured, with its
// own place, and the azimuth smear shifts nothing. At an end of a pass the last sweep stands in for its successor.
// No allocation after construction.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "databuffer/records/model_records.hpp"
#include "lib/memory/line_vector.hpp"
#include "lib/radar/configuration.hpp"
#include "model/kernel/sweep_record.hpp"
#include "model/rbm/algorithm.hpp"
#include "model/rbm/beacons.hpp"
#include "model/rbm/strobes.hpp"

namespace yars::model::kernel {

class SweepChain {
 public:
  explicit SweepChain(const radar::RadarConfiguration& configuration);

  // Numbers, times, flags, mode and gain of a sweep go in with its place.
  struct Labels {
    std::int64_t tick = 0;
    std::int64_t sim_time_ns = 0;
    std::uint32_t epoch = 0;
    std::uint32_t scan = 0;
    std::uint32_t number = 0;
    std::uint32_t flags = 0;  // kSweep...; a blank sweep reads no terrain, one of noise only for what hides jammers
    std::uint8_t mode = 0;
    std::uint8_t gain = 3;
    bool dark = false;  // transmitted, but nothing comes back: black video, which covers what was there
  };

  // Takes in the next sweep. Finishes its predecessor into `sweep` and returns true if there is one.
  bool advance(const SweepPlace& place, const Labels& labels, const rbm::Database& database, databuffer::Sweep& sweep);
  // Ends the pass: finishes the sweep that still waits for a successor.
  bool flush(databuffer::Sweep& sweep);
  // Forgets what is under way.
  void clear() { held_ = 0; }

  std::size_t samples() const { return samples_; }
  std::uint64_t posts_pending() const { return posts_pending_; }

 private:
  struct Measured {
    SweepPlace place;
    Labels labels;
    double jamming = 0.0;  // full scale = 1
    memory::LineVector<float> power;
  };
  void receive(Measured& measured, const rbm::Database& database);
  void finish(const Measured& before, const Measured& centre, const Measured& after, databuffer::Sweep& sweep);
  Measured& newest(std::size_t age) { return measured_[(next_ + measured_.size() - 1 - age) % measured_.size()]; }

  std::uint64_t seed_;
  std::size_t samples_;
  std::unique_ptr<rbm::Algorithm> algorithm_;
  rbm::Strobes strobes_;
  rbm::Beacons beacons_;
  std::array<Measured, 3> measured_;
  std::size_t next_ = 0;  // slot that the next sweep takes
  std::size_t held_ = 0;  // newest ones that belong to this pass, at most 2
  std::uint64_t posts_pending_ = 0;
};

// The video of one measured sweep among its neighbours, with place, labels and hash: a finished record.
void finish_sweep(rbm::Algorithm& algorithm, std::uint64_t seed, const SweepPlace& place,
                  const SweepChain::Labels& labels, const rbm::PowerWindow& window, databuffer::Sweep& sweep);

}  // namespace yars::model::kernel

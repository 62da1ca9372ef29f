// Finished sweep records from measured sweeps: position, video, hash.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "databuffer/messages/model_records.hpp"
#include "lib/memory/line_vector.hpp"
#include "lib/radar/configuration.hpp"
#include "model/antenna/antenna.hpp"
#include "model/physics/sweep_geometry.hpp"
#include "model/rbm/algorithm.hpp"
#include "model/rbm/emitters.hpp"

namespace yars::model::kernel {

// The record of a sweep but for its video, and its hash.

// Where and how one sweep was measured: the fields of its record, without video and hash.
struct SweepPlace {
  geo::GeoPoint apex;
  geo::AltitudeMsl altitude;
  geo::Bearing left;
  geo::Bearing right;
  geo::Bearing ground_track;
  geo::Angle elevation;
  geo::Length range;
  int direction = 1;
  geo::Duration sim_time{};                 // not part of the record's place
  std::uint8_t band = 0;                    // 0..4: A..E
  std::uint8_t channel = 1;                 // 1..8
  std::optional<geo::Bearing> looked_at{};  // where the beam's centre looks if not to the middle of the wedge
  std::optional<geo::Angle> resolved{};     // width of the cell of a sharpened beam
  geo::Angle bars_above{};                  // as in physics::SweepGeometry
  geo::Angle bars_below{};
};

// Sim time as movers go by it.
inline geo::Duration sim_time_of(std::int64_t sim_time_ns) {
  return geo::Duration::seconds(static_cast<double>(sim_time_ns) * 1e-9);
}

// Fills all of `sweep` but video, hash, times, numbers and flags.
void write_place(const SweepPlace& place, databuffer::Sweep& sweep);

// What the beam's centre looks at: the middle of the wedge, unless the place says otherwise.
physics::SweepGeometry look_of(const SweepPlace& place);

// XXH3 64 over the record's fields before `hash` but for the times, then, seeded with that, over the used samples.
std::uint64_t sweep_hash(const databuffer::Sweep& sweep);

// One number for a scan: XXH3 64 over the hashes of its sweeps, in order, each seeded with the one before.
std::uint64_t scan_hash(std::span<const databuffer::Sweep> sweeps);

// From what the beam sweeps, tick by tick, to finished sweep records: measures each sweep, keeps the three newest, and
// finishes the middle one when its successor is there. So a sweep comes out one tick after it was measured, with its
// own place, and the azimuth smear shifts nothing. At an end of a pass the last sweep stands in for its successor.
// No allocation after construction.
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
  bool advance(const SweepPlace& place, const Labels& labels, const physics::Environment& database,
               databuffer::Sweep& sweep);
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
  void receive(Measured& measured, const physics::Environment& database);
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
                  const SweepChain::Labels& labels, const physics::PowerWindow& window, databuffer::Sweep& sweep);

}  // namespace yars::model::kernel

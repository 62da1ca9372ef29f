// Finishes measured sweeps into sweep records: position, azimuth smear, video, hash.
// A pass is one crossing of the scan width by the antenna.
// Inputs: position and labels of each sweep; terrain, scenes and traffic.
// Outputs: Sweep records, each when the next sweep is measured or the pass ends. Hashes (checksums) are XXH3, 64 bits.
// Errors: sweeps over terrain that is not loaded are flagged not ready.
// Threads: one at a time per chain. No allocation after construction.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "databuffer/messages/model_records.hpp"
#include "lib/memory/line_vector.hpp"
#include "model/antenna/antenna.hpp"
#include "model/physics/sweep_geometry.hpp"
#include "model/rbm/beam.hpp"
#include "model/rbm/emitters.hpp"

namespace yars::radar {
struct WorldChanges;
}  // namespace yars::radar

namespace yars::model::kernel {

// Position and geometry of one sweep: the fields of its record without labels, video and hash; and what else its ray
// geometry needs.
struct SweepHeader {
  geo::GeoPoint apex;
  geo::AltitudeMsl altitude;  // of the aircraft
  geo::Bearing left;          // true bearings of the wedge's left and right edge
  geo::Bearing right;
  geo::Bearing ground_track;
  geo::Angle elevation;                        // of the antenna, above the horizontal
  geo::Length range;                           // selected range
  int direction = 1;                           // of the antenna; 1: clockwise, -1: counter-clockwise
  geo::Duration sim_time{};                    // for positions of movers; the record's sim time is in Labels
  std::uint8_t band = 0;                       // 0..4: A..E
  std::uint8_t channel = 1;                    // 1..8
  std::optional<geo::Bearing> beam_azimuth{};  // true azimuth of the beam's centre; nullopt: middle of the wedge
  std::optional<geo::Angle> dbs_cell_width{};  // cell width of Doppler beam sharpening; nullopt: real beam
  // Angles from `elevation` up to the scan's highest bar and down to its lowest bar; 0 with one bar.
  geo::Angle bars_above{};
  geo::Angle bars_below{};
  geo::Speed ground_speed{};
};

inline geo::Duration sim_time_of(std::int64_t sim_time_ns) {
  return geo::Duration::seconds(static_cast<double>(sim_time_ns) * 1e-9);
}

void write_header(const SweepHeader& header, databuffer::Sweep& sweep);

// Geometry of a sweep. The azimuth is `beam_azimuth`, or else the middle of the wedge.
physics::SweepGeometry geometry_of(const SweepHeader& header);

// Hash of a scan: XXH3 64 over the hashes of its sweeps in order, each seeded with the previous result.
std::uint64_t scan_hash(std::span<const databuffer::Sweep> sweeps);

// Measures each sweep, stores the three newest, and finishes a sweep when its successor is measured or flush() ends the
// pass. The record has the sweep's own position, so the azimuth smear does not displace the picture. The first
// sweep of a pass also serves as its own predecessor, the last one as its own successor.
// With sub-beams a sweep also depends on earlier sweeps of its pass (rbm::Beam), back to a sweep with kSweepScanStart
// at most.
class SweepChain {
 public:
  explicit SweepChain(const physics::RadarParameters& parameters);

  // Fields of a sweep record that do not follow from its geometry.
  struct Labels {
    std::int64_t tick = 0;
    std::int64_t sim_time_ns = 0;
    std::uint32_t epoch = 0;
    std::uint32_t scan = 0;
    std::uint32_t number = 0;
    std::uint32_t flags = 0;  // databuffer::kSweepBlank, kSweepNoiseOnly and others
    std::uint8_t mode = 0;
    std::uint8_t gain = 3;
    bool no_return = false;  // blind zone: black video replaces the old picture; kSweepBlank leaves the old picture
  };

  // Uses the changed parts of another world, which `parameters` has, for the sweeps that are measured from here on.
  // Measured sweeps keep their power.
  void use_world(const physics::RadarParameters& parameters, const radar::WorldChanges& changes);

  // Measures the next sweep. If the pass has a sweep before it, finishes that one into `sweep` and returns true.
  bool advance(const SweepHeader& header, const Labels& labels, const physics::Environment& environment,
               databuffer::Sweep& sweep);
  // Ends the pass: finishes the last sweep, which has no successor. Returns false if no sweep is unfinished.
  bool flush(databuffer::Sweep& sweep);
  void clear() { held_ = 0; }  // drops the unfinished sweep

  std::size_t samples() const { return samples_; }
  // Number of samples so far on terrain that was not loaded.
  std::uint64_t posts_pending() const { return posts_pending_; }

 private:
  // A sweep with its power, from which the video of this sweep and of its two neighbours is formed.
  struct Measured {
    SweepHeader header;
    Labels labels;
    double jamming = 0.0;  // received jamming power, equal in all samples; full scale = 1
    memory::CacheAlignedVector<float> power;
    std::vector<physics::SteadyPower> steady;  // of `power`
  };
  void begin_pass();
  void flag_descendant(Labels& labels);
  void receive(Measured& measured, const physics::Environment& environment);
  void finish(const Measured& before, const Measured& centre, const Measured& after, databuffer::Sweep& sweep);
  Measured& newest(std::size_t age) { return measured_[(next_ + measured_.size() - 1 - age) % measured_.size()]; }

  rbm::Beam beam_;
  std::uint64_t seed_;
  std::size_t samples_;
  rbm::Strobes strobes_;
  rbm::Beacons beacons_;
  std::array<Measured, 3> measured_;
  std::size_t next_ = 0;  // index of the next sweep in measured_
  std::size_t held_ = 0;  // how many of the two newest sweeps belong to this pass: 0 to 2
  std::uint64_t posts_pending_ = 0;
  std::optional<std::int64_t> not_ready_until_ns_;  // sim time until which rays over terrain not loaded may be in use
};

// Fills a sweep record: position, labels, video of the sweep `window.centre`, hash.
void finish_sweep(rbm::Beam& beam, std::uint64_t seed, const SweepHeader& header, const SweepChain::Labels& labels,
                  const physics::PowerWindow& window, databuffer::Sweep& sweep);

}  // namespace yars::model::kernel

// The record of a sweep but for its video, and its hash.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "databuffer/records/model_records.hpp"
#include "model/antenna/antenna.hpp"
#include "model/rbm/look.hpp"

namespace yars::model::kernel {

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
  geo::Angle bars_above{};                  // as in rbm::Look
  geo::Angle bars_below{};
};

// Sim time as movers go by it.
inline geo::Duration sim_time_of(std::int64_t sim_time_ns) {
  return geo::Duration::seconds(static_cast<double>(sim_time_ns) * 1e-9);
}

// Fills all of `sweep` but video, hash, times, numbers and flags.
void write_place(const SweepPlace& place, databuffer::Sweep& sweep);

// What the beam's centre looks at: the middle of the wedge, unless the place says otherwise.
rbm::Look look_of(const SweepPlace& place);

// XXH3 64 over the record's fields before `hash` but for the times, then, seeded with that, over the used samples.
std::uint64_t sweep_hash(const databuffer::Sweep& sweep);

// One number for a scan: XXH3 64 over the hashes of its sweeps, in order, each seeded with the one before.
std::uint64_t scan_hash(std::span<const databuffer::Sweep> sweeps);

}  // namespace yars::model::kernel

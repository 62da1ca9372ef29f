#include "model/kernel/sweep_record.hpp"

#include <algorithm>
#include <array>
#include <bit>

namespace yars::model::kernel {

namespace {
constexpr std::uint64_t kFnvOffset = 0xcbf29ce484222325ULL;
constexpr std::uint64_t kFnvPrime = 0x100000001b3ULL;

std::uint64_t absorb(std::uint64_t hash, std::uint8_t byte) {
  return (hash ^ byte) * kFnvPrime;
}

std::uint64_t absorb_word(std::uint64_t hash, std::uint64_t word) {
  for (unsigned shift = 0; shift < 64U; shift += 8U) hash = absorb(hash, static_cast<std::uint8_t>(word >> shift));
  return hash;
}
}  // namespace

void write_place(const SweepPlace& place, databuffer::Sweep& sweep) {
  sweep.apex_latitude_deg = place.apex.latitude_deg;
  sweep.apex_longitude_deg = place.apex.longitude_deg;
  sweep.apex_altitude_msl_m = place.altitude.metres();
  sweep.azimuth_left_deg = place.left.degrees();
  sweep.azimuth_right_deg = place.right.degrees();
  sweep.ground_track_deg = place.ground_track.degrees();
  sweep.elevation_deg = place.elevation.degrees();
  sweep.range_m = place.range.metres();
  sweep.direction = place.direction > 0 ? 1 : 0;
}

rbm::Look look_of(const SweepPlace& place) {
  const geo::Angle width = place.right - place.left;
  return {place.apex, place.altitude, place.left + 0.5 * width, place.elevation, place.range, place.sim_time,
          place.band, place.channel};
}

std::uint64_t sweep_hash(const databuffer::Sweep& sweep) {
  const std::array<double, 8> fields{
      sweep.apex_latitude_deg, sweep.apex_longitude_deg, sweep.apex_altitude_msl_m, sweep.azimuth_left_deg,
      sweep.azimuth_right_deg, sweep.ground_track_deg,   sweep.elevation_deg,       sweep.range_m};
  std::uint64_t hash = kFnvOffset;
  for (const double field : fields) hash = absorb_word(hash, std::bit_cast<std::uint64_t>(field));
  const std::size_t used = std::min<std::size_t>(sweep.samples, radar::kMaxSamples);
  for (std::size_t i = 0; i < used; ++i) hash = absorb(hash, sweep.video[i]);
  return hash;
}

std::uint64_t scan_hash(std::span<const databuffer::Sweep> sweeps) {
  std::uint64_t hash = kFnvOffset;
  for (const databuffer::Sweep& sweep : sweeps) hash = absorb_word(hash, sweep.hash);
  return hash;
}

}  // namespace yars::model::kernel

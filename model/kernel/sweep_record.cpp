#include "model/kernel/sweep_record.hpp"

#include <xxhash.h>

#include <algorithm>
#include <array>

namespace yars::model::kernel {

namespace {
constexpr XXH64_hash_t kSeed = 0;
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
  rbm::Look look{place.apex,      place.altitude, place.looked_at.value_or(place.left + 0.5 * width),
                 place.elevation, place.range,    place.sim_time,
                 place.band,      place.channel};
  look.bars_above = place.bars_above;
  look.bars_below = place.bars_below;
  if (place.resolved) {
    look.share.left_rad = -0.5 * place.resolved->radians();
    look.share.right_rad = 0.5 * place.resolved->radians();
    look.share.sharpened = true;
  }
  return look;
}

std::uint64_t sweep_hash(const databuffer::Sweep& sweep) {
  const std::array<double, 8> fields{
      sweep.apex_latitude_deg, sweep.apex_longitude_deg, sweep.apex_altitude_msl_m, sweep.azimuth_left_deg,
      sweep.azimuth_right_deg, sweep.ground_track_deg,   sweep.elevation_deg,       sweep.range_m};
  const std::uint64_t place = XXH3_64bits_withSeed(fields.data(), sizeof fields, kSeed);
  const std::size_t used = std::min<std::size_t>(sweep.samples, radar::kMaxSamples);
  return XXH3_64bits_withSeed(sweep.video, used, place);
}

std::uint64_t scan_hash(std::span<const databuffer::Sweep> sweeps) {
  XXH64_hash_t hash = kSeed;
  for (const databuffer::Sweep& sweep : sweeps) hash = XXH3_64bits_withSeed(&sweep.hash, sizeof sweep.hash, hash);
  return hash;
}

}  // namespace yars::model::kernel

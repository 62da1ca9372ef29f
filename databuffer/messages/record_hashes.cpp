#include "databuffer/messages/record_hashes.hpp"

#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cstddef>

#include "lib/radar/modes.hpp"

namespace yars::databuffer {

std::uint64_t sweep_hash(const Sweep& sweep) {
  const std::array<double, 8> fields{
      sweep.apex_latitude_deg, sweep.apex_longitude_deg, sweep.apex_altitude_msl_m, sweep.azimuth_left_deg,
      sweep.azimuth_right_deg, sweep.ground_track_deg,   sweep.elevation_deg,       sweep.range_m};
  const std::size_t used = std::min<std::size_t>(sweep.samples, radar::kMaxSamples);
  return XXH3_64bits_withSeed(sweep.video, used, XXH3_64bits(fields.data(), sizeof fields));
}

std::uint64_t map_hash(const PatchMap& map, std::span<const std::uint8_t> pixels) {
  const std::array<double, 12> fields{
      map.latitude_deg, map.longitude_deg,     map.elevation_msl_m,    map.up_deg,
      map.window_nm,    map.apex_latitude_deg, map.apex_longitude_deg, map.apex_altitude_msl_m,
      map.distance_m,   map.squint_deg,        map.resolution_m,       map.formation_s};
  return XXH3_64bits_withSeed(pixels.data(), pixels.size(), XXH3_64bits(fields.data(), sizeof fields));
}

}  // namespace yars::databuffer

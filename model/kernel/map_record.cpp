#include "model/kernel/map_record.hpp"

#include <xxhash.h>

#include <array>

namespace yars::model::kernel {

std::uint64_t map_hash(const databuffer::PatchMap& map, std::span<const std::uint8_t> pixels) {
  const std::array<double, 12> fields{
      map.latitude_deg, map.longitude_deg,     map.elevation_msl_m,    map.up_deg,
      map.window_nm,    map.apex_latitude_deg, map.apex_longitude_deg, map.apex_altitude_msl_m,
      map.distance_m,   map.squint_deg,        map.resolution_m,       map.formation_s};
  return XXH3_64bits_withSeed(pixels.data(), pixels.size(), XXH3_64bits(fields.data(), sizeof fields));
}

}  // namespace yars::model::kernel

// Patch maps whose pixels are a function of their id, so that a test detects a copy torn between two maps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "databuffer/messages/pictures.hpp"

namespace yars::databuffer::testing {

inline PatchMap made_up_map(std::uint64_t id, std::uint32_t size) {
  PatchMap map{};
  map.id = id;
  map.size = size;
  map.latitude_deg = 34.4;
  map.longitude_deg = -120.3;
  map.up_deg = 60.0;
  map.window_nm = 4.7;
  map.apex_latitude_deg = 34.2;
  map.apex_longitude_deg = -120.6;
  map.apex_altitude_msl_m = 4572.0;
  map.distance_m = 37'040.0;
  map.squint_deg = 30.0;
  map.resolution_m = 18.0;
  map.formation_s = 3.0;
  map.epoch = static_cast<std::uint32_t>(id % 7);
  map.hash = id * 0x9e3779b97f4a7c15U;
  return map;
}

inline std::uint8_t made_up_pixel(std::uint64_t id, std::size_t position) {
  const std::uint64_t mixed = (id + 1) * 0x9e3779b97f4a7c15U + position * 0xbf58476d1ce4e5b9U;
  return static_cast<std::uint8_t>(mixed >> 56);
}

inline std::vector<std::uint8_t> made_up_pixels(std::uint64_t id, std::uint32_t size) {
  std::vector<std::uint8_t> pixels(std::size_t{size} * size);
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = made_up_pixel(id, i);
  return pixels;
}

// True: record and pixels belong to one map, and none is missing.
inline bool is_whole(const PatchMap& map, const std::vector<std::uint8_t>& pixels) {
  if (map.hash != map.id * 0x9e3779b97f4a7c15U || pixels.size() != std::size_t{map.size} * map.size) return false;
  for (std::size_t i = 0; i < pixels.size(); ++i)
    if (pixels[i] != made_up_pixel(map.id, i)) return false;
  return true;
}

}  // namespace yars::databuffer::testing

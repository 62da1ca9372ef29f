// The layout of DTED levels 0, 1 and 2, shared by reader and writer. Source: MIL-PRF-89020B 3.11 and 3.12.
#pragma once

#include <cstddef>
#include <cstdint>

namespace yars::model::terrain::dted {

inline constexpr std::size_t kUserHeaderBytes = 80;    // UHL
inline constexpr std::size_t kDescriptionBytes = 648;  // DSI
inline constexpr std::size_t kVerticalDatumAt = 141;   // in DSI
inline constexpr std::size_t kVerticalDatumBytes = 3;
inline constexpr std::size_t kHorizontalDatumAt = 144;
inline constexpr std::size_t kHorizontalDatumBytes = 5;
inline constexpr std::size_t kAccuracyBytes = 2700;  // ACC
inline constexpr std::size_t kHeaderBytes = kUserHeaderBytes + kDescriptionBytes + kAccuracyBytes;
inline constexpr std::size_t kRecordHeadBytes = 8;  // sentinel, count, longitude and latitude index
inline constexpr std::size_t kRecordSumBytes = 4;   // sum of the bytes before it
inline constexpr std::size_t kLabelBytes = 80;      // VOL and HDR labels of a tape, before UHL
inline constexpr std::uint8_t kRecordSentinel = 0xAA;
inline constexpr std::uint16_t kVoidWord = 0xFFFF;         // -32767 in sign-magnitude
inline constexpr int kPostsOfLevel[] = {121, 1201, 3601};  // posts along a meridian, by level
inline constexpr int kTenthsPerDegree = 36000;             // intervals are in tenths of an arc second

// Posts along a parallel are spaced this many times wider than along a meridian (zones I to V).
constexpr int zone_factor(int south_deg) {
  const int nearest_equator_deg = south_deg >= 0 ? south_deg : -south_deg - 1;
  if (nearest_equator_deg < 50) return 1;
  if (nearest_equator_deg < 70) return 2;
  if (nearest_equator_deg < 75) return 3;
  return nearest_equator_deg < 80 ? 4 : 6;
}

constexpr std::size_t record_bytes(int posts) {
  return kRecordHeadBytes + 2 * static_cast<std::size_t>(posts) + kRecordSumBytes;
}

}  // namespace yars::model::terrain::dted

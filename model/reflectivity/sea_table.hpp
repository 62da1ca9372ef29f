// The sea's sigma0 over the grazing angle as a table, for loops over the samples of a sweep: piecewise linear over the
// sine, sixteen pieces an octave, found from the bits of the float alone. Within 0.02 dB of sea_sigma0() from 0.02 to
// 15 degrees, 0.2 dB to 55, 0.4 dB where the model ends at 60. What does not depend on the look is computed once, as
// octaves: a sweep costs one exp2 an entry. Below the first entry sigma0 falls as the sine.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "model/reflectivity/sea.hpp"

namespace yars::model::reflectivity {

struct SeaTable {
  static constexpr std::uint32_t kFirst = (127U - 12U) << 23U;  // bits of 2^-12: 0.014 degrees
  static constexpr std::uint32_t kShift = 19U;                  // sixteen pieces an octave
  static constexpr std::size_t kPieces = 192;                   // twelve octaves, to the sine of 90 degrees

  std::array<float, kPieces + 1> across{};  // log2 of sigma0 looking across the wind
  std::array<float, kPieces + 1> upwind{};  // octaves more looking upwind; times the cosine of the angle off the wind
};
SeaTable make_sea_table(const SeaReturn& sea);

}  // namespace yars::model::reflectivity

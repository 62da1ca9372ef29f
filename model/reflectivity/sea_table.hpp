// The sea's sigma0 over the grazing angle as a table, for loops over the samples of a sweep: piecewise linear over the
// sine, sixteen pieces an octave, found from the bits of the float alone. Within 0.02 dB of sea_sigma0() from 0.02 to
// 15 degrees, 0.2 dB to 55, 0.4 dB where the model ends at 60. What does not depend on the look is computed once; a
// sweep costs one exp2 an entry.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "model/reflectivity/sea.hpp"

namespace yars::model::reflectivity {

struct SeaTable {
  static constexpr std::uint32_t kFirst = (127U - 12U) << 23U;  // bits of 2^-12: 0.014 degrees; less returns its share
  static constexpr std::uint32_t kShift = 19U;                  // sixteen pieces an octave
  static constexpr std::size_t kPieces = 192;                   // twelve octaves, to the sine of 90 degrees
  std::array<float, kPieces + 1> sigma0{};

  // `sin_grazing` [0, 1].
  float at(float sin_grazing) const {
    constexpr float kStep = 1.0F / static_cast<float>(1U << kShift);
    const auto least = std::bit_cast<float>(kFirst);
    const float inside = sin_grazing > least ? sin_grazing : least;
    const std::uint32_t place = std::bit_cast<std::uint32_t>(inside) - kFirst;
    const std::uint32_t piece = place >> kShift < kPieces ? place >> kShift : kPieces - 1;
    const float share = static_cast<float>(static_cast<std::int32_t>(place - (piece << kShift))) * kStep;
    const float value = sigma0[piece] + share * (sigma0[piece + 1] - sigma0[piece]);
    return sin_grazing > least ? value : value * sin_grazing / least;
  }
};

class SeaTables {
 public:
  explicit SeaTables(const SeaReturn& sea);
  // For looks along one azimuth.
  void fill(geo::Bearing look, SeaTable& table) const;

 private:
  geo::Bearing wind_from_;
  std::array<double, SeaTable::kPieces + 1> octaves_{};  // log2 of sigma0 across the wind
  std::array<double, SeaTable::kPieces + 1> upwind_{};   // octaves more, looking upwind
};

}  // namespace yars::model::reflectivity

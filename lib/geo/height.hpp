// Three heights that must not be mixed up.
#pragma once

#include "lib/geo/quantity.hpp"

namespace yars::geo {

// A height over one reference surface. Two of a kind differ by a Length; different kinds do not mix.
template <class Datum>
class HeightOver {
 public:
  constexpr HeightOver() = default;
  constexpr explicit HeightOver(Length height) : height_(height) {}
  static constexpr HeightOver metres(double value) { return HeightOver(Length::metres(value)); }
  static constexpr HeightOver feet(double value) { return HeightOver(Length::feet(value)); }
  constexpr double metres() const { return height_.metres(); }
  constexpr double feet() const { return height_.feet(); }
  friend constexpr Length operator-(HeightOver a, HeightOver b) { return a.height_ - b.height_; }
  friend constexpr HeightOver operator+(HeightOver a, Length rise) { return HeightOver(a.height_ + rise); }
  friend constexpr auto operator<=>(HeightOver a, HeightOver b) { return a.height_ <=> b.height_; }
  friend constexpr bool operator==(HeightOver a, HeightOver b) { return a.height_ == b.height_; }

 private:
  Length height_;
};

using AltitudeMsl = HeightOver<struct MeanSeaLevel>;             // above mean sea level, as in DTED
using HeightAboveEllipsoid = HeightOver<struct Wgs84Ellipsoid>;  // above WGS84
using HeightAboveGround = HeightOver<struct GroundBelow>;        // above the terrain below the point

}  // namespace yars::geo

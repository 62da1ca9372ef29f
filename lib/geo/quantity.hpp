// Quantities as types: length, angle, speed, duration, bearing, and height over one of three datums.
// Inputs: numbers with a named unit, such as `Length::feet(500)`.
// Outputs: numbers with a named unit, such as `range.metres()`. A quantity stores one double in SI units.
// A bearing stores one double in degrees.
// Use: convert to a double once before a hot loop, as in `const double range_m = range.metres()`.
#pragma once

#include <cmath>
#include <compare>
#include <numbers>

namespace yars::geo {

// Operators of all quantities: sum, difference, negation, scaling, comparison. The ratio of two quantities is a double.
template <class Derived>
class Quantity {
 public:
  constexpr Quantity() = default;
  friend constexpr Derived operator+(Derived a, Derived b) { return Derived::from_si(a.si_ + b.si_); }
  friend constexpr Derived operator-(Derived a, Derived b) { return Derived::from_si(a.si_ - b.si_); }
  friend constexpr Derived operator-(Derived a) { return Derived::from_si(-a.si_); }
  friend constexpr Derived operator*(Derived a, double factor) { return Derived::from_si(a.si_ * factor); }
  friend constexpr Derived operator*(double factor, Derived a) { return Derived::from_si(a.si_ * factor); }
  friend constexpr Derived operator/(Derived a, double divisor) { return Derived::from_si(a.si_ / divisor); }
  friend constexpr double operator/(Derived a, Derived b) { return a.si_ / b.si_; }
  friend constexpr auto operator<=>(Derived a, Derived b) { return a.si_ <=> b.si_; }
  friend constexpr bool operator==(Derived a, Derived b) { return a.si_ == b.si_; }

 protected:
  constexpr explicit Quantity(double si) : si_(si) {}
  double si_ = 0.0;
};

inline constexpr double kMetresPerNauticalMile = 1852.0;  // [m] exact by definition (1929)
inline constexpr double kMetresPerFoot = 0.3048;          // [m] exact, international foot
inline constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;

class Length : public Quantity<Length> {
 public:
  constexpr Length() = default;
  static constexpr Length from_si(double metres) { return Length(metres); }
  static constexpr Length metres(double value) { return Length(value); }
  static constexpr Length feet(double value) { return Length(value * kMetresPerFoot); }
  static constexpr Length nautical_miles(double value) { return Length(value * kMetresPerNauticalMile); }
  constexpr double metres() const { return si_; }
  constexpr double feet() const { return si_ / kMetresPerFoot; }
  constexpr double nautical_miles() const { return si_ / kMetresPerNauticalMile; }

 private:
  constexpr explicit Length(double si) : Quantity(si) {}
};

// Difference of two directions, or a rotation. Angles are not wrapped: 370 degrees remain 370 degrees.
class Angle : public Quantity<Angle> {
 public:
  constexpr Angle() = default;
  static constexpr Angle from_si(double radians) { return Angle(radians); }
  static constexpr Angle radians(double value) { return Angle(value); }
  static constexpr Angle degrees(double value) { return Angle(value * kRadiansPerDegree); }
  constexpr double radians() const { return si_; }
  constexpr double degrees() const { return si_ / kRadiansPerDegree; }

 private:
  constexpr explicit Angle(double si) : Quantity(si) {}
};

class Speed : public Quantity<Speed> {
 public:
  constexpr Speed() = default;
  static constexpr Speed from_si(double value) { return Speed(value); }
  static constexpr Speed metres_per_second(double value) { return Speed(value); }
  static constexpr Speed knots(double value) { return Speed(value * kMetresPerNauticalMile / 3600.0); }
  constexpr double metres_per_second() const { return si_; }
  constexpr double knots() const { return si_ * 3600.0 / kMetresPerNauticalMile; }

 private:
  constexpr explicit Speed(double si) : Quantity(si) {}
};

class Duration : public Quantity<Duration> {
 public:
  constexpr Duration() = default;
  static constexpr Duration from_si(double value) { return Duration(value); }
  static constexpr Duration seconds(double value) { return Duration(value); }
  constexpr double seconds() const { return si_; }

 private:
  constexpr explicit Duration(double si) : Quantity(si) {}
};

// Horizontal direction, clockwise from true north, in [0, 360) degrees. Two bearings cannot be added. Their difference
// is an Angle in [-180, 180) degrees.
class Bearing {
 public:
  constexpr Bearing() = default;
  static Bearing degrees(double value);
  static Bearing radians(double value);
  double degrees() const { return degrees_; }  // [deg] [0, 360)
  double radians() const { return degrees_ * kRadiansPerDegree; }

  friend Bearing operator+(Bearing bearing, Angle turn) { return degrees(bearing.degrees_ + turn.degrees()); }
  friend Bearing operator-(Bearing bearing, Angle turn) { return degrees(bearing.degrees_ - turn.degrees()); }
  friend Angle operator-(Bearing to, Bearing from);
  friend bool operator==(Bearing a, Bearing b) { return a.degrees_ == b.degrees_; }

 private:
  constexpr explicit Bearing(double degrees) : degrees_(degrees) {}
  double degrees_ = 0.0;
};

// The angle wrapped to [-180, 180) degrees. Exact for every finite input (IEEE remainder).
inline double wrapped_degrees(double degrees) {
  const double wrapped = std::remainder(degrees, 360.0);
  return wrapped >= 180.0 ? wrapped - 360.0 : wrapped;
}

inline Bearing Bearing::degrees(double value) {
  double wrapped = std::fmod(value, 360.0);
  if (wrapped < 0.0) wrapped += 360.0;
  // For a tiny negative input the sum above rounds to 360. The bearing is then 0.
  return Bearing(wrapped >= 360.0 ? 0.0 : wrapped + 0.0);  // a remainder of -0 is 0: north is one bearing
}

inline Bearing Bearing::radians(double value) {
  return degrees(value / kRadiansPerDegree);
}

inline Angle operator-(Bearing to, Bearing from) {
  return Angle::degrees(wrapped_degrees(to.degrees_ - from.degrees_));
}

// Height over one datum (reference surface). The difference of two heights over the same datum is a Length. Combining
// heights over different datums does not compile.
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
using HeightAboveEllipsoid = HeightOver<struct Wgs84Ellipsoid>;  // above the ellipsoid WGS84
using HeightAboveGround = HeightOver<struct GroundBelow>;        // above the terrain below the point

}  // namespace yars::geo

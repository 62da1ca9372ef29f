// Rays bent by an atmosphere whose refractivity falls exponentially with height, over a sphere.
// Inputs: refractivity at mean sea level and its fall; radius of the sphere; heights above it and distances along it
// [m]. Outputs: elevation angles at both ends of a ray [rad], positive above the horizontal; lengths [m]. Method:
// Snell's law on the sphere, n r cos(elevation) = constant, integrated along the ray (Runge and Kutta, 4th
//   order).
// Accuracy: 0.001 mrad, up to 450 km over ground (tests/model/physics/refraction_test.cpp).
// Threads: no shared mutable state.
// Source: ITU-R P.453, exponential profile; Bean and Dutton 1966, "Radio Meteorology", chapter 3.
#pragma once

#include "lib/geo/geodesy.hpp"

namespace yars::geo {

// Refractivity N = (n - 1) 1e6 = surface exp(-height / scale height); n is the index of refraction. Below kLowest_m it
// has the gradient of that height, so that no ray under the ground is trapped.
// Requires a gradient at mean sea level that is less than the curvature of the earth: 157 N-units per km.
struct RefractivityProfile {
  double surface = 0.0;  // [N-units] at mean sea level
  double per_m = 0.0;    // [1/m] inverse of the scale height

  static constexpr double kLowest_m = -3000.0;
  double index(double height_m) const;
  double gradient_per_m(double height_m) const;  // of the index, negative
  bool operator==(const RefractivityProfile&) const = default;
};

// The exponential profile of the International Telecommunication Union's and Bean's mean atmosphere.
inline constexpr RefractivityProfile kMeanRefractivity{313.0, 0.1439e-3};

// A ray at its far end.
struct RayEnd {
  double height_m = 0.0;
  double elevation_rad = 0.0;  // of the ray as it goes on, against the horizontal there
  double length_m = 0.0;       // along the ray
  double optical_m = 0.0;      // integral of the index along the ray: its delay times the speed of light
};
// The ray that leaves a height at an elevation, at a distance over ground.
RayEnd launch_ray(const RefractivityProfile& air, double radius_m, double height_m, double elevation_rad,
                  double distance_m);

// The ray from one height to another.
struct TracedRay {
  double elevation_rad = 0.0;  // where it begins
  RayEnd end;
};
TracedRay trace_ray(const RefractivityProfile& air, double radius_m, double from_height_m, double distance_m,
                    double to_height_m);

}  // namespace yars::geo

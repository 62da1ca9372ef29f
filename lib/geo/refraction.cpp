#include "lib/geo/refraction.hpp"

#include <algorithm>
#include <cmath>

namespace yars::geo {

namespace {
constexpr double kNUnit = 1e-6;
constexpr int kSteps = 100;  // of a ray; 200 change no elevation by more than 1e-7 rad

// State of a ray: height, elevation and angle at the earth's centre, length and optical length.
struct Ray {
  double height_m, elevation_rad, centre_rad, length_m, optical_m;
};

Ray plus(const Ray& ray, const Ray& rate, double by) {
  return {ray.height_m + by * rate.height_m, ray.elevation_rad + by * rate.elevation_rad,
          ray.centre_rad + by * rate.centre_rad, ray.length_m + by * rate.length_m,
          ray.optical_m + by * rate.optical_m};
}

// Derivatives by the length of the straight line to the ray's end. The differential of Snell's law on the sphere gives
// that of the elevation.
Ray rates(const RefractivityProfile& air, double radius_m, const Ray& ray) {
  const double index = air.index(ray.height_m);
  const double along = std::cos(ray.elevation_rad);
  const double r_m = radius_m + ray.height_m;
  return {std::sin(ray.elevation_rad), along * (1.0 / r_m + air.gradient_per_m(ray.height_m) / index), along / r_m, 1.0,
          index};
}

Ray step(const RefractivityProfile& air, double radius_m, const Ray& ray, double by_m) {
  const Ray a = rates(air, radius_m, ray);
  const Ray b = rates(air, radius_m, plus(ray, a, 0.5 * by_m));
  const Ray c = rates(air, radius_m, plus(ray, b, 0.5 * by_m));
  const Ray d = rates(air, radius_m, plus(ray, c, by_m));
  return plus(plus(plus(plus(ray, a, by_m / 6.0), b, by_m / 3.0), c, by_m / 3.0), d, by_m / 6.0);
}

// Follows a ray over a length, then straight on to the exact angle at the earth's centre.
RayEnd follow(const RefractivityProfile& air, double radius_m, Ray ray, double length_m, double centre_rad) {
  for (int i = 0; i < kSteps; ++i) ray = step(air, radius_m, ray, length_m / kSteps);
  for (int i = 0; i < 3; ++i) {
    const double left_rad = centre_rad - ray.centre_rad;
    ray = step(air, radius_m, ray, left_rad * (radius_m + ray.height_m) / std::cos(ray.elevation_rad));
  }
  return {ray.height_m, ray.elevation_rad, ray.length_m, ray.optical_m};
}
}  // namespace

double RefractivityProfile::index(double height_m) const {
  const double lowest_m = std::max(height_m, kLowest_m);
  return 1.0 + kNUnit * surface * std::exp(-per_m * lowest_m) + (height_m - lowest_m) * gradient_per_m(lowest_m);
}

double RefractivityProfile::gradient_per_m(double height_m) const {
  return -kNUnit * surface * per_m * std::exp(-per_m * std::max(height_m, kLowest_m));
}

RayEnd launch_ray(const RefractivityProfile& air, double radius_m, double height_m, double elevation_rad,
                  double distance_m) {
  const double centre_rad = distance_m / radius_m;
  // Length of the straight line to the same angle: law of sines.
  const double length_m = (radius_m + height_m) * std::sin(centre_rad) / std::cos(elevation_rad + centre_rad);
  return follow(air, radius_m, {height_m, elevation_rad, 0.0, 0.0, 0.0}, length_m, centre_rad);
}

TracedRay trace_ray(const RefractivityProfile& air, double radius_m, double from_height_m, double distance_m,
                    double to_height_m) {
  const double centre_rad = distance_m / radius_m;
  const double half_sine = std::sin(0.5 * centre_rad);
  const double out_m = (radius_m + to_height_m) * std::sin(centre_rad);
  const double up_m = to_height_m - from_height_m - 2.0 * (radius_m + to_height_m) * half_sine * half_sine;
  const double straight_m = std::hypot(out_m, up_m);
  TracedRay ray{std::atan2(up_m, out_m), {}};
  // Method of secants. At first a change of the elevation moves the end by the straight line's length across the ray.
  double rise_m = 0.0, before_m = 0.0, change_rad = 0.0;
  for (int i = 0; i < 8; ++i) {
    ray.end = follow(air, radius_m, {from_height_m, ray.elevation_rad, 0.0, 0.0, 0.0}, straight_m, centre_rad);
    const double miss_m = ray.end.height_m - to_height_m;
    if (std::abs(miss_m) < 1e-10 * straight_m) break;
    rise_m = i == 0 ? straight_m / std::cos(ray.end.elevation_rad) : (miss_m - before_m) / change_rad;
    before_m = miss_m;
    change_rad = -miss_m / rise_m;
    ray.elevation_rad += change_rad;
  }
  return ray;
}

}  // namespace yars::geo

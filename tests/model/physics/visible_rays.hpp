// Traced rays to points above the horizon, for tests: observers from 500 to 50,000 ft, points up to 4 km high, 200 NM.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "lib/geo/refraction.hpp"

namespace yars::test {

struct VisibleRay {
  double altitude_m, distance_m, height_m;
  geo::TracedRay traced;
};

inline std::vector<VisibleRay> visible_rays(double radius_m, double altitude_m) {
  const geo::RefractivityProfile air = geo::kMeanRefractivity;
  std::vector<VisibleRay> rays;
  std::vector<double> distances_m{200.0, 500.0, 1500.0, 3000.0, 6000.0, 9000.0};
  for (double distance_m = 12e3; distance_m <= 370'400.0; distance_m += 12.8e3) distances_m.push_back(distance_m);
  for (const double distance_m : distances_m)
    for (const double height_m : {0.0, 250.0, 700.0, 1300.0, 2200.0, 3100.0, 4000.0}) {
      const geo::TracedRay ray = geo::trace_ray(air, radius_m, altitude_m, distance_m, height_m);
      // A ray that falls and rises again passes its lowest point, where it is level.
      const bool passes_lowest = ray.elevation_rad < 0.0 && ray.end.elevation_rad > 0.0;
      if (passes_lowest &&
          air.index(altitude_m) * (radius_m + altitude_m) * std::cos(ray.elevation_rad) < air.index(0.0) * radius_m)
        continue;
      rays.push_back({altitude_m, distance_m, height_m, ray});
    }
  return rays;
}

inline constexpr double kObservers_ft[] = {500.0, 1500.0, 3300.0, 5000.0, 10e3, 13e3, 16.4e3,
                                           20e3,  25e3,   30e3,   36e3,   40e3, 45e3, 50e3};

inline std::vector<VisibleRay> visible_rays(double radius_m) {
  std::vector<VisibleRay> all;
  for (const double altitude_ft : kObservers_ft) {
    const std::vector<VisibleRay> rays = visible_rays(radius_m, 0.3048 * altitude_ft);
    all.insert(all.end(), rays.begin(), rays.end());
  }
  return all;
}

}  // namespace yars::test

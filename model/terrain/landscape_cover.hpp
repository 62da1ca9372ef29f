// What covers a post of the made-up earth, as a surface material code: sea and rivers, runways, towns by their
// streets and quarters, beaches, marsh, woods, bare rock, snow; else soil. A function of place and seed.
#pragma once

#include <cstdint>
#include <span>

#include "lib/geo/frames.hpp"
#include "model/terrain/culture.hpp"
#include "model/terrain/landscape_places.hpp"

namespace yars::model::terrain {

// Ground above is snow all the year [m]; falls toward the poles. Woods end kWoodsBelowSnowM below.
double snow_line_m(double latitude_deg);

struct CoverSite {
  geo::GeoPoint place;
  geo::Vector3 upward;     // unit vector of the place on the sphere
  double height_m = 0.0;   // 0 or less: sea
  double steepness = 0.0;  // [m/m]
  double valley = 1.0;     // -1 water of a river, 0 valley floor, 1 no valley
};

// Without towns and airfields.
Material natural_cover(const CoverSite& site, std::uint32_t seed);

// What a town has at a place so many of its radii from its middle [0, 1.4]; nothing beyond its ragged edge.
Material town_cover(const CoverSite& site, double radii, Material natural, std::uint32_t seed);

// Runway, taxiway and apron; `natural` beside them.
Material airfield_cover(const Airfield& airfield, geo::GeoPoint place, Material natural);

}  // namespace yars::model::terrain

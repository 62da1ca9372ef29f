#include "model/reflectivity/street_grid.hpp"

#include "model/reflectivity/ground_grid.hpp"

namespace yars::model::reflectivity {

namespace {
constexpr double kTownM = 4000.0;  // [m] a town's quarter: smaller ones would flicker, larger ones show as blocks
}  // namespace

double street_bearing_deg(geo::GeoPoint place) {
  static const GroundGrid kTowns = make_ground_grid(kTownM);
  return 90.0 * static_cast<double>(ground_bits(kTowns, place)) / 4294967296.0;
}

}  // namespace yars::model::reflectivity

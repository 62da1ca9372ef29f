#include "model/rbm/place_lanes.hpp"

#include "model/terrain/terrain_view.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/rbm/place_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace yars::model::rbm::places::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using DoubleTag = hn::CappedTag<double, terrain::kRunSlack / 2>;
using FloatTag = hn::Rebind<float, DoubleTag>;

// So many knots that the compiler knows: their coefficients stay in registers. 0: as many as the curves say.
template <std::size_t kKnots>
HWY_INLINE void along(std::size_t count, const float* distance_m, double scale, const Curve& north, const Curve& east,
                      const Places& places) {
  const DoubleTag d;
  const FloatTag df;
  const std::size_t last = (kKnots > 0 ? kKnots : static_cast<std::size_t>(north.knots)) - 1;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto distance = hn::PromoteTo(d, hn::LoadU(df, distance_m + i));
    const auto t = hn::Sub(hn::Mul(distance, hn::Set(d, scale)), hn::Set(d, 1.0));
    auto up = hn::Set(d, north.difference[last]);
    auto right = hn::Set(d, east.difference[last]);
    for (std::size_t k = last; k-- > 0;) {
      const auto way = hn::Sub(t, hn::Set(d, north.knot[k]));
      up = hn::Add(hn::Mul(up, way), hn::Set(d, north.difference[k]));
      right = hn::Add(hn::Mul(right, way), hn::Set(d, east.difference[k]));
    }
    const auto cells_north = hn::Floor(up);
    const auto cells_east = hn::Floor(right);
    hn::StoreU(hn::DemoteTo(df, cells_north), df, places.cells_north + i);
    hn::StoreU(hn::DemoteTo(df, cells_east), df, places.cells_east + i);
    hn::StoreU(hn::DemoteTo(df, hn::Sub(up, cells_north)), df, places.north_deg + i);
    hn::StoreU(hn::DemoteTo(df, hn::Sub(right, cells_east)), df, places.east_deg + i);
  }
}

void along_curves(std::size_t count, const float* distance_m, double scale, const Curve& north, const Curve& east,
                  const Places& places) {
  // Copies, so that no store could be one to a coefficient.
  const Curve up = north;
  const Curve right = east;
  if (north.knots == 3) return along<3>(count, distance_m, scale, up, right, places);
  if (north.knots == 4) return along<4>(count, distance_m, scale, up, right, places);
  if (north.knots == 5) return along<5>(count, distance_m, scale, up, right, places);
  along<0>(count, distance_m, scale, up, right, places);
}

}  // namespace yars::model::rbm::places::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace yars::model::rbm::places {

HWY_EXPORT(along_curves);

void along_curves(std::size_t count, const float* distance_m, double scale, const Curve& north, const Curve& east,
                  const Places& places) {
  HWY_DYNAMIC_DISPATCH(along_curves)(count, distance_m, scale, north, east, places);
}

}  // namespace yars::model::rbm::places
#endif  // HWY_ONCE

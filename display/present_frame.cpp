#include "display/present_frame.hpp"

#include "databuffer/records/navigation.hpp"

namespace yars::display {

namespace {

constexpr double kLeastRange_m = 1852.0;  // [m] stands in for a state that names no range yet: nothing divides by 0

}  // namespace

GlassFrame present_frame(const GlassInput& input, const StoredSweep* newest) {
  const double range_m = input.state.range_nm * geo::kMetresPerNauticalMile;
  GlassFrame frame;
  frame.range_m = range_m > 0.0 ? range_m : kLeastRange_m;
  const bool frozen = (input.model.flags & databuffer::kModelFrozen) != 0;
  if (frozen && newest != nullptr) {
    frame.apex = newest->apex;
    frame.up = newest->ground_track;
  } else {
    frame.apex = {input.ownship.latitude_deg, input.ownship.longitude_deg};
    frame.up = databuffer::ground_track_of(input.ownship);
  }
  return frame;
}

}  // namespace yars::display

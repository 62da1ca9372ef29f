#include "model/rbm/ray_share.hpp"

#include <algorithm>

#include "model/rbm/receiver.hpp"

namespace yars::model::rbm {

namespace {
constexpr double kBeamsAside = 2.0;
}  // namespace

Angles seen_angles(const RayShare& share, double beamwidth_rad) {
  const double most_rad = kBeamsAside * beamwidth_rad;
  if (share.sharpened) return {share.left_rad, share.right_rad};
  return {std::max(share.left_rad, share.beam_rad - most_rad), std::min(share.right_rad, share.beam_rad + most_rad)};
}

double azimuth_share(const RayShare& share, double beamwidth_rad, double off_rad, double wide_rad) {
  const Angles seen = seen_angles(share, beamwidth_rad);
  if (share.sharpened) {
    const double cell_rad = seen.right_rad - seen.left_rad;
    const double within_rad =
        std::min(seen.right_rad, off_rad + 0.5 * wide_rad) - std::max(seen.left_rad, off_rad - 0.5 * wide_rad);
    // A point without width belongs to the cell that it lies in, on its left edge too.
    const bool inside = off_rad >= seen.left_rad && off_rad < seen.right_rad;
    const double part = wide_rad > 0.0 ? std::clamp(within_rad / wide_rad, 0.0, 1.0) : inside ? 1.0 : 0.0;
    return part * share.factor * beamwidth_rad / cell_rad;
  }
  if (!(off_rad >= seen.left_rad && off_rad < seen.right_rad)) return 0.0;
  return share.factor * azimuth_gain(beamwidth_rad, off_rad - share.beam_rad);
}

}  // namespace yars::model::rbm

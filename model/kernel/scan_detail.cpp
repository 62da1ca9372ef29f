#include "model/kernel/scan_detail.hpp"

#include <algorithm>

#include "lib/radar/limits.hpp"
#include "model/terrain/terrain_view.hpp"

namespace yars::model::kernel {

int scan_detail(const radar::Fidelity& fidelity, geo::Length range) {
  if (!(fidelity.posts_per_sample > 0.0)) return 0;
  const int samples = std::clamp(fidelity.samples, 1, radar::kMaxSamples);
  return terrain::detail_for(range.metres() / samples / fidelity.posts_per_sample);
}

}  // namespace yars::model::kernel

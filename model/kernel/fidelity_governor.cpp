#include "model/kernel/fidelity_governor.hpp"

#include <cmath>

namespace yars::model::kernel {

namespace {
// What a rung costs times the one below, until it has been tried: samples, rays and effects by count,
// docs/performance.md.
constexpr std::array<double, FidelityGovernor::kLadder.size()> kCostOverLower{1.0, 3.0, 30.0, 25.0};
constexpr double kMargin = 0.7;    // of the share: a finer preset must promise to stay below, or it would come and go
constexpr int kMemoryScans = 120;  // [scans] two minutes at FULL: after that the scene is another one
}  // namespace

double FidelityGovernor::expected_load(std::size_t rung, double load) const {
  const Memory& memory = memory_[rung];
  if (memory.known && memory.scans_ago < kMemoryScans) return memory.load;
  return load * kCostOverLower[rung];
}

void FidelityGovernor::scanned(double load) {
  if (!std::isfinite(load)) return;
  for (Memory& memory : memory_) ++memory.scans_ago;
  memory_[rung_] = {load, 0, true};
  if (load > core_share_) {
    if (rung_ > 0) --rung_;
    return;
  }
  if (rung_ + 1 < kLadder.size() && expected_load(rung_ + 1, load) < kMargin * core_share_) ++rung_;
}

}  // namespace yars::model::kernel

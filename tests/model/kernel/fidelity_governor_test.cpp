// FidelityGovernor: selects the finest fidelity preset whose load is within a fraction of a core.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string_view>

#include "model/kernel/tick_inputs.hpp"

namespace yars::model::kernel {
namespace {

constexpr double kShare = 0.25;  // limit [fraction of a core]
constexpr auto kLadder = FidelityGovernor::kLadder;

// Index of the preset after 300 scans: `cheap` presets need the load `low`, the finer ones the load `high`.
std::size_t selected(FidelityGovernor& governor, std::size_t cheap, double low, double high) {
  const auto index = [&] {
    return static_cast<std::size_t>(std::ranges::find(kLadder, governor.preset(), &values::ComparablePreset::name) -
                                    kLadder.begin());
  };
  for (int scan = 0; scan < 300; ++scan) governor.record_load(index() < cheap ? low : high);
  return index();
}

TEST(FidelityGovernor, SelectsTheFinestPresetWithinTheShare) {
  for (std::size_t cheap = 1; cheap <= kLadder.size(); ++cheap) {
    FidelityGovernor governor(kShare);
    EXPECT_EQ(selected(governor, cheap, 1e-4, 0.9), cheap - 1);
  }
}

TEST(FidelityGovernor, SelectsTheCoarsestPresetIfNoneIsWithinTheShare) {
  FidelityGovernor governor(kShare);
  EXPECT_EQ(selected(governor, 0, 0.0, 5.0), 0U);
}

TEST(FidelityGovernor, DoesNotAlternateBetweenTwoPresets) {
  FidelityGovernor governor(kShare);
  int changes = 0;
  const std::string_view first = governor.preset();
  std::string_view before = first;
  for (int scan = 0; scan < 100; ++scan) {
    governor.record_load(governor.preset() == first ? 0.005 : 0.30);
    if (governor.preset() != before) ++changes;
    before = governor.preset();
  }
  EXPECT_EQ(governor.preset(), "standard");
  EXPECT_LE(changes, 2) << "one trial of the finer preset, then back";
}

TEST(FidelityGovernor, SelectsAFinerPresetAgainAfterTheLoadHasFallen) {
  FidelityGovernor governor(kShare);
  const std::size_t index = selected(governor, kLadder.size() - 2, 0.001, 0.9);
  EXPECT_EQ(index, kLadder.size() - 3);
  EXPECT_EQ(selected(governor, kLadder.size() - 1, 0.001, 0.9), index + 1);
}

TEST(FidelityGovernor, IgnoresALoadThatIsNotFinite) {
  FidelityGovernor governor(kShare);
  governor.record_load(std::numeric_limits<double>::quiet_NaN());
  governor.record_load(std::numeric_limits<double>::infinity());
  EXPECT_EQ(governor.preset(), "standard");
}

}  // namespace
}  // namespace yars::model::kernel

// FidelityGovernor: selects the finest fidelity preset whose load is within a fraction of a core.
#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <string>

#include "model/kernel/tick_inputs.hpp"

namespace yars::model::kernel {
namespace {

using Loads = std::map<std::string_view, double>;  // by preset [fraction of a core]
constexpr double kShare = 0.25;                    // limit [fraction of a core]

// Governor after `scans` scans with these loads.
FidelityGovernor governor_after(const Loads& loads, int scans = 50) {
  FidelityGovernor governor(kShare);
  for (int scan = 0; scan < scans; ++scan) governor.record_load(loads.at(governor.preset()));
  return governor;
}

TEST(FidelityGovernor, SelectsTheFinestPresetWithinTheShare) {
  EXPECT_EQ(governor_after({{"draft", 1e-4}, {"standard", 1e-4}, {"fine", 1e-3}, {"reference", 0.01}}).preset(),
            "reference");
  EXPECT_EQ(governor_after({{"draft", 1e-3}, {"standard", 4e-3}, {"fine", 0.1}, {"reference", 3.0}}).preset(), "fine");
  EXPECT_EQ(governor_after({{"draft", 0.01}, {"standard", 0.2}, {"fine", 4.0}, {"reference", 90.0}}).preset(),
            "standard");
  EXPECT_EQ(governor_after({{"draft", 0.2}, {"standard", 0.9}, {"fine", 9.0}, {"reference", 90.0}}).preset(), "draft");
}

TEST(FidelityGovernor, SelectsTheCoarsestPresetIfNoneIsWithinTheShare) {
  EXPECT_EQ(governor_after({{"draft", 5.0}, {"standard", 9.0}, {"fine", 90.0}, {"reference", 900.0}}).preset(),
            "draft");
}

TEST(FidelityGovernor, DoesNotAlternateBetweenTwoPresets) {
  const Loads loads{{"draft", 0.001}, {"standard", 0.005}, {"fine", 0.30}, {"reference", 3.0}};
  FidelityGovernor governor(kShare);
  int changes = 0;
  std::string_view before = governor.preset();
  for (int scan = 0; scan < 100; ++scan) {
    governor.record_load(loads.at(governor.preset()));
    if (governor.preset() != before) ++changes;
    before = governor.preset();
  }
  EXPECT_EQ(governor.preset(), "standard");
  EXPECT_LE(changes, 2) << "one trial of the finer preset, then back";
}

TEST(FidelityGovernor, SelectsAFinerPresetAgainAfterTheLoadHasFallen) {
  FidelityGovernor governor(kShare);
  for (int scan = 0; scan < 20; ++scan) governor.record_load(governor.preset() == "fine" ? 0.9 : 0.005);
  EXPECT_EQ(governor.preset(), "standard");
  for (int scan = 0; scan < 300; ++scan) governor.record_load(governor.preset() == "fine" ? 0.1 : 0.002);
  EXPECT_EQ(governor.preset(), "fine");
}

TEST(FidelityGovernor, IgnoresALoadThatIsNotFinite) {
  FidelityGovernor governor(kShare);
  governor.record_load(std::numeric_limits<double>::quiet_NaN());
  governor.record_load(std::numeric_limits<double>::infinity());
  EXPECT_EQ(governor.preset(), "standard");
}

}  // namespace
}  // namespace yars::model::kernel
